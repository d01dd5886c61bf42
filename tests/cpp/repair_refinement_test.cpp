/// @file Refinement of given surfaces until their triangles fit the target sizes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::testing {
namespace {

SurfaceRefinement refine(const SurfaceMesh& mesh, const BackgroundGrid& grid,
                         const MeshOptions& options = {}, std::uint32_t budget = 1U << 20U) {
  SurfaceRefiner refiner(mesh.points, mesh.triangles, grid, options);
  while (!refiner.advance(budget)) {
  }
  return refiner.result();
}

MeshOptions sized(double size) {
  MeshOptions options;
  options.size = size;
  return options;
}

SurfaceMesh surfaceOf(const SurfaceRefinement& refined) {
  SurfaceMesh mesh;
  mesh.points = refined.points;
  mesh.triangles = refined.triangles;
  return mesh;
}

std::array<Vec3, 3> cornersOf(const SurfaceMesh& mesh, std::size_t t) {
  return {pointOf(mesh, mesh.triangles[3 * t]), pointOf(mesh, mesh.triangles[3 * t + 1]),
          pointOf(mesh, mesh.triangles[3 * t + 2])};
}

double areaOf(const std::array<Vec3, 3>& p) {
  return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
}

double smallestAngle(const SurfaceMesh& mesh) {
  double smallest = 180.0;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const auto p = cornersOf(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 u = glm::normalize(p[(k + 1) % 3] - p[k]);
      const Vec3 v = glm::normalize(p[(k + 2) % 3] - p[k]);
      smallest = std::min(smallest, std::acos(std::clamp(glm::dot(u, v), -1.0, 1.0)));
    }
  }
  return smallest * 180.0 / 3.14159265358979323846;
}

/// Returns the number of triangles at each edge.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesOf(const SurfaceMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    const std::uint32_t a = mesh.triangles[h];
    const std::uint32_t b = mesh.triangles[h % 3 == 2 ? h - 2 : h + 1];
    ++edges[std::minmax(a, b)];
  }
  return edges;
}

/// Expects that the parts of each given triangle lie in it, have its orientation and cover it.
void expectSameShape(const SurfaceMesh& given, const SurfaceRefinement& refined) {
  const SurfaceMesh mesh = surfaceOf(refined);
  ASSERT_EQ(refined.origin.size(), triangleCount(mesh));
  ASSERT_EQ(refined.points.size(), given.points.size() + 3 * refined.splitEdges);
  EXPECT_TRUE(std::equal(given.points.begin(), given.points.end(), refined.points.begin()));
  std::vector<double> areas(triangleCount(given), 0.0);
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const auto whole = cornersOf(given, refined.origin[t]);
    const auto part = cornersOf(mesh, t);
    const Vec3 normal = glm::cross(whole[1] - whole[0], whole[2] - whole[0]);
    const double scale = glm::dot(normal, normal);
    EXPECT_GT(glm::dot(glm::cross(part[1] - part[0], part[2] - part[0]), normal), 0.0);
    areas[refined.origin[t]] += areaOf(part);
    for (const Vec3& p : part) {
      EXPECT_LT(std::fabs(glm::dot(p - whole[0], normal)), 1e-13 * std::sqrt(scale));
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = glm::cross(whole[(k + 1) % 3] - whole[k], p - whole[k]);
        EXPECT_GT(glm::dot(side, normal), -1e-12 * scale);
      }
    }
  }
  for (std::size_t t = 0; t < areas.size(); ++t) {
    EXPECT_NEAR(areas[t], areaOf(cornersOf(given, t)), 1e-12 * areas[t]) << t;
  }
}

MeshRun filled(const SurfaceMesh& surface, const BackgroundGrid& grid, const MeshOptions& options) {
  MeshRun run(surface.points, surface.triangles, grid, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(complaintAbout(run.volume(), run.surface()), "");
  EXPECT_TRUE(std::ranges::none_of(run.diagnostics(), [](const Diagnostic& found) {
    return found.code == DiagnosticCode::kCoarseSurface;
  }));
  return run;
}

/// Returns a drum whose lids are fans of needles around a node of the rim.
SurfaceMesh drumOfNeedles(std::uint32_t sectors) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const double angle = 2.0 * 3.14159265358979323846 * i / sectors;
    const double x = std::cos(angle);
    const double y = std::sin(angle);
    mesh.points.insert(mesh.points.end(), {x, y, 0.0, x, y, 1.0});
  }
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % sectors);
    mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    if (i == 0 || i + 1 == sectors) continue;
    mesh.triangles.insert(mesh.triangles.end(), {0, b, a, 1, a + 1, b + 1});
  }
  return mesh;
}

