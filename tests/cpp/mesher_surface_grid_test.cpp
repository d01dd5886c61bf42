/// A given surface with sizes from a background grid and from sources instead of its own edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

MeshRun filled(const SurfaceMesh& surface, const BackgroundGrid& grid,
               const MeshOptions& options = {}) {
  MeshRun run(surface.points, surface.triangles, grid, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  return run;
}

std::size_t countOf(const MeshRun& run) { return run.volume().tetrahedra.size() / 4; }

BackgroundGrid gridOfSize(double size) {
  return boxGrid(Vec3(-2.0), Vec3(2.0), [size](const Vec3&) { return size; });
}

void expectValid(const MeshRun& run) {
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(complaintAbout(run.volume(), run.surface()), "");
}

TEST(SurfaceWithGrid, IsFilledWithTheGridsSizes) {
  const SurfaceMesh sphere = geodesicSphere(8);  // edges of about 0.13
  const MeshRun own = filled(sphere, {});
  for (const double size : {0.08, 0.13, 0.4}) {
    const MeshRun run = filled(sphere, gridOfSize(size));
    expectValid(run);
    EXPECT_EQ(size < 0.1, countOf(run) > 2 * countOf(own)) << size;
    EXPECT_EQ(size > 0.3, countOf(run) < countOf(own)) << size;
  }
}

TEST(SurfaceWithGrid, WithoutNodesKeepsItsOwnSizes) {
  const SurfaceMesh sphere = geodesicSphere(6);
  MeshRun own(sphere.points, sphere.triangles, {});
  while (own.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(filled(sphere, {}).fingerprint(), own.fingerprint());
}

TEST(SurfaceWithGrid, SizesThatItsTrianglesAllowDoNotDependOnTheSlices) {
  const SurfaceMesh sphere = geodesicSphere(5);  // edges of about 0.2
  MeshOptions options;
  options.size = 0.08;
  MeshRun inOne(sphere.points, sphere.triangles, options);
  while (inOne.advance(1U << 30U) == MeshStatus::kRunning) {
  }
  MeshRun inMany(sphere.points, sphere.triangles, options);
  while (inMany.advance(7) == MeshStatus::kRunning) {
  }
  expectValid(inOne);
  EXPECT_EQ(inOne.fingerprint(), inMany.fingerprint());
}

TEST(SurfaceWithGrid, SourcesCapItsOwnSizes) {
  const SurfaceMesh sphere = geodesicSphere(6);
  BackgroundGrid grid;
  grid.sources.emplace_back();
  grid.sources[0].size = 0.06;
  grid.sources[0].distance = 0.4;
  const MeshRun run = filled(sphere, grid);
  expectValid(run);
  EXPECT_GT(countOf(run), 2 * countOf(filled(sphere, {})));
}

TEST(SurfaceWithGrid, IsStretchedWhereTheGridAsksForIt) {
  const SurfaceMesh cube = gridCube(10);
  BackgroundGrid grid = gridOfSize(0.08);
  const MeshRun round = filled(cube, grid);
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = 3.0;
    node.direction = Vec3(1.0, 0.0, 0.0);
  }
  const MeshRun stretched = filled(cube, grid);
  expectValid(stretched);
  EXPECT_LT(2 * countOf(stretched), countOf(round));
}

const Diagnostic* coarsenessOf(const MeshRun& run) {
  const auto found =
      std::ranges::find(run.diagnostics(), DiagnosticCode::kCoarseSurface, &Diagnostic::code);
  return found == run.diagnostics().end() ? nullptr : &*found;
}

void expectGoodAngles(const MeshRun& run) {
  expectValid(run);
  EXPECT_GE(run.quality().minDihedral, 30.0);
  EXPECT_LE(run.quality().maxDihedral, 135.0);
}

/// If the sizes of the grid are far above the surface's own edges, sizes grow from these edges, and
/// the elements have good angles.
TEST(SurfaceWithGrid, SizesFarAboveTheTrianglesLeaveNoSlivers) {
  const SurfaceMesh sphere = geodesicSphere(11);
  BackgroundGrid stretched = gridOfSize(0.4);
  for (BackgroundNode& node : stretched.nodes) node.stretching = 1.2;
  for (const BackgroundGrid& grid : {gridOfSize(0.4), stretched}) {
    const MeshRun run = filled(sphere, grid);
    expectValid(run);
    EXPECT_EQ(run.statistics().outOfRange, 0U);
    EXPECT_GT(run.statistics().meanEdge, 0.88);
    EXPECT_EQ(coarsenessOf(run), nullptr);
  }
}

/// If the target size is far below the surface's own edges, however it is specified, sizes fall
/// from those of the triangles, and the elements have good angles.
TEST(SurfaceWithGrid, SizesFarBelowTheTrianglesLeaveNoSlivers) {
  const SurfaceMesh sphere = geodesicSphere(6);
  MeshOptions fine;
  fine.size = 0.06;
  BackgroundGrid stretched = gridOfSize(0.06);
  for (BackgroundNode& node : stretched.nodes) node.stretching = 1.5;
  const std::array runs{filled(sphere, {}, fine), filled(sphere, gridOfSize(0.06)),
                        filled(sphere, stretched),
                        filled(sphere, sourceAt(Vec3(0, 0, 1), 0.04, 0.2)),
                        filled(sphere, sourceAt(Vec3(0.2), 0.02, 0.05))};
  for (const MeshRun& run : runs) {
    expectValid(run);
    EXPECT_EQ(run.statistics().outOfRange, 0U);
    EXPECT_EQ(run.statistics().limitedByBoundary, 0U);
    EXPECT_NEAR(run.statistics().meanEdgeOfAchievable, 1.0, 0.12);
    const double estimated = run.progress().expectedTetrahedra;
    const auto count = static_cast<double>(countOf(run));
    EXPECT_LT(std::max(estimated / count, count / estimated), 1.5);
  }
  expectGoodAngles(runs[0]);
  const auto count = static_cast<double>(countOf(runs[0]));
  EXPECT_NEAR(static_cast<double>(countOf(runs[1])), count, 0.02 * count) << "one rule for all";
}

TEST(SurfaceWithGrid, WarnsOfTrianglesLargerThanTheTargetSize) {
  const SurfaceMesh cube = gridCube(1);
  MeshOptions options;
  options.size = 0.05;
  const MeshRun run = filled(cube, {}, options);
  expectGoodAngles(run);
  const Diagnostic* coarse = coarsenessOf(run);
  ASSERT_NE(coarse, nullptr);
  EXPECT_EQ(coarse->severity, Severity::kWarning);
  EXPECT_EQ(coarse->values[0], 12.0);
  EXPECT_NEAR(coarse->values[1], std::sqrt(2.0) / 0.05, 1e-9);
  EXPECT_GT(run.statistics().meanEdge, 15.0) << "in units of the target length";
  EXPECT_NEAR(run.statistics().meanEdgeOfAchievable, 1.0, 0.3);
}

/// No node or edge of the surface is near the source.
TEST(SurfaceWithGrid, WarnsOfTheTriangleAroundASmallSource) {
  const SurfaceMesh cube = gridCube(4);
  const Vec3 within = Vec3(0.5 * (0.25 + 0.3), 0.26, 0.0);
  const Diagnostic* coarse = nullptr;
  const MeshRun run = filled(cube, sourceAt(within, 0.01, 0.0));
  coarse = coarsenessOf(run);
  ASSERT_NE(coarse, nullptr);
  EXPECT_LT(glm::length(coarse->position - within), 0.25);
  EXPECT_LT(coarse->values[0], 60.0);
  EXPECT_EQ(coarsenessOf(filled(cube, sourceAt(within, 0.2, 0.0))), nullptr);
  EXPECT_EQ(coarsenessOf(filled(cube, {})), nullptr);
}

TEST(SurfaceWithGrid, AUniformSizeTakesPrecedenceOverTheGrid) {
  const SurfaceMesh cube = gridCube(4);
  MeshOptions options;
  options.size = 0.2;
  EXPECT_EQ(filled(cube, gridOfSize(0.05), options).fingerprint(),
            filled(cube, {}, options).fingerprint());
}

TEST(SurfaceWithGrid, RejectsUncountablyManyElementsWithAFiniteEstimate) {
  const SurfaceMesh cube = gridCube(12);
  for (const double size : {1e-6, 1e-308}) {
    MeshOptions options;
    options.size = size;
    const MeshRun run = filled(cube, {}, options);
    ASSERT_EQ(run.status(), MeshStatus::kInvalidInput) << size;
    EXPECT_EQ(run.diagnostics().back().code, DiagnosticCode::kTooManyElements);
    EXPECT_GT(run.diagnostics().back().values[0], 1e14);
    EXPECT_LE(run.diagnostics().back().values[0], 1e15);
  }
}

TEST(SurfaceWithGrid, RejectsASurfaceOutsideTheGridAtItsFirstPosition) {
  const SurfaceMesh cube = gridCube(4);
  const BackgroundGrid half =
      boxGrid(Vec3(-1.0), Vec3(2.0, 2.0, 0.5), [](const Vec3&) { return 0.2; });
  const MeshRun run = filled(cube, half);
  ASSERT_EQ(run.status(), MeshStatus::kInvalidInput);
  ASSERT_EQ(run.diagnostics().size(), 1U);
  const Diagnostic& found = run.diagnostics()[0];
  EXPECT_EQ(found.code, DiagnosticCode::kOutsideBackgroundGrid);
  ASSERT_EQ(found.entities.size(), 1U);
  EXPECT_EQ(found.entities[0].kind, EntityKind::kSurfaceNode);
  EXPECT_EQ(found.position, pointOf(cube, found.entities[0].index));
  EXPECT_GT(found.position.z, 0.5);
  EXPECT_GT(found.values[0], 10.0);
}

TEST(SurfaceWithGrid, ReportsTheProblemsOfBoth) {
  SurfaceMesh open = gridCube(2);
  open.triangles.resize(open.triangles.size() - 3);
  BackgroundGrid grid = gridOfSize(0.3);
  grid.nodes[3].size = -1.0;
  const MeshRun run = filled(open, grid);
  ASSERT_EQ(run.status(), MeshStatus::kInvalidInput);
  EXPECT_EQ(run.diagnostics().front().code, DiagnosticCode::kSizeOutOfRange);
  EXPECT_EQ(run.diagnostics().back().code, DiagnosticCode::kOpenEdge);
}

}  // namespace
}  // namespace tetrafront::testing
