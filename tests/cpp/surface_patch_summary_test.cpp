// The statistics of patches, compared with surfaces whose distance from a point is known.

#include "surface/patch_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

/// The largest distance over the positions that a summary samples.
template <class Distance>
double largestDistance(const SurfaceMesh& mesh, Distance&& distance) {
  double largest = 0.0;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const auto corner = [&](std::size_t k) { return pointOf(mesh, mesh.triangles[3 * t + k]); };
    largest = std::max(largest, distance((corner(0) + corner(1) + corner(2)) / 3.0));
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, distance(0.5 * (corner(k) + corner((k + 1) % 3))));
  }
  return largest;
}

/// Distance from the parabola y = x^2, by Newton's method for the squared distance.
double distanceFromParabola(const Vec3& position) {
  double t = position.x;
  for (int i = 0; i < 50; ++i) {
    const double slope = 2.0 * (t - position.x) + 4.0 * t * (t * t - position.y);
    t -= slope / (2.0 + 12.0 * t * t - 4.0 * position.y);
  }
  return std::hypot(t - position.x, t * t - position.y);
}

/// Distance from the hyperbolic paraboloid z = x y, by minimizing along one coordinate after the other.
double distanceFromSaddle(const Vec3& position) {
  double x = position.x;
  double y = position.y;
  for (int i = 0; i < 200; ++i) {
    x = (position.x + y * position.z) / (1.0 + y * y);
    y = (position.y + x * position.z) / (1.0 + x * x);
  }
  return glm::length(Vec3(x, y, x * y) - position);
}

TEST(SurfacePatchSummary, ParabolicCylinderHasTheChordDeviationOfItsTriangles) {
  ModelBuilder builder;
  const std::uint32_t low = builder.line(LineType::kParabolic, {{-1, 1, 0}, {0, 0, 0}, {1, 1, 0}});
  const std::uint32_t high = builder.line(LineType::kParabolic, {{-1, 1, 2}, {0, 0, 2}, {1, 1, 2}});
  builder.patch(PatchType::kCoons, {{{low, false},
                                     builder.straight({1, 1, 0}, {1, 1, 2}),
                                     {high, true},
                                     builder.straight({-1, 1, 2}, {-1, 1, 0})}});
  double previous = 1.0;
  for (const double size : {0.4, 0.2, 0.1, 0.05}) {
    const MeshedSurface meshed = meshSurface(builder.model, SizeField::uniform(size));
    ASSERT_EQ(meshed.patches.size(), 1U);
    const double deviation = meshed.patches.front().chordDeviation;
    const double exact = largestDistance(meshed.mesh, distanceFromParabola);
    EXPECT_NEAR(deviation, exact, 0.1 * exact + size * exact) << size;
    // The sagitta of a side at the vertex, where the radius of curvature is 1/2.
    EXPECT_GT(deviation, 0.5 * size * size / 4.0) << size;
    EXPECT_LT(deviation, 3.0 * size * size / 4.0) << size;
    EXPECT_LT(deviation, 0.5 * previous) << size;
    previous = deviation;
  }
}

TEST(SurfacePatchSummary, SaddleHasTheChordDeviationOfItsTriangles) {
  ModelBuilder builder;
  builder.patch(PatchType::kCoons,
                {builder.polygon({{-1, -1, 1}, {1, -1, -1}, {1, 1, 1}, {-1, 1, -1}})});
  for (const double size : {0.3, 0.1}) {
    const MeshedSurface meshed = meshSurface(builder.model, SizeField::uniform(size));
    const double exact = largestDistance(meshed.mesh, distanceFromSaddle);
    EXPECT_NEAR(meshed.patches.front().chordDeviation, exact, 0.05 * exact) << size;
  }
}

TEST(SurfacePatchSummary, PlanarPatchesHaveNoChordDeviation) {
  const Model model = boxModel({0, 0, 0}, {1, 2, 3});
  const SizeField field = SizeField::uniform(0.21);
  const MeshedSurface meshed = meshSurface(model, field);
  const SurfaceMeasures all = measure(meshed.mesh, field);
  ASSERT_EQ(meshed.patches.size(), model.patches.size());
  double ratios = 0.0;
  double least = 180.0;
  std::uint32_t triangles = 0;
  for (std::uint32_t patch = 0; patch < meshed.patches.size(); ++patch) {
    const PatchSummary& summary = meshed.patches[patch];
    EXPECT_EQ(summary.patch, patch);
    EXPECT_EQ(summary.triangles, std::ranges::count(meshed.mesh.trianglePatch, patch));
    EXPECT_LT(summary.chordDeviation, 1e-15);
    EXPECT_NEAR(summary.meanEdge, 1.0, 0.1);
    triangles += summary.triangles;
    ratios += summary.meanRadiusRatio * summary.triangles;
    least = std::min(least, summary.minAngle);
  }
  EXPECT_EQ(triangles, all.triangles);
  EXPECT_NEAR(ratios / triangles, all.meanRadiusRatio, 1e-12);
  EXPECT_NEAR(least, all.minAngle, 1e-9);
}

TEST(SurfacePatchSummary, MeanEdgeCountsEachEdgeOnce) {
  const Model model = randomCoonsModel(7, 0.2);
  const SizeField field = SizeField::uniform(0.11);
  const MeshedSurface meshed = meshSurface(model, field);
  EXPECT_NEAR(meshed.patches.front().meanEdge, measure(meshed.mesh, field).meanEdgeRatio, 1e-9);
}

TEST(SurfacePatchSummary, MeanEdgeIsMeasuredInTheMetric) {
  // Edges along x may be five times as long.
  BackgroundGrid grid = boxGrid({-1, -1, -1}, {5, 5, 5}, [](const Vec3&) { return 0.1; });
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = 5.0;
    node.direction = {1, 0, 0};
  }
  const SizeField field = SizeField::fromGrid(GridLocator(grid));
  const MeshedSurface meshed = meshSurface(polygonModel({squareCorners({0, 0, 0}, 2.0)}), field);
  EXPECT_NEAR(meshed.patches.front().meanEdge, 1.0, 0.1);
  // The square has the area 80 in the metric.
  EXPECT_NEAR(meshed.patches.front().triangles, 80.0 * 4.0 / std::sqrt(3.0), 30.0);
}

TEST(SurfacePatchSummary, RunsHaveOnePerPatchOfAModelAndNoneForAGivenSurface) {
  MeshOptions options;
  options.size = 0.5;
  MeshRun run(boxModel({0, 0, 0}, {1, 1, 1}), {}, options);
  EXPECT_TRUE(run.patchSummaries().empty());
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.patchSummaries().size(), 6U);
  const SurfaceMesh given = gridCube(2);
  MeshRun fill(given.points, given.triangles, {});
  while (fill.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_TRUE(fill.patchSummaries().empty());
}

}  // namespace
}  // namespace tetrafront::testing
