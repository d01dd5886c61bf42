/// How large a mesh will be, asked before the front starts: for bodies that are easily overlooked.

#include "sizing/expected_count.h"

#include <gtest/gtest.h>

#include "field/size_field.h"
#include "support/shapes.h"

namespace tetrafront {
namespace {

/// What a uniform size asks for within a volume.
double unitTetrahedra(double volume, double size) {
  return kTetrahedraPerUnitVolume * volume / (size * size * size);
}

TEST(ExpectedCount, TakesNoNoticeOfNodesWithoutTriangles) {
  SurfaceMesh surface = testing::geodesicSphere(8);
  surface.points.insert(surface.points.begin(), {1e6, -1e6, 1e6});
  for (std::uint32_t& node : surface.triangles) ++node;
  surface.points.insert(surface.points.end(), {-1e6, 0.0, 0.0});
  const double volume = enclosedVolume(surface);
  EXPECT_NEAR(volume, 4.18, 0.05);
  const double expected = expectedTetrahedra(surface, SizeField::uniform(0.05));
  EXPECT_NEAR(expected, unitTetrahedra(volume, 0.05), 1e-6 * expected);
}

/// Thinner than the distance of the columns along which is looked.
TEST(ExpectedCount, FindsABeamAcrossItsBox) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SurfaceMesh beam = testing::gridBox(Vec3(0.0), Vec3(100.0, 0.01, 0.01), {50, 1, 1});
    testing::rotateRandomly(beam, seed);
    const double expected = expectedTetrahedra(beam, SizeField::uniform(0.005));
    const double wanted = unitTetrahedra(0.01, 0.005);
    EXPECT_NEAR(expected, wanted, 1e-6 * wanted) << seed;
  }
}

}  // namespace
}  // namespace tetrafront
