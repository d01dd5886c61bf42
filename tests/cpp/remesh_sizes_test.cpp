/// @file Sizes, sources and stretching of remeshed surfaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "base/task.h"
#include "geom/measure.h"
#include "quality/metrics.h"
#include "remesh/reference_surface.h"
#include "remesh/thickness.h"
#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 3>;

TEST(Remesh, ReachesTheTargetSize) {
  RemeshOptions options;
  options.size = 0.1;
  const SurfaceMesh made = surfaceOf(remesh(gridCube(1), options));
  std::size_t inBand = 0;
  const EdgeUse edges = countEdges(made);
  for (const auto& [edge, count] : edges) {
    const double length = glm::length(pointOf(made, edge.second) - pointOf(made, edge.first));
    if (length >= 0.06 && length <= 0.15) ++inBand;
  }
  EXPECT_GE(static_cast<double>(inBand), 0.97 * static_cast<double>(edges.size()));
}

/// Narrow strips bend by tiny angles each; their curvature counts all the same.
TEST(Remesh, AutomaticSizesHardlyDependOnTheNumberOfStrips) {
  const auto expected = [](int strips) {
    const SurfaceMesh bar = coarseBar(strips, 4.0);
    SurfaceSizeProposer proposer(bar.points, bar.triangles, {}, {});
    while (!proposer.advance(1U << 20U)) {
    }
    return proposer.result().triangles;
  };
  const double coarse = expected(80);
  EXPECT_NEAR(expected(9000), coarse, 0.03 * coarse);
}

