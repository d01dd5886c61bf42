// Holes of curved patches: they are projected into the patch's plane, reported if they do not lie on the patch, and
// watertight with the patches that continue at them.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "model/check_model.h"
#include "model/patch_projection.h"
#include "support/branched_tube.h"
#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/patch_family.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

/// Adds a hole to a curved patch: a closed line through the patch's points at `units`, each moved by `lift` along the
/// normal.
void addHole(Model& model, const std::vector<Vec2>& units, double lift = 0.0) {
  const ResolvedModel resolved(model);
  const PatchSurface surface(resolved, model.patches.front());
  std::vector<Vec3> positions;
  for (const Vec2& unit : units) {
    const SurfacePoint point = surface.evaluate(surface.mapped()->stretchedPlane().toPlane(unit));
    const Vec3 normal = glm::normalize(glm::cross(point.alongXi, point.alongEta));
    positions.push_back(point.position + lift * normal);
  }
  const auto first = static_cast<std::uint32_t>(model.points.size());
  Line line{LineType::kSpline, {}};
  for (std::uint32_t i = 0; i < units.size(); ++i) line.points.push_back(first + i);
  line.points.push_back(first);
  model.points.insert(model.points.end(), positions.begin(), positions.end());
  model.lines.push_back(std::move(line));
  model.patches.front().loops.push_back(
      {{static_cast<std::uint32_t>(model.lines.size() - 1), false}});
}

Vec2 onCircle(const Vec2& centre, double radius, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

void addRoundHole(Model& model, const Vec2& centre, double radius, double lift = 0.0) {
  std::vector<Vec2> units;
  for (int i = 0; i < 16; ++i) units.push_back(onCircle(centre, radius, 22.5 * i));
  addHole(model, units, lift);
}

std::vector<DiagnosticCode> codesOf(const Model& model) {
  std::vector<DiagnosticCode> codes;
  for (const Diagnostic& diagnostic : diagnoseModel(model)) codes.push_back(diagnostic.code);
  return codes;
}

TEST(ModelPatchProjection, FindsTheNearestPositionOfThePatch) {
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const FamilyMember member = patchOfFamily(type, seed);
      const ResolvedModel resolved(member.model);
      const PatchSurface surface(resolved, member.model.patches.front());
      const PatchProjection projection(surface);
      Random random(seed);
      for (int i = 0; i < 20; ++i) {
        Vec2 unit(random.unit(), random.unit());
        const bool isTriangle = unitShapeOf(type) == UnitShape::kTriangle;
        if (isTriangle && unit.x + unit.y > 1.0) unit = Vec2(1.0) - unit;
        // Away from the border, where the foot of a lifted position lies on the patch.
        unit = 0.05 + 0.85 * unit;
        const Vec2 plane = surface.mapped()->stretchedPlane().toPlane(unit);
        const SurfacePoint point = surface.evaluate(plane);
        const PatchProjection::Foot on = projection.project(point.position);
        EXPECT_LT(on.distance, 1e-13) << seed;
        EXPECT_LT(glm::length(surface.evaluate(on.plane).position - point.position), 1e-13);
        const double lift = 1e-3;
        const Vec3 normal = glm::normalize(glm::cross(point.alongXi, point.alongEta));
        EXPECT_NEAR(projection.project(point.position + lift * normal).distance, lift, 1e-9)
            << seed;
      }
    }
  }
}

TEST(SurfaceCurvedHoles, StayOpenInPatchesOfEveryType) {
  for (const PatchType type : kCurvedTypes) {
    int meshed = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(seed);
      FamilyMember member = patchOfFamily(type, seed);
      addRoundHole(member.model, {0.3, 0.3}, 0.12);
      addRoundHole(member.model, {0.62, 0.22}, 0.08);
      // If the patch is very uneven, the spline through its points may leave it.
      if (!codesOf(member.model).empty()) continue;
      ++meshed;
      const SurfaceMesh mesh = meshOf(member.model, member.size);
      const PatchQuality quality = measureQuality(mesh, member.size);
      EXPECT_TRUE(quality.closed);
      EXPECT_EQ(measure(mesh, SizeField::uniform(member.size)).eulerCharacteristic(), -1);
      EXPECT_GT(quality.minAngle, 20.0);
      EXPECT_GT(quality.meanRadiusRatio, 0.9);
      EXPECT_NEAR(quality.meanEdge, 1.0, 0.1);
    }
    EXPECT_GE(meshed, 9);
  }
}

