/// Bodies: closed surfaces that are meshed together with a drawn model.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

Model unitCube() { return testing::boxModel(Vec3(0.0), Vec3(1.0)); }

MeshRun runToEnd(MeshRun run) {
  while (run.advance(4096) == MeshStatus::kRunning) {
  }
  return run;
}

/// Appends a surface as a body with one patch.
void appendBody(BodySurfaces& bodies, const SurfaceMesh& surface, double scale = 1.0,
                const Vec3& offset = Vec3(0.0)) {
  const auto nodes = static_cast<std::uint32_t>(bodies.points.size() / 3);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double shift = i % 3 == 0 ? offset.x : i % 3 == 1 ? offset.y : offset.z;
    bodies.points.push_back(scale * surface.points[i] + shift);
  }
  for (const std::uint32_t node : surface.triangles) bodies.triangles.push_back(nodes + node);
  bodies.trianglePatch.resize(bodies.triangles.size() / 3, bodies.patches);
  ++bodies.patches;
}

BodySurfaces singleBody(const SurfaceMesh& surface, double scale = 1.0,
                        const Vec3& offset = Vec3(0.0)) {
  BodySurfaces bodies;
  appendBody(bodies, surface, scale, offset);
  return bodies;
}

MeshOptions uniformSize(double size) {
  MeshOptions options;
  options.size = size;
  return options;
}

/// The volume of the polyhedron, by the divergence theorem.
double bodyVolumeOf(const BodySurfaces& bodies) {
  double volume = 0.0;
  for (std::size_t t = 0; t < bodies.triangles.size() / 3; ++t) {
    const auto corner = [&](std::size_t k) {
      const double* at = &bodies.points[3 * std::size_t{bodies.triangles[3 * t + k]}];
      return Vec3(at[0], at[1], at[2]);
    };
    volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
  }
  return volume;
}

void expectVolume(const MeshRun& run, double volume, std::size_t regions) {
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  EXPECT_NEAR(run.quality().volume, volume, 1e-9 * volume);
  EXPECT_EQ(run.statistics().regions.size(), regions);
}

/// Triangles per patch of the surface.
std::vector<std::uint32_t> trianglesPerPatch(const MeshRun& run) {
  std::vector<std::uint32_t> counts;
  for (const std::uint32_t patch : run.surface().trianglePatch) {
    if (patch >= counts.size()) counts.resize(patch + 1, 0);
    ++counts[patch];
  }
  return counts;
}

TEST(Bodies, AloneGiveTheMeshOfTheFilledSurface) {
  const SurfaceMesh sphere = testing::geodesicSphere(5);
  for (const MeshOptions& options : {MeshOptions{}, uniformSize(0.15), uniformSize(2.0)}) {
    const MeshRun filled = runToEnd(MeshRun(sphere.points, sphere.triangles, options));
    const MeshRun run = runToEnd(MeshRun(Model{}, singleBody(sphere), {}, options));
    ASSERT_EQ(run.status(), MeshStatus::kDone);
    EXPECT_EQ(run.fingerprint(), filled.fingerprint());
    EXPECT_EQ(run.surface().triangles, filled.surface().triangles);
  }
}

TEST(Bodies, AloneLeaveOutPointsAndLines) {
  const SurfaceMesh sphere = testing::geodesicSphere(4);
  Model model;
  model.points = {Vec3(0.0), Vec3(5.0, 0.0, 0.0)};
  model.lines = {{LineType::kStraight, {0, 1}}};
  const MeshRun run = runToEnd(MeshRun(model, singleBody(sphere), {}, {}));
  const MeshRun filled = runToEnd(MeshRun(sphere.points, sphere.triangles, MeshOptions{}));
  EXPECT_EQ(run.fingerprint(), filled.fingerprint());
}

TEST(Bodies, BesideADrawnCubeAddTheirVolume) {
  BodySurfaces bodies = singleBody(testing::geodesicSphere(5), 0.5, Vec3(3.0, 0.0, 0.0));
  appendBody(bodies, testing::geodesicSphere(3), 0.25, Vec3(-2.0, 0.0, 0.0));
  const double volume = 1.0 + bodyVolumeOf(bodies);
  const MeshRun run = runToEnd(MeshRun(unitCube(), bodies, {}, uniformSize(0.25)));
  expectVolume(run, volume, 3);
  const std::vector<std::uint32_t> counts = trianglesPerPatch(run);
  ASSERT_EQ(counts.size(), 8U);
  EXPECT_EQ(counts[6], 500U);
  EXPECT_EQ(counts[7], 180U);
  ASSERT_EQ(run.patchSummaries().size(), 8U);
  for (std::uint32_t patch = 0; patch < 8; ++patch) {
    const PatchSummary& summary = run.patchSummaries()[patch];
    EXPECT_EQ(summary.patch, patch);
    EXPECT_EQ(summary.triangles, counts[patch]);
    EXPECT_GT(summary.minAngle, 25.0);
    EXPECT_GT(summary.meanRadiusRatio, 0.85);
    EXPECT_GT(summary.meanEdge, 0.3);
    EXPECT_LT(summary.meanEdge, 1.5);
  }
}