/// A bar whose side has the outline of two regular polygons, one turned by a part of its angle: where they cross, it is hollow.
SurfaceMesh barOfTwoTessellations() {
  constexpr int kSides = 120;
  constexpr double kAngle = 2.0 * std::numbers::pi / kSides;
  constexpr double kTurn = 0.13 * kAngle;
  std::vector<std::array<double, 2>> ring;  // angle, radius
  for (int i = 0; i < kSides; ++i) {
    const double angle = i * kAngle;
    const double middle = std::cos(kAngle / 2.0);
    ring.push_back({angle, 1.0});
    ring.push_back({angle + kTurn / 2.0, middle / std::cos((kAngle - kTurn) / 2.0)});
    ring.push_back({angle + kTurn, 1.0});
    ring.push_back({angle + (kTurn + kAngle) / 2.0, middle / std::cos(kTurn / 2.0)});
  }
  SurfaceMesh mesh;
  for (const double z : {0.0, 4.0}) {
    for (const auto& [angle, radius] : ring) {
      mesh.points.insert(mesh.points.end(),
                         {radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  mesh.points.insert(mesh.points.end(), {0.0, 0.0, 0.0, 0.0, 0.0, 4.0});
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {i, j, n + j, i, n + j, n + i});
    mesh.triangles.insert(mesh.triangles.end(), {2 * n, j, i, 2 * n + 1, n + i, n + j});
  }
  return mesh;
}

TEST(Remesh, TessellationsThatWereCutAlongEachOtherNeedNoSmallTriangles) {
  for (const auto& [minSize, factor] : {std::pair{0.1, 1.5}, std::pair{0.0, 4.0}}) {
    RemeshOptions options;
    options.minSize = minSize;
    const SurfaceRemesh cut = remesh(barOfTwoTessellations(), options);
    const SurfaceRemesh plain = remesh(coarseBar(120, 4.0), options);
    EXPECT_LT(static_cast<double>(cut.triangles.size()),
              factor * static_cast<double>(plain.triangles.size()));
    EXPECT_GT(cut.smallestAngle, 20.0);
  }
}

/// Bends of a wave cancel out in a cell, but its crests and hollows are round.
TEST(Remesh, WavesHaveTheCurvatureOfTheirCrests) {
  const SurfaceMesh flat = gridCube(60);
  SurfaceMesh wavy = flat;
  const double top = *std::ranges::max_element(flat.points);
  for (std::size_t i = 0; i < wavy.points.size(); i += 3) {
    if (flat.points[i + 2] != top) continue;
    wavy.points[i + 2] += 0.004 * top * std::sin(20.0 * std::numbers::pi * flat.points[i] / top);
  }
  RemeshOptions options;
  options.minSize = 0.025 * top;
  options.anglePerEdge = 20.0;
  EXPECT_GT(remesh(wavy, options).triangles.size(), 2 * remesh(flat, options).triangles.size());
}

TEST(Remesh, ThicknessIsTheDistanceThroughTheRegion) {
  const SurfaceMesh cube = gridCube(3);
  ReferenceSurface reference(cube, {});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  const Vec3 onFace(0.31, 0.47, 0.0);
  const double unlimited = 10.0;
  EXPECT_NEAR(findThickness(reference, onFace, Vec3(0.0, 0.0, 1.0), unlimited).distance, 1.0,
              1e-12);
  // Obliquely: the ray leaves through the opposite face.
  const Vec3 oblique = glm::normalize(Vec3(0.2, -0.1, 1.0));
  EXPECT_NEAR(findThickness(reference, onFace, oblique, unlimited).distance, 1.0 / oblique.z,
              1e-12);
  EXPECT_TRUE(std::isinf(findThickness(reference, onFace, Vec3(0.0, 0.0, 1.0), 0.99).distance));
  EXPECT_TRUE(
      std::isinf(findThickness(reference, onFace, Vec3(0.0, 0.0, -1.0), unlimited).distance));
}

TEST(Remesh, SourcesMakeTrianglesSmallerNearThem) {
  BackgroundGrid grid;
  SizeSource source;
  source.points[0] = Vec3(0.0);
  source.size = 0.02;
  grid.sources.push_back(source);
  RemeshOptions options;
  options.size = 0.3;
  const SurfaceMesh cube = gridCube(1);
  SurfaceRemesher remesher(cube.points, cube.triangles, {}, grid, options);
  while (!remesher.advance(1U << 20U)) {
  }
  const SurfaceMesh made = surfaceOf(remesher.result());
  double nearArea = 0.0;
  double nearCount = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    const Corners corners = cornersOf(made, t);
    if (glm::length(centroidOf(corners)) > 0.05) continue;
    nearArea += areaOf(corners);
    nearCount += 1.0;
  }
  ASSERT_GT(nearCount, 0.0);
  // An equilateral triangle of size h has the area 0.433 h^2; sizes grow by 0.3 x distance.
  EXPECT_LT(nearArea / nearCount, 0.433 * 0.04 * 0.04);
}

/// Remeshes two cubes with a region each; the left one has a largest volume, 0 for none.
SurfaceRemesh remeshTwoRegions(double volume, const RemeshOptions& options = {}) {
  const auto [box, regions] = twoRegions(volume);
  SurfaceRemesher remesher(box.points, box.triangles, {}, {}, options, regions);
  while (!remesher.advance(1U << 20U)) {
  }
  EXPECT_TRUE(remesher.result().diagnostics.empty());
  return remesher.result();
}

TEST(Remesh, TheLargestVolumeOfARegionAppliesToItsOwnTriangles) {
  constexpr double kVolume = 3e-5;
  constexpr double kEdge = 0.05;  // for this volume, a little less than its edge length
  RemeshOptions sized;
  sized.size = 0.25;
  for (const RemeshOptions& options : {RemeshOptions{}, sized}) {
    const HalfShare without = halvesOf(surfaceOf(remeshTwoRegions(0.0, options)));
    const HalfShare with = halvesOf(surfaceOf(remeshTwoRegions(kVolume, options)));
    // The left cube with its interface has six sides.
    EXPECT_GT(static_cast<double>(with.left), 0.75 * 6.0 / (0.433 * kEdge * kEdge));
    EXPECT_LT(with.longestLeft, 1.6 * kEdge);
    // Sizes grow by 0.3 per unit of distance from the interface, which has the smaller size.
    RemeshOptions everywhere = options;
    everywhere.maxVolume = kVolume;
    const HalfShare capped = halvesOf(surfaceOf(remeshTwoRegions(0.0, everywhere)));
    EXPECT_NEAR(static_cast<double>(with.left), static_cast<double>(capped.left),
                0.1 * static_cast<double>(capped.left));
    EXPECT_LT(with.right, capped.right / 4);
    EXPECT_GT(with.longestRight, 0.75 * without.longestRight);
  }
}

TEST(Remesh, TrianglesAreWellShapedWhereARegionWithALargestVolumeEnds) {
  const SurfaceRemesh made = remeshTwoRegions(3e-5);
  EXPECT_GT(made.smallestAngle, 20.0);
  EXPECT_GT(made.meanRadiusRatio, 0.8);
  EXPECT_LT(made.minSize, 0.06);
}

TEST(Remesh, RegionsWithoutALargestVolumeChangeNothing) {
  const auto [box, regions] = twoRegions(0.0);
  const SurfaceRemesh expected = remesh(box);
  EXPECT_EQ(remeshTwoRegions(0.0).points, expected.points);
  EXPECT_EQ(remeshTwoRegions(0.0).triangles, expected.triangles);
  // Far above the volume of any element.
  EXPECT_EQ(remeshTwoRegions(1e9).triangles, expected.triangles);
}

/// Number of triangles of a cube remeshed with a source at a corner.
std::size_t countWithSource(double sizeAtCorner) {
  BackgroundGrid grid;
  if (sizeAtCorner > 0.0) {
    SizeSource source;
    source.points[0] = Vec3(0.0);
    source.size = sizeAtCorner;
    grid.sources.push_back(source);
  }
  const SurfaceMesh cube = gridCube(1);
  SurfaceRemesher remesher(cube.points, cube.triangles, {}, grid, {});
  while (!remesher.advance(1U << 20U)) {
  }
  return remesher.result().triangles.size() / 3;
}

TEST(Remesh, SourcesCapAutomaticSizesAndReplaceNone) {
  const std::size_t automatic = countWithSource(0.0);
  EXPECT_EQ(countWithSource(1.0), automatic);
  EXPECT_GT(countWithSource(0.01), automatic);
}

/// A tetrahedron around the bodies with one target size everywhere.
BackgroundGrid constantGrid(BackgroundNode node) {
  BackgroundGrid grid;
  for (const Vec3& position : {Vec3(-30.0, -30.0, -30.0), Vec3(90.0, -30.0, -30.0),
                               Vec3(-30.0, 90.0, -30.0), Vec3(-30.0, -30.0, 90.0)}) {
    node.position = position;
    grid.nodes.push_back(node);
  }
  grid.tetrahedra = {{0, 1, 2, 3}};
  return grid;
}

struct MetricFigures {
  double share = 0.0;      ///< of the edges with a length of 0.6 to 1.5
  double meanRatio = 0.0;  ///< mean radius ratio
};

/// Measures triangles in the space in which the target element is regular with edge 1.
MetricFigures measureInMetric(const SurfaceMesh& mesh, const BackgroundNode& target) {
  const Vec3 along = glm::normalize(target.direction);
  const auto toUnit = [&](const Vec3& p) {
    return (p - along * (glm::dot(p, along) * (1.0 - 1.0 / target.stretching))) / target.size;
  };
  MetricFigures figures;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const auto [a, b, c] = cornersOf(mesh, t);
    const Corners corners{toUnit(a), toUnit(b), toUnit(c)};
    figures.meanRatio += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = glm::length(corners[(k + 1) % 3] - corners[k]);
      if (length >= 0.6 && length <= 1.5) figures.share += 1.0 / 3.0;
    }
  }
  figures.share /= countTriangles(mesh);
  figures.meanRatio /= countTriangles(mesh);
  return figures;
}