TEST(SurfaceRefiner, RefinesACubeOfTwelveTrianglesToAnySize) {
  const SurfaceMesh cube = gridCube(1);
  for (const double size : {0.31, 0.15, 0.1}) {
    const SurfaceRefinement refined = refine(cube, {}, sized(size));
    ASSERT_TRUE(refined.diagnostics.empty());
    expectSameShape(cube, refined);
    const SurfaceMesh mesh = surfaceOf(refined);
    EXPECT_EQ(enclosedVolume(mesh), 1.0);
    EXPECT_NEAR(smallestAngle(mesh), 45.0, 1e-9);
    for (const auto& [edge, triangles] : edgesOf(mesh)) {
      EXPECT_EQ(triangles, 2);
      EXPECT_LE(glm::length(pointOf(mesh, edge.first) - pointOf(mesh, edge.second)),
                std::sqrt(2.0) * size + 1e-12);
    }
    const MeshRun run = filled(mesh, {}, sized(size));
    EXPECT_GE(run.quality().minDihedral, 30.0) << size;
    EXPECT_LE(run.quality().maxDihedral, 135.0) << size;
    EXPECT_NEAR(run.statistics().meanEdge, 1.0, 0.12) << size;
  }
}

TEST(SurfaceRefiner, LeavesAFineSurfaceUnchanged) {
  const SurfaceMesh sphere = geodesicSphere(6);
  for (const SurfaceRefinement& refined : {refine(sphere, {}, sized(0.2)), refine(sphere, {}),
                                           refine(sphere, sourceAt(Vec3(0), 0.2, 0))}) {
    EXPECT_TRUE(refined.diagnostics.empty());
    EXPECT_EQ(refined.splitEdges, 0U);
    EXPECT_EQ(refined.points, sphere.points);
    EXPECT_EQ(refined.triangles, sphere.triangles);
  }
}

TEST(SurfaceRefiner, ReturnsTheLongestGivenEdgeInTargetLengths) {
  const SurfaceMesh cube = gridCube(1);
  const double diagonal = std::sqrt(2.0);
  EXPECT_NEAR(refine(cube, {}, sized(0.1)).lengthRatio, diagonal / 0.1, 1e-9);
  EXPECT_NEAR(refine(cube, {}, sized(1.0)).lengthRatio, diagonal, 1e-9);
  // Without sizes, the mean edge at a node is the target length there.
  EXPECT_GT(refine(cube, {}).lengthRatio, 1.0);
  EXPECT_LT(refine(cube, {}).lengthRatio, diagonal);
  // A source at a corner.
  EXPECT_GT(refine(cube, sourceAt(Vec3(0.0), 0.05, 0.1)).lengthRatio, 2.0);
}

/// A ball of fine triangles in a box of twelve: the faces near the ball are split, and a ball alone stays as it is.
TEST(SurfaceRefiner, WithoutSizesSplitsWhatIsLargeBesideSmallTriangles) {
  SurfaceMesh box = gridBox(Vec3(-2.0), Vec3(2.0), {1, 1, 1});
  const SurfaceMesh ball = geodesicSphere(8);
  EXPECT_LT(refine(ball, {}).lengthRatio, 2.0);
  const auto first = static_cast<std::uint32_t>(box.points.size() / 3);
  box.points.insert(box.points.end(), ball.points.begin(), ball.points.end());
  for (const std::uint32_t node : ball.triangles) box.triangles.push_back(first + node);
  const SurfaceRefinement refined = refine(box, {});
  EXPECT_GT(refined.lengthRatio, 4.0);
  expectSameShape(box, refined);
  const auto ofBall =
      std::ranges::count_if(refined.origin, [](std::uint32_t t) { return t >= 12; });
  EXPECT_EQ(static_cast<std::size_t>(ofBall), ball.triangles.size() / 3);
  EXPECT_GT(refined.origin.size() - static_cast<std::size_t>(ofBall), 100U);
}

TEST(SurfaceRefiner, KeepsAnglesAboveHalfOfTheGivenOnes) {
  const SurfaceMesh drum = drumOfNeedles(40);
  const double before = smallestAngle(drum);
  for (const double size : {0.4, 0.2}) {
    const SurfaceRefinement refined = refine(drum, {}, sized(size));
    expectSameShape(drum, refined);
    const SurfaceMesh mesh = surfaceOf(refined);
    EXPECT_GT(smallestAngle(mesh), 0.5 * before - 1e-9);
    EXPECT_NEAR(enclosedVolume(mesh), enclosedVolume(drum), 1e-13);
    filled(mesh, {}, sized(size));
  }
}

