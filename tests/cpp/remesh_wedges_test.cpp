/// @file Sizes in wedges, which no size can open, and in places that are far thinner than the smallest size.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/hard_shapes.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

/// A prism over a triangle: two sides of a length meet at an angle, at an edge as long as the height.
SurfaceMesh prismWedge(double degrees, double length, double height) {
  const double half = degrees * std::numbers::pi / 360.0;
  const double x = length * std::cos(half);
  const double y = length * std::sin(half);
  SurfaceMesh mesh;
  for (const double z : {0.0, height}) {
    mesh.points.insert(mesh.points.end(), {0.0, 0.0, z, x, -y, z, x, y, z});
  }
  mesh.triangles = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
  return mesh;
}

/// Triangles of one size that cover the two large faces of a wedge.
double trianglesOfSize(double length, double height, double size) {
  return 2.0 * length * height / (0.433 * size * size);
}

class WedgeSizes : public ::testing::TestWithParam<double> {};

/// Sizes that followed the distance between the faces gave 4 to 60 times as many triangles as the size asks for.
TEST_P(WedgeSizes, DoNotFallTowardsTheEdge) {
  const SurfaceMesh wedge = prismWedge(GetParam(), 10.0, 10.0);
  RemeshOptions options;
  options.dropPoorDetails = true;
  const SurfaceRemesh automatic = remesh(wedge, options);
  EXPECT_LT(static_cast<double>(automatic.triangles.size()) / 3.0,
            2.5 * trianglesOfSize(10.0, 10.0, automatic.size));
  options.size = 0.7;
  const SurfaceRemesh sized = remesh(wedge, options);
  EXPECT_LT(static_cast<double>(sized.triangles.size()) / 3.0,
            2.5 * trianglesOfSize(10.0, 10.0, options.size));
  const SurfaceMesh made = surfaceOf(sized);
  MeshRun run(made.points, made.triangles, {});
  while (run.advance(10'000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  const PoorElements poor = run.statistics().poor;
  if (poor.count == 0) return;
  EXPECT_EQ(poor.reason, PoorReason::kWedge);
  EXPECT_NEAR(poor.value, GetParam(), 0.05 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Angles, WedgeSizes, ::testing::Values(1.0, 8.0, 25.0));

/// As prismWedge(), with a narrow strip of triangles on either side beside the edge.
SurfaceMesh stripedWedge(double degrees, double width, double length, double height) {
  const double half = degrees * std::numbers::pi / 360.0;
  SurfaceMesh mesh;
  for (const double z : {0.0, height}) {
    mesh.points.insert(mesh.points.end(), {0.0, 0.0, z});
    for (const double side : {-1.0, 1.0}) {
      for (const double at : {width, length})
        mesh.points.insert(mesh.points.end(), {at * std::cos(half), side * at * std::sin(half), z});
    }
  }
  // Counter-clockwise seen from above: 0, 1, 2, 4, 3; the upper ones are five more.
  const std::array<std::uint32_t, 5> loop{0, 1, 2, 4, 3};
  mesh.triangles = {0, 3, 1, 1, 3, 4, 1, 4, 2, 5, 6, 8, 6, 9, 8, 6, 7, 9};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto [a, b] = std::array{loop[i], loop[(i + 1) % loop.size()]};
    mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 5, a, b + 5, a + 5});
  }
  return mesh;
}

/// Rays across the wedge beside its edge measured almost nothing, so that it became a thin place with ten times as many triangles.
TEST(WedgeSizes, DoNotFallInAWideWedge) {
  for (const double degrees : {32.0, 45.0, 58.0}) {
    SCOPED_TRACE(degrees);
    const SurfaceRemesh result = remesh(stripedWedge(degrees, 0.02, 10.0, 10.0));
    ASSERT_TRUE(result.diagnostics.empty());
    EXPECT_LT(static_cast<double>(result.triangles.size()) / 3.0,
              2.5 * trianglesOfSize(10.0, 10.0, result.size));
  }
}

/// Rays end at faces inclined by up to 60 degrees: at that angle, rounding decides for each of them. Up to fourteen times as many
/// triangles as the size asks for were made.
TEST(WedgeSizes, DoNotFallWhereRoundingDecidesAboutRays) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    SurfaceMesh wedge = stripedWedge(60.0, 0.02, 10.0, 10.0);
    if (seed > 0) rotateRandomly(wedge, seed);
    const SurfaceRemesh result = remesh(wedge);
    ASSERT_TRUE(result.diagnostics.empty());
    EXPECT_LT(static_cast<double>(result.triangles.size()) / 3.0,
              3.0 * trianglesOfSize(10.0, 10.0, result.size));
  }
}

/// A blunt edge is a thin place, not a wedge: sizes follow its thickness.
TEST(WedgeSizes, FollowTheThicknessOfABluntEdge) {
  SurfaceMesh blunt;
  const auto halfWidth = [](double x) { return 0.1 + 0.03 * x; };
  for (const double z : {0.0, 10.0}) {
    for (const double x : {0.0, 10.0}) {
      blunt.points.insert(blunt.points.end(), {x, -halfWidth(x), z, x, halfWidth(x), z});
    }
  }
  blunt.triangles = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 2, 6, 0, 6, 4,
                     1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6};
  const SurfaceRemesh result = remesh(blunt);
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_GT(static_cast<double>(result.triangles.size()) / 3.0,
            1.8 * trianglesOfSize(10.0, 10.0, result.size));
}

/// The smallest size would be 1/300 of the diagonal, seven times the thickness.
TEST(ThinPlaces, GetOneGoodLayer) {
  SurfaceMesh plate = thinPlate(1, 0.0005);
  for (std::size_t i = 1; i < plate.points.size(); i += 3) plate.points[i] *= 0.02;
  const SurfaceMesh made = surfaceOf(remesh(plate));
  MeshRun run(made.points, made.triangles, {});
  while (run.advance(10'000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  const std::size_t elements = run.volume().tetrahedra.size() / 4;
  EXPECT_LT(run.statistics().poor.count, elements / 50);
}

/// One good layer of a plate of 1/100 000 would need billions of elements.
TEST(ThinPlaces, HaveFewElementsIfNoneCanBeGood) {
  const SurfaceRemesh result = remesh(thinPlate(1, 1e-5));
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_LT(result.triangles.size() / 3, 30'000U);
}

}  // namespace
}  // namespace tetrafront::testing
