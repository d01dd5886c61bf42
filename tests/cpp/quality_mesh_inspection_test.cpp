#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/shapes.h"
#include "tetrafront/mesh_inspection.h"
#include "tetrafront/mesher.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::testing {
namespace {

struct Filled {
  SurfaceMesh surface;
  VolumeMesh volume;
  QualitySummary quality;
};

Filled fill(const SurfaceMesh& mesh) {
  MeshRun run(mesh.points, mesh.triangles, {});
  while (run.advance(1U << 16U) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return {run.surface(), run.volume(), run.quality()};
}

MeshInspection inspect(const VolumeMesh& mesh) {
  return inspectMesh(mesh.points, mesh.tetrahedra, mesh.regions);
}

TEST(MeshInspection, AgreesWithTheReportOfARun) {
  const Filled mesh = fill(cubeWithSphericalCavity(4, 3));
  const MeshInspection found = inspect(mesh.volume);
  ASSERT_TRUE(found.isReadable);
  EXPECT_EQ(found.tetrahedra, mesh.volume.tetrahedra.size() / 4);
  EXPECT_EQ(found.nodes, mesh.volume.points.size() / 3);
  EXPECT_EQ(found.quality.minDihedral, mesh.quality.minDihedral);
  EXPECT_EQ(found.quality.maxDihedral, mesh.quality.maxDihedral);
  EXPECT_NEAR(found.quality.volume, mesh.quality.volume, 1e-12);
  EXPECT_EQ(found.invertedTetrahedra + found.degenerateTetrahedra + found.duplicateTetrahedra +
                found.nonManifoldFaces + found.overlappingFaces + found.coincidentNodes +
                found.unusedNodes,
            0U);
  EXPECT_EQ(found.boundary.triangles.size(), mesh.surface.triangles.size());
  EXPECT_NEAR(found.statistics.meanEdge, 1.0, 0.1);
}

TEST(MeshInspection, AcceptsAnyRegionNumbers) {
  const VolumeMesh mesh = fill(nestedSpheres(2, 3)).volume;
  VolumeMesh renamed = mesh;
  constexpr std::uint32_t kLarge = 0xffffffffU;
  for (std::size_t t = 0; t < mesh.regions.size(); ++t)
    renamed.regions[t] = t % 3 == 0 ? kLarge : 7;
  const MeshInspection found = inspect(renamed);
  ASSERT_EQ(found.statistics.regions.size(), 2U);
  EXPECT_EQ(found.statistics.regions[0].region, 7U);
  EXPECT_EQ(found.statistics.regions[1].region, kLarge);
  const auto large = std::count(renamed.regions.begin(), renamed.regions.end(), kLarge);
  EXPECT_EQ(found.statistics.regions[1].tetrahedra, large);
  ASSERT_FALSE(found.boundary.trianglePatch.empty());
  for (const std::uint32_t region : found.boundary.trianglePatch) {
    EXPECT_TRUE(region == 7 || region == kLarge);
  }
}

TEST(MeshInspection, ReturnsABoundaryThatCanBeMeshedAgain) {
  const Filled mesh = fill(nestedSpheres(2, 3));
  const MeshInspection found = inspect(mesh.volume);
  SurfaceInspector inspector(mesh.volume.points, found.boundary.triangles);
  while (!inspector.advance(1U << 16U)) {
  }
  EXPECT_TRUE(inspector.result().isFillable);
  EXPECT_EQ(inspector.result().flippedTriangles, 0U);
  EXPECT_NEAR(inspector.result().volume, mesh.quality.volume, 1e-12);
}

TEST(MeshInspection, MeasuresInvertedElementsAsIfReoriented) {
  Filled mesh = fill(gridCube(3));
  const MeshInspection before = inspect(mesh.volume);
  for (std::size_t e = 0; e < mesh.volume.tetrahedra.size(); e += 8) {
    std::swap(mesh.volume.tetrahedra[e], mesh.volume.tetrahedra[e + 1]);
  }
  const MeshInspection after = inspect(mesh.volume);
  EXPECT_EQ(after.invertedTetrahedra, (before.tetrahedra + 1) / 2);
  EXPECT_NEAR(after.quality.volume, before.quality.volume, 1e-14);
  EXPECT_NEAR(after.quality.minDihedral, before.quality.minDihedral, 1e-9);
  EXPECT_EQ(after.overlappingFaces, 0U);
}

TEST(MeshInspection, CountsDefects) {
  Filled mesh = fill(gridCube(2));
  std::vector<std::uint32_t>& corners = mesh.volume.tetrahedra;
  corners.insert(corners.end(), {corners[0], corners[1], corners[2], corners[3]});
  corners.insert(corners.end(), {corners[0], corners[1], corners[2], corners[2]});
  mesh.volume.regions.resize(corners.size() / 4, 0);
  mesh.volume.points.insert(mesh.volume.points.end(), {5.0, 5.0, 5.0});
  const MeshInspection found = inspect(mesh.volume);
  EXPECT_TRUE(found.isReadable);
  EXPECT_EQ(found.duplicateTetrahedra, 1U);
  EXPECT_EQ(found.degenerateTetrahedra, 1U);
  EXPECT_EQ(found.unusedNodes, 1U);
  EXPECT_GE(found.nonManifoldFaces, 1U);
}

TEST(MeshInspection, FindsTheSameInSlicesOfAnySize) {
  Filled mesh = fill(cubeWithSphericalCavity(4, 3));
  std::swap(mesh.volume.tetrahedra[40], mesh.volume.tetrahedra[41]);
  const MeshInspection whole = inspect(mesh.volume);
  MeshInspector inspector(mesh.volume.points, mesh.volume.tetrahedra, mesh.volume.regions);
  int calls = 1;
  double before = 0.0;
  for (; !inspector.advance(7); ++calls) {
    ASSERT_LE(before, inspector.fraction());
    before = inspector.fraction();
  }
  EXPECT_EQ(inspector.fraction(), 1.0);
  EXPECT_GT(calls, static_cast<int>(whole.tetrahedra / 7));
  const MeshInspection& found = inspector.result();
  EXPECT_EQ(found.invertedTetrahedra, 1U);
  EXPECT_EQ(found.invertedTetrahedra, whole.invertedTetrahedra);
  EXPECT_EQ(found.boundary.triangles, whole.boundary.triangles);
  EXPECT_EQ(found.boundary.trianglePatch, whole.boundary.trianglePatch);
  EXPECT_EQ(found.meanEdge, whole.meanEdge);
  EXPECT_EQ(found.quality.meanRadiusRatio, whole.quality.meanRadiusRatio);
}

/// Elements around one edge, the first between two sheets at an angle of 24 degrees, which are
/// interfaces if regions differ there. Its other edges have angles above 60 degrees.
TEST(MeshInspection, CountsElementsLimitedByInterfaces) {
  VolumeMesh mesh;
  mesh.points = {0.0, 0.0, 0.0, 1.4, 0.0, 0.0};
  for (const double degrees : {0.0, 24.0, 90.0, 170.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    mesh.points.insert(mesh.points.end(), {0.7, std::cos(angle), std::sin(angle)});
  }
  mesh.tetrahedra = {0, 1, 2, 3, 0, 1, 3, 4, 0, 1, 4, 5};
  mesh.regions = {0, 0, 0};
  EXPECT_EQ(inspect(mesh).statistics.limitedByEdges, 0U);
  mesh.regions = {0, 1, 1};
  EXPECT_EQ(inspect(mesh).statistics.limitedByEdges, 1U);
  EXPECT_EQ(inspect(mesh).boundary.triangles.size(), 3U * 8U) << "interfaces are no boundary";
}

/// A gap narrower than the target elements, in a mesh of any origin.
TEST(MeshInspection, CountsElementsLimitedByNarrowGaps) {
  const SurfaceMesh plate = thinPlate(10, 0.02);
  MeshRun run(plate.points, plate.triangles, {});
  while (run.advance(1U << 16U) == MeshStatus::kRunning) {
  }
  const QualityStatistics expected = run.statistics();
  ASSERT_GT(expected.limitedByNarrowGaps, 0U);
  const QualityStatistics found = inspect(run.volume()).statistics;
  EXPECT_EQ(found.limitedByNarrowGaps, expected.limitedByNarrowGaps);
  EXPECT_EQ(found.outOfRange, expected.outOfRange);
}

TEST(MeshInspection, RejectsInvalidArrays) {
  const Filled mesh = fill(gridCube(1));
  VolumeMesh wrong = mesh.volume;
  wrong.tetrahedra[3] = 99999;
  EXPECT_FALSE(inspect(wrong).isReadable);
  wrong = mesh.volume;
  wrong.points[4] = std::nan("");
  EXPECT_FALSE(inspect(wrong).isReadable);
  wrong = mesh.volume;
  wrong.regions.pop_back();
  EXPECT_FALSE(inspect(wrong).isReadable);
  EXPECT_FALSE(inspect({}).isReadable);
}

}  // namespace
}  // namespace tetrafront::testing