/// The triangles of a body face outward, those around a cavity inward.
TEST(Bodies, InsideADrawnCubeAreCavitiesOrRegions) {
  const BodySurfaces ball = singleBody(testing::geodesicSphere(4), 0.25, Vec3(0.5));
  BodySurfaces inverted = ball;
  for (std::size_t h = 0; h < inverted.triangles.size(); h += 3)
    std::swap(inverted.triangles[h + 1], inverted.triangles[h + 2]);
  MeshOptions options = uniformSize(0.2);
  expectVolume(runToEnd(MeshRun(unitCube(), ball, {}, options)), 1.0, 2);
  expectVolume(runToEnd(MeshRun(unitCube(), inverted, {}, options)), 1.0 - bodyVolumeOf(ball), 1);
  options.innerShells = InnerShells::kCavities;
  expectVolume(runToEnd(MeshRun(unitCube(), ball, {}, options)), 1.0 - bodyVolumeOf(ball), 1);
  options.innerShells = InnerShells::kRegions;
  expectVolume(runToEnd(MeshRun(unitCube(), ball, {}, options)), 1.0, 2);
}

TEST(Bodies, AroundADrawnCubeMakeItACavity) {
  const BodySurfaces shell = singleBody(testing::geodesicSphere(5), 3.0);
  const MeshRun run = runToEnd(MeshRun(unitCube(), shell, {}, uniformSize(0.5)));
  expectVolume(run, bodyVolumeOf(shell) - 1.0, 1);
  // The drawn patches now face into the cavity; one diagnostic says how the shells are nested.
  const auto nested = std::ranges::count_if(run.diagnostics(), [](const Diagnostic& found) {
    return found.code == DiagnosticCode::kNestedRegions;
  });
  EXPECT_EQ(nested, 1);
}

TEST(Bodies, ThatIntersectAreReportedWithTheirPatches) {
  BodySurfaces bodies = singleBody(testing::geodesicSphere(4), 0.25, Vec3(3.0));
  appendBody(bodies, testing::geodesicSphere(4), 0.5, Vec3(1.0, 0.5, 0.5));
  const MeshRun run = runToEnd(MeshRun(unitCube(), bodies, {}, uniformSize(0.25)));
  EXPECT_EQ(run.status(), MeshStatus::kInvalidInput);
  std::set<std::uint32_t> patches;
  for (const Diagnostic& found : run.diagnostics()) {
    if (found.code != DiagnosticCode::kSelfIntersection) continue;
    for (const Entity& entity : found.entities) {
      if (entity.kind == EntityKind::kPatch) patches.insert(entity.index);
    }
  }
  EXPECT_TRUE(patches.contains(7));
  EXPECT_FALSE(patches.contains(6));
}

TEST(Bodies, ThatAreOpenAreReportedWithTheirPatch) {
  BodySurfaces bodies = singleBody(testing::geodesicSphere(2), 0.5, Vec3(3.0));
  bodies.triangles.resize(bodies.triangles.size() - 3);
  const MeshRun run = runToEnd(MeshRun(unitCube(), bodies, {}, uniformSize(0.25)));
  EXPECT_EQ(run.status(), MeshStatus::kInvalidInput);
  ASSERT_FALSE(run.diagnostics().empty());
  EXPECT_EQ(run.diagnostics()[0].code, DiagnosticCode::kOpenEdge);
  EXPECT_EQ(run.diagnostics()[0].entities[0].index, 6U);
}

TEST(Bodies, BesideDrawnPatchesNeedASize) {
  const BodySurfaces ball = singleBody(testing::geodesicSphere(4), 0.25, Vec3(3.0));
  const MeshRun run = runToEnd(MeshRun(unitCube(), ball, {}, {}));
  EXPECT_EQ(run.status(), MeshStatus::kInvalidInput);
}

TEST(Bodies, WithInvalidNumbersAreReported) {
  const BodySurfaces ball = singleBody(testing::geodesicSphere(1), 0.25, Vec3(3.0));
  BodySurfaces wild = ball;
  wild.triangles[4] = 0xfffffffeU;
  BodySurfaces withoutPatches = ball;
  withoutPatches.trianglePatch.clear();
  withoutPatches.patches = 0;
  BodySurfaces incomplete = ball;
  incomplete.points.pop_back();
  BodySurfaces empty;
  const auto statusOf = [](const BodySurfaces& bodies) {
    return runToEnd(MeshRun(unitCube(), bodies, {}, uniformSize(0.25))).status();
  };
  EXPECT_EQ(statusOf(wild), MeshStatus::kInvalidInput);
  EXPECT_EQ(statusOf(incomplete), MeshStatus::kInvalidInput);
  EXPECT_EQ(statusOf(withoutPatches), MeshStatus::kDone);
  EXPECT_EQ(statusOf(empty), MeshStatus::kDone);
  EXPECT_EQ(runToEnd(MeshRun(Model{}, empty, {}, {})).status(), MeshStatus::kInvalidInput);
}

}  // namespace
}  // namespace tetrafront
