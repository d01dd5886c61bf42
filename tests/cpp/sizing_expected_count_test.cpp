// Estimates of the number of elements, for surfaces that are easily misestimated.

#include "sizing/expected_count.h"

#include <gtest/gtest.h>

#include "field/size_field.h"
#include "support/shapes.h"

namespace tetrafront {
namespace {

/// Number of tetrahedra of a uniform size in a volume.
double unitTetrahedra(double volume, double size) {
  return kTetrahedraPerUnitVolume * volume / (size * size * size);
}

TEST(ExpectedCount, IgnoresNodesWithoutTriangles) {
  SurfaceMesh surface = testing::geodesicSphere(8);
  surface.points.insert(surface.points.begin(), {1e6, -1e6, 1e6});
  for (std::uint32_t& node : surface.triangles) ++node;
  surface.points.insert(surface.points.end(), {-1e6, 0.0, 0.0});
  const double volume = enclosedVolume(surface);
  EXPECT_NEAR(volume, 4.18, 0.05);
  const double expected = expectedTetrahedra(surface, SizeField::uniform(0.05));
  EXPECT_NEAR(expected, unitTetrahedra(volume, 0.05), 1e-6 * expected);
}

/// The beam is thinner than the distance between columns of samples.
TEST(ExpectedCount, EstimatesABeamAcrossItsBox) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SurfaceMesh beam = testing::gridBox(Vec3(0.0), Vec3(100.0, 0.01, 0.01), {50, 1, 1});
    testing::rotateRandomly(beam, seed);
    const double expected = expectedTetrahedra(beam, SizeField::uniform(0.005));
    const double exact = unitTetrahedra(0.01, 0.005);
    EXPECT_NEAR(expected, exact, 1e-6 * exact) << seed;
  }
}

}  // namespace
}  // namespace tetrafront
