/// Positions in the volumes that a surface encloses.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/region_location.h"

namespace tetrafront {
namespace {

using testing::dividedBox;
using testing::gridBox;
using testing::nestedSpheres;

RegionLocation located(const SurfaceMesh& surface, const std::vector<double>& positions) {
  RegionLocator locator(surface.points, surface.triangles, positions);
  while (!locator.advance(100)) {
  }
  return locator.result();
}

/// Expects that the unit cubes of a divided box are volumes, whatever the orientation of their triangles is.
TEST(RegionLocation, EachCubeOfADividedBoxIsAVolume) {
  SurfaceMesh box = dividedBox({3, 2, 2}, 2);
  for (std::size_t t = 0; t < box.triangles.size(); t += 9) {
    std::swap(box.triangles[t], box.triangles[t + 1]);
  }
  std::vector<double> positions;
  std::vector<std::array<int, 3>> cubes;
  testing::Random random(7);
  for (int i = 0; i < 200; ++i) {
    std::array<int, 3> cube{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double x = random.between(0.0, axis == 0 ? 3.0 : 2.0);
      positions.push_back(x);
      cube[axis] = static_cast<int>(std::floor(x));
    }
    cubes.push_back(cube);
  }
  const RegionLocation found = located(box, positions);
  ASSERT_TRUE(found.diagnostics.empty());
  EXPECT_EQ(found.volumes, 12U);
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_EQ(found.volumeOf[i] == found.volumeOf[j], cubes[i] == cubes[j]) << i << " " << j;
    }
  }
}

TEST(RegionLocation, ShellsInsideEachOtherEncloseVolumesOfTheirOwn) {
  const SurfaceMesh spheres = nestedSpheres(3, 4);
  const RegionLocation found = located(spheres, {0.0, 0.0, 0.0, 0.0, 0.0, 5.0});
  EXPECT_EQ(found.volumes, 3U);
  EXPECT_LT(found.volumeOf[0], 3U);
  EXPECT_EQ(found.volumeOf[1], RegionLocation::kOutside);
}

TEST(RegionLocation, TheNearestDoublesBesideAFaceAreOnDifferentSides) {
  const SurfaceMesh box = gridBox(Vec3(0.0), Vec3(1.0), {2, 2, 2});
  const double below = std::nextafter(1.0, 0.0);
  const double above = std::nextafter(1.0, 2.0);
  const RegionLocation found = located(box, {
                                                0.3,
                                                0.3,
                                                below,  //
                                                0.3,
                                                0.3,
                                                above,  //
                                                0.3,
                                                0.3,
                                                1.0,  // inside a triangle
                                                0.25,
                                                0.25,
                                                1.0,  // on an edge
                                                0.5,
                                                0.5,
                                                1.0,  // at a node
                                                1.0,
                                                0.3,
                                                0.3,
                                            });
  using Location = RegionLocation;
  EXPECT_EQ(found.volumeOf, (std::vector<std::uint32_t>{
                                0, Location::kOutside, Location::kOnBoundary, Location::kOnBoundary,
                                Location::kOnBoundary, Location::kOnBoundary}));
}

TEST(RegionLocation, OpenSurfacesAreRefused) {
  SurfaceMesh box = gridBox(Vec3(0.0), Vec3(1.0), {1, 1, 1});
  box.triangles.resize(box.triangles.size() - 3);
  EXPECT_FALSE(located(box, {0.5, 0.5, 0.5}).diagnostics.empty());
}

}  // namespace
}  // namespace tetrafront