/// Interfaces have edges with three and four triangles.
TEST(SurfaceRefiner, BisectsEdgesInAllTheirTriangles) {
  const SurfaceMesh divided = dividedBox({2, 2, 1}, 1);
  const BackgroundGrid grid = sourceAt(Vec3(1.0, 1.0, 0.5), 0.1, 0.1);
  const SurfaceRefinement refined = refine(divided, grid);
  expectSameShape(divided, refined);
  std::map<int, int> counts;
  for (const auto& [edge, triangles] : edgesOf(surfaceOf(refined))) ++counts[triangles];
  EXPECT_GT(counts[4], 4);
  EXPECT_GT(counts[3], 8);
  EXPECT_EQ(counts[1], 0);
  const MeshRun run = filled(surfaceOf(refined), grid, {});
  EXPECT_EQ(run.statistics().regions.size(), 4U);
  for (const RegionStatistics& region : run.statistics().regions) {
    EXPECT_NEAR(region.volume, 1.0, 1e-12);
  }
}

/// The source is near no node and no edge.
TEST(SurfaceRefiner, FindsASmallSourceInsideATriangle) {
  const SurfaceMesh cube = gridCube(1);
  const Vec3 within(0.37, 0.13, 0.0);
  const SurfaceRefinement refined = refine(cube, sourceAt(within, 0.01, 0.02));
  expectSameShape(cube, refined);
  const SurfaceMesh mesh = surfaceOf(refined);
  double shortest = 1.0;
  for (const auto& [edge, triangles] : edgesOf(mesh)) {
    shortest =
        std::min(shortest, glm::length(pointOf(mesh, edge.first) - pointOf(mesh, edge.second)));
  }
  EXPECT_LT(shortest, 0.0142);
  EXPECT_GT(shortest, 0.004);
  EXPECT_GE(smallestAngle(mesh), 22.0);
  EXPECT_LT(triangleCount(mesh), 3000U);
}

TEST(SurfaceRefiner, MeasuresEdgesInTheMetricOfAStretchedGrid) {
  const SurfaceMesh cube = gridCube(1);
  BackgroundGrid grid = boxGrid(Vec3(-2.0), Vec3(2.0), [](const Vec3&) { return 0.1; });
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = 4.0;
    node.direction = Vec3(1.0, 0.0, 0.0);
  }
  const SurfaceRefinement refined = refine(cube, grid);
  expectSameShape(cube, refined);
  const SurfaceMesh mesh = surfaceOf(refined);
  double longest = 0.0;
  for (const auto& [edge, triangles] : edgesOf(mesh)) {
    Vec3 along = pointOf(mesh, edge.first) - pointOf(mesh, edge.second);
    along.x *= 0.25;
    longest = std::max(longest, glm::length(along) / 0.1);
  }
  EXPECT_LE(longest, std::sqrt(2.0) + 1e-9);
  EXPECT_LT(3 * triangleCount(mesh), triangleCount(surfaceOf(refine(cube, {}, sized(0.1)))) * 2);
}

TEST(SurfaceRefiner, DoesNotDependOnTheSlices) {
  const SurfaceMesh drum = drumOfNeedles(12);
  const BackgroundGrid grid = sourceAt(Vec3(0.3, 0.2, 1.0), 0.02, 0.1);
  const SurfaceRefinement whole = refine(drum, grid);
  const SurfaceRefinement sliced = refine(drum, grid, {}, 1);
  EXPECT_GT(whole.splitEdges, 100U);
  EXPECT_EQ(sliced.points, whole.points);
  EXPECT_EQ(sliced.triangles, whole.triangles);
  EXPECT_EQ(sliced.origin, whole.origin);
}

TEST(SurfaceRefiner, TheLargestVolumeOfARegionAppliesToItsOwnTriangles) {
  constexpr double kVolume = 3e-5;
  const auto refined = [](double volume, const MeshOptions& options) {
    const auto [box, regions] = twoRegions(volume);
    SurfaceRefiner refiner(box.points, box.triangles, {}, options, 0.0, regions);
    while (!refiner.advance(1U << 20U)) {
    }
    EXPECT_TRUE(refiner.result().diagnostics.empty());
    return halvesOf(surfaceOf(refiner.result()));
  };
  MeshOptions everywhere;
  everywhere.maxVolume = kVolume;
  const HalfShare capped = refined(0.0, everywhere);
  for (const MeshOptions& options : {MeshOptions{}, sized(0.5)}) {
    const HalfShare without = refined(0.0, options);
    const HalfShare with = refined(kVolume, options);
    EXPECT_EQ(with.longestLeft, capped.longestLeft);
    EXPECT_NEAR(static_cast<double>(with.left), static_cast<double>(capped.left),
                0.02 * static_cast<double>(capped.left));
    EXPECT_LT(with.right, capped.right / 4);
    EXPECT_GE(with.longestRight, 0.7 * without.longestRight);
  }
}