/// The tolerance caps long edges across a bend, but neither edges along the bend nor short edges across it.
TEST(RemeshStretched, TrianglesFollowTheMetric) {
  const std::vector<std::pair<Body, double>> bodies{
      {{"box", [] { return gridBox(Vec3(0.0), Vec3(2.0, 1.0, 1.0), {1, 1, 1}); }}, 0.05},
      {{"cylinder", [] { return coarseBar(64, 2.0); }}, 0.05},
      {{"tube", [] { return coarseTube(64, 0.5, 2.0); }}, 0.05},
      {{"sphere", [] { return geodesicSphere(12); }}, 0.05},
      {{"cylinder with a narrow tolerance", [] { return coarseBar(64, 2.0); }}, 2e-3},
      {{"tube with a narrow tolerance", [] { return coarseTube(64, 0.5, 2.0); }}, 2e-3},
  };
  for (const auto& [body, tolerance] : bodies) {
    const SurfaceMesh given = body.make();
    for (const double stretching : {4.0, 10.0}) {
      for (const Vec3& direction :
           {Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 0.6, 0.4)}) {
        if (tolerance < 0.01 && direction.x > 0.0) continue;
        // A sphere is the same in all directions.
        if (body.name == "sphere" && direction.y == 0.0) continue;
        if (stretching < 10.0 && direction.y == 0.0) continue;
        const BackgroundNode target{Vec3(0.0), 0.08, stretching, direction};
        RemeshOptions options;
        options.tolerance = tolerance;
        SurfaceRemesher remesher(given.points, given.triangles, {}, constantGrid(target), options);
        while (!remesher.advance(1U << 20U)) {
        }
        const SurfaceRemesh& result = remesher.result();
        ASSERT_TRUE(result.diagnostics.empty());
        const MetricFigures figures = measureInMetric(surfaceOf(result), target);
        EXPECT_GE(figures.share, 0.95) << body << ' ' << stretching << ' ' << direction.x;
        EXPECT_GE(figures.meanRatio, 0.85) << body << ' ' << stretching << ' ' << direction.x;
        EXPECT_LE(result.deviation, result.tolerance);
      }
    }
  }
}

