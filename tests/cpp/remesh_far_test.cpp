#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "support/remeshed.h"
#include "support/shapes.h"
#include "tetrafront/remesh.h"

namespace tetrafront {
namespace {

/// Rounds the nodes so that they stay exact when they are moved by a power of two up to 2^31.
void roundNodes(SurfaceMesh& mesh) {
  for (double& coordinate : mesh.points) coordinate = std::round(coordinate * 0x1p20) * 0x1p-20;
}

SurfaceRemesh remeshed(const SurfaceMesh& mesh) {
  SurfaceRemesher remesher(mesh.points, mesh.triangles, {}, {}, {});
  while (!remesher.advance(4096)) {
  }
  return remesher.result();
}

/// A remeshing of a surface far from the origin ends, and is as good as of the same one near it.
TEST(RemeshFar, DoesNotDependOnTheDistanceFromTheOrigin) {
  SurfaceMesh sphere = testing::geodesicSphere(2);
  SurfaceMesh cube = testing::gridCube(2);
  for (SurfaceMesh* shape : {&sphere, &cube}) {
    roundNodes(*shape);
    const SurfaceRemesh near = remeshed(*shape);
    for (const double distance : {0x1p10, 0x1p20, 0x1p31}) {
      SurfaceMesh far = *shape;
      testing::translate(far, Vec3(distance, -0.75 * distance, 0.25 * distance));
      const SurfaceRemesh made = remeshed(far);
      EXPECT_TRUE(testing::errorsOf(testing::surfaceOf(made), InnerShells::kCavities).empty());
      EXPECT_EQ(made.patches, near.patches) << distance;
      EXPECT_EQ(made.featureLines, near.featureLines) << distance;
      EXPECT_GT(made.smallestAngle, near.smallestAngle - 5.0) << distance;
      EXPECT_LE(made.deviation, made.tolerance * (1.0 + 1e-9)) << distance;
      EXPECT_NEAR(static_cast<double>(made.triangles.size()),
                  static_cast<double>(near.triangles.size()),
                  0.1 * static_cast<double>(near.triangles.size()))
          << distance;
    }
  }
}

/// Where the digits of the numbers do not suffice for the shape, a remeshing still ends, with a valid surface.
TEST(RemeshFar, EndsWhereDigitsAreFew) {
  for (const double distance : {0x1p44, 0x1p48, 0x1p50}) {
    SurfaceMesh sphere = testing::geodesicSphere(2);
    testing::translate(sphere, Vec3(distance, -0.75 * distance, 0.25 * distance));
    const SurfaceRemesh made = remeshed(sphere);
    const bool isRefused = made.triangles.empty();
    EXPECT_TRUE(isRefused ||
                testing::errorsOf(testing::surfaceOf(made), InnerShells::kCavities).empty())
        << distance;
  }
}

}  // namespace
}  // namespace tetrafront