TEST(SurfaceCurvedHoles, NodesOfTheHoleStayOnItsLine) {
  const Model model = branchedTube(0.4);
  const SurfaceMesh mesh = meshOf(model, 0.2);
  const std::uint32_t meeting = 3;
  const ResolvedModel resolved(model);
  EXPECT_GT(std::ranges::count(mesh.sideLine, meeting), 8) << "the line where the tubes meet";
  for (std::size_t side = 0; side < mesh.sideLine.size(); ++side) {
    if (mesh.sideLine[side] != meeting) continue;
    const Vec3 node = pointOf(mesh, mesh.sides[2 * side]);
    double nearest = 1.0;
    for (int i = 0; i <= 20'000; ++i)
      nearest = std::min(
          nearest, glm::length(resolved.curve(LineId(meeting)).position(i / 20'000.0) - node));
    EXPECT_LT(nearest, 1e-4);
  }
}

TEST(SurfaceCurvedHoles, TubeWithABranchIsWatertightAndHasItsVolume) {
  for (const double branch : {0.4, 0.8}) {
    const Model model = branchedTube(branch);
    ASSERT_TRUE(codesOf(model).empty());
    const double exact = branchedTubeVolume(branch);
    double previous = exact;
    for (const double size : {0.5, 0.3, 0.15}) {
      const SurfaceMesh mesh = meshOf(model, size);
      const SurfaceMeasures found = measure(mesh, SizeField::uniform(size));
      EXPECT_EQ(found.borderEdges, 0U);
      EXPECT_EQ(found.nonManifoldEdges, 0U);
      EXPECT_EQ(found.eulerCharacteristic(), 2);
      EXPECT_GT(found.minAngle, 18.0);
      if (size > 0.3 || branch > 0.5) continue;
      MeshOptions options;
      options.size = size;
      options.optimization = Optimization::kNone;
      MeshRun run(model, {}, options);
      MeshStatus status = MeshStatus::kRunning;
      while (status == MeshStatus::kRunning) status = run.advance(10'000);
      ASSERT_EQ(status, MeshStatus::kDone);
      // Chords lie inside the tubes: the volume converges from below, with an error of second order in the size.
      const double error = exact - run.quality().volume;
      EXPECT_GT(error, 0.0);
      EXPECT_LT(error, 0.6 * size * size * exact);
      EXPECT_LT(error, 0.35 * previous);
      previous = error;
    }
  }
}

TEST(SurfaceCurvedHoles, HoleOffThePatchIsReportedWithItsDistance) {
  FamilyMember member = patchOfFamily(PatchType::kCoons, 3);
  Model slightly = member.model;
  addRoundHole(slightly, {0.5, 0.5}, 0.15, 1e-3);
  EXPECT_TRUE(codesOf(slightly).empty());
  addRoundHole(member.model, {0.5, 0.5}, 0.15, 0.2);
  const std::vector<Diagnostic> found = diagnoseModel(member.model);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().code, DiagnosticCode::kHoleOffPatch);
  ASSERT_EQ(found.front().entities.size(), 2U);
  EXPECT_EQ(found.front().entities[0].kind, EntityKind::kPatch);
  EXPECT_EQ(found.front().entities[1].index, 4U);
  EXPECT_NEAR(found.front().values.front(), 0.2, 0.02);
  EXPECT_TRUE(found.front().hasPosition);
}

TEST(SurfaceCurvedHoles, HolesThatIntersectOrLieElsewhereAreReported) {
  const FamilyMember member = patchOfFamily(PatchType::kSerendipity, 4);
  Model touching = member.model;
  addRoundHole(touching, {0.4, 0.5}, 0.15);
  addRoundHole(touching, {0.6, 0.5}, 0.15);
  EXPECT_EQ(codesOf(touching), std::vector{DiagnosticCode::kLoopsIntersect});
  Model nested = member.model;
  addRoundHole(nested, {0.5, 0.5}, 0.3);
  addRoundHole(nested, {0.5, 0.5}, 0.1);
  EXPECT_EQ(codesOf(nested), std::vector{DiagnosticCode::kHoleOutside});
  Model twice = member.model;
  addRoundHole(twice, {0.5, 0.5}, 0.2);
  twice.patches.front().loops.push_back(twice.patches.front().loops.back());
  EXPECT_EQ(codesOf(twice), std::vector{DiagnosticCode::kLoopsIntersect});
}

TEST(SurfaceCurvedHoles, CoarseSidesAreHalvedUntilLoopsAreSimple) {
  // A horseshoe around a round hole: with few sides, it would intersect the hole.
  FamilyMember member = patchOfFamily(PatchType::kCoons, 5);
  std::vector<Vec2> horseshoe;
  for (int i = 0; i <= 10; ++i) horseshoe.push_back(onCircle({0.5, 0.5}, 0.32, -140.0 + 28.0 * i));
  for (int i = 0; i <= 10; ++i) horseshoe.push_back(onCircle({0.5, 0.5}, 0.22, 140.0 - 28.0 * i));
  addHole(member.model, horseshoe);
  addRoundHole(member.model, {0.5, 0.5}, 0.15);
  ASSERT_TRUE(codesOf(member.model).empty());
  const SurfaceMesh mesh = meshOf(member.model, 10.0);
  EXPECT_GT(std::ranges::count(mesh.sideLine, 4U), 3);
  EXPECT_TRUE(measureQuality(mesh, 10.0).closed);
  EXPECT_EQ(measure(mesh, SizeField::uniform(10.0)).eulerCharacteristic(), -1);
}

TEST(SurfaceCurvedHoles, ArePartOfThePreview) {
  const Model model = branchedTube(0.4);
  const ModelPreview preview =
      previewModel(model, boxGrid({-3, -3, -3}, {3, 3, 3}, [](const Vec3&) { return 0.5; }));
  EXPECT_TRUE(preview.diagnostics.empty());
  const std::uint32_t tube = 2;
  ASSERT_GT(preview.patchOffsets[tube + 1], preview.patchOffsets[tube]);
  double area = 0.0;
  for (std::uint32_t t = preview.patchOffsets[tube]; t < preview.patchOffsets[tube + 1]; ++t) {
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const double* at = &preview.patchPoints[3 * preview.patchTriangles[3 * std::size_t{t} + k]];
      corners[k] = {at[0], at[1], at[2]};
    }
    area += 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    EXPECT_FALSE(middle.x > 0.0 && std::hypot(middle.y, middle.z) < 0.3);
  }
  EXPECT_NEAR(area, 8.0 * std::numbers::pi - std::numbers::pi * 0.16, 1.0);
}

}  // namespace
}  // namespace tetrafront::testing
