/// The region around a base face in stretched spaces must keep everything that an element there
/// could cross, and drop most other faces.

#include "volume/search_region.h"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace tetrafront {
namespace {

constexpr double kExtent = 2000.0;  // no two positions here are further apart

UnitSpace slantedSpace(testing::Random& random, double stretching) {
  BackgroundNode node;
  node.size = random.between(0.01, 1.0);
  node.stretching = stretching;
  node.direction = random.inBox(1.0);
  return UnitSpace::stretched(sizeTensor(node), random.inBox(500.0));
}

using Triangle = std::array<Vec3, 3>;

Triangle unitTriangle(testing::Random& random, const UnitSpace& space) {
  return {space.toSpace(random.inBox(1.0)), space.toSpace(random.inBox(1.0)),
          space.toSpace(random.inBox(1.0))};
}

/// Each triangle has a point in common with an element in the region: a corner of the base, the
/// apex, or a position between them, where rounding errors are most dangerous.
TEST(SearchRegion, KeepsEverythingThatTouchesAnElement) {
  testing::Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const UnitSpace space = slantedSpace(random, random.between(1.0, 200.0));
    const Triangle base = unitTriangle(random, space);
    SearchRegion region(space, base, random.inBox(1.0), 0.5, kExtent);
    const Vec3 apex = space.toSpace(random.inBox(3.0));
    region.include(apex);
    EXPECT_FALSE(region.include(apex)) << "the region already contains it";
    const std::array<Vec3, 4> touched{base[0], apex, 0.5 * (base[1] + apex),
                                      0.25 * (base[0] + base[1] + base[2] + apex)};
    const Vec3& position = touched[static_cast<std::size_t>(random.integer(0, 3))];
    const Vec3 b = position + random.inBox(200.0);
    const Vec3 c = position + random.inBox(200.0);
    ASSERT_TRUE(region.mayIntersect(position, b, c)) << i;
    ASSERT_TRUE(region.mayIntersect(b, c, position)) << i;
  }
}

/// The triangles are in the region's box in plain space, but few of them are near in the metric.
TEST(SearchRegion, DropsTrianglesThatAreNearOnlyInPlainSpace) {
  BackgroundNode node;
  node.size = 0.1;
  node.stretching = 20.0;
  node.direction = Vec3(2.0, 1.0, -0.7);
  const UnitSpace space = UnitSpace::stretched(sizeTensor(node), Vec3(0.0));
  testing::Random random(6);
  const SearchRegion region(space, unitTriangle(random, space), Vec3(0.0), 1.0, kExtent);
  const Box& box = region.box();
  int kept = 0;
  constexpr int kTriangles = 2000;
  for (int i = 0; i < kTriangles; ++i) {
    Vec3 centre;
    for (int k = 0; k < 3; ++k)
      centre[k] = random.between(static_cast<double>(box.low[k]), static_cast<double>(box.high[k]));
    const Triangle triangle = unitTriangle(random, space);
    kept += region.mayIntersect(centre + triangle[0], centre + triangle[1], centre + triangle[2])
                ? 1
                : 0;
  }
  EXPECT_LT(kept, kTriangles / 5);
}

}  // namespace
}  // namespace tetrafront