/// The expected number of triangles is that of the stretched ones, not of small ones without stretching.
TEST(RemeshStretched, TheLimitOfTrianglesCountsStretchedOnes) {
  const SurfaceMesh given = gridBox(Vec3(0.0), Vec3(2.0, 1.0, 1.0), {1, 1, 1});
  const BackgroundNode target{Vec3(0.0), 0.08, 10.0, Vec3(1.0, 0.6, 0.4)};
  const auto made = [&](std::uint32_t maxTriangles) {
    RemeshOptions options;
    options.tolerance = 0.05;
    options.maxTriangles = maxTriangles;
    SurfaceRemesher remesher(given.points, given.triangles, {}, constantGrid(target), options);
    while (!remesher.advance(1U << 20U)) {
    }
    return remesher.result();
  };
  const std::size_t count = made(1'000'000).triangles.size() / 3;
  EXPECT_TRUE(
      made(static_cast<std::uint32_t>(1.6 * static_cast<double>(count))).diagnostics.empty());
  EXPECT_FALSE(
      made(static_cast<std::uint32_t>(0.4 * static_cast<double>(count))).diagnostics.empty());
}

TEST(Remesh, LayersAndAnglePerEdgeAlsoCountWithASize) {
  RemeshOptions options;
  options.size = 0.5;
  const SurfaceMesh plate = thinPlate(4, 0.1);
  const std::size_t count = remesh(plate, options).triangles.size();
  options.layers = 1.0;
  EXPECT_GT(remesh(plate, options).triangles.size(), 2 * count);
  options.layers = -1.0;
  options.tolerance = 0.1;
  const SurfaceMesh sphere = geodesicSphere(24);
  const std::size_t coarse = remesh(sphere, options).triangles.size();
  options.anglePerEdge = 10.0;
  EXPECT_GT(remesh(sphere, options).triangles.size(), 2 * coarse);
}

TEST(Remesh, RefusesSizesThatAskForTooManyTriangles) {
  RemeshOptions options;
  options.size = 1e-9;
  const SurfaceRemesh result = remesh(gridCube(1), options);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].code, DiagnosticCode::kTooManyElements);
  EXPECT_EQ(result.diagnostics[0].entities.at(0).kind, EntityKind::kTriangle);
  // Estimates are reported up to 1e15.
  EXPECT_NEAR(result.diagnostics[0].values[0], 1e15, 1.0);

  // The given triangles are never too many, and the estimate is near the real number.
  options.size = 0.1;
  const std::size_t count = remesh(gridCube(1), options).triangles.size() / 3;
  options.maxTriangles = static_cast<std::uint32_t>(1.2 * static_cast<double>(count));
  EXPECT_TRUE(remesh(gridCube(1), options).diagnostics.empty());
  options.maxTriangles = static_cast<std::uint32_t>(0.8 * static_cast<double>(count));
  EXPECT_FALSE(remesh(gridCube(1), options).diagnostics.empty());
  EXPECT_TRUE(remesh(gridCube(20), options).diagnostics.empty());
}

}  // namespace
}  // namespace tetrafront::testing