TEST(SurfaceRefiner, RefusesTooManyTriangles) {
  const SurfaceMesh cube = gridCube(1);
  for (const double size : {1e-5, 1e-200}) {
    const SurfaceRefinement refined = refine(cube, {}, sized(size));
    ASSERT_EQ(refined.diagnostics.size(), 1U);
    EXPECT_EQ(refined.diagnostics[0].code, DiagnosticCode::kTooManyElements);
    EXPECT_EQ(refined.diagnostics[0].entities[0].kind, EntityKind::kTriangle);
    EXPECT_GT(refined.diagnostics[0].values[0], 1e10);
    EXPECT_TRUE(refined.triangles.empty());
  }
  // The samples miss a source this small; the refinement finds it.
  MeshOptions few;
  few.maxTetrahedra = 4000;
  const SurfaceRefinement refined = refine(cube, sourceAt(Vec3(0.37, 0.13, 0.0), 1e-6, 0.01), few);
  ASSERT_EQ(refined.diagnostics.size(), 1U);
  EXPECT_EQ(refined.diagnostics[0].code, DiagnosticCode::kTooManyElements);
}

TEST(SurfaceRefiner, RefusesTooManyTetrahedraBeforeItRefines) {
  const SurfaceMesh cube = gridCube(1);
  MeshOptions options = sized(0.02);
  const double expected = 8.485281374238571 / (0.02 * 0.02 * 0.02);
  options.maxTetrahedra = static_cast<std::uint32_t>(0.9 * expected);
  EXPECT_TRUE(refine(cube, {}, options).diagnostics.empty())
      << "the triangles alone are not too many";
  std::uint32_t steps = 0;
  SurfaceRefiner refiner(cube.points, cube.triangles, {}, options, 1.0);
  while (!refiner.advance(1U)) ++steps;
  EXPECT_LT(steps, 100U) << "refused before it bisects an edge";
  const SurfaceRefinement& refused = refiner.result();
  ASSERT_EQ(refused.diagnostics.size(), 1U);
  EXPECT_EQ(refused.diagnostics[0].code, DiagnosticCode::kTooManyElements);
  EXPECT_TRUE(refused.diagnostics[0].entities.empty());
  EXPECT_NEAR(refused.diagnostics[0].values[0] / expected, 1.0, 1e-9);
  EXPECT_EQ(refused.diagnostics[0].values[1], options.maxTetrahedra);
  options.maxTetrahedra = static_cast<std::uint32_t>(1.1 * expected);
  SurfaceRefiner fitting(cube.points, cube.triangles, {}, options, 1.0);
  while (!fitting.advance(1U << 20U)) {
  }
  EXPECT_TRUE(fitting.result().diagnostics.empty());
}

TEST(SurfaceRefiner, AcceptsAnySurfaceThatIsFineEnough) {
  const SurfaceMesh sphere = geodesicSphere(8);
  const auto triangles = static_cast<std::uint32_t>(sphere.triangles.size() / 3);
  MeshOptions few = sized(0.3);
  few.maxTetrahedra = triangles;
  const SurfaceRefinement kept = refine(sphere, {}, few);
  EXPECT_TRUE(kept.diagnostics.empty());
  EXPECT_EQ(kept.triangles, sphere.triangles);
  few = sized(0.05);
  few.maxTetrahedra = triangles;
  EXPECT_EQ(refine(sphere, {}, few).diagnostics.size(), 1U);
}

TEST(SurfaceRefiner, ReportsInvalidInput) {
  SurfaceMesh cube = gridCube(1);
  cube.triangles[1] = cube.triangles[0];
  EXPECT_EQ(refine(cube, {}, sized(0.1)).diagnostics.at(0).code,
            DiagnosticCode::kDegenerateTriangle);
  cube.triangles[1] = 99;
  EXPECT_EQ(refine(cube, {}, sized(0.1)).diagnostics.at(0).code, DiagnosticCode::kIndexOutOfRange);
  EXPECT_EQ(refine(gridCube(1), sourceAt(Vec3(0), -1.0, 0)).diagnostics.at(0).code,
            DiagnosticCode::kSourceOutOfRange);
}

}  // namespace
}  // namespace tetrafront::testing
