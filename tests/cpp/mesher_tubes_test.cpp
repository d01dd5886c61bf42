// Tubes: cylinders, cones and others between two rims, closed by planar caps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/patch_surface.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

Vec3 around(double angle) { return {std::cos(angle), std::sin(angle), 0.0}; }

/// A circle in a plane z = `height`, as `arcs` lines: a circle or arcs. It starts at an angle, in either direction.
Loop rim(ModelBuilder& builder, double radius, double height, int arcs, double start,
         bool isClockwise) {
  const double turn = (isClockwise ? -2.0 : 2.0) * kHalfTurn;
  const auto at = [&](double part) {
    return radius * around(start + part * turn) + Vec3(0.0, 0.0, height);
  };
  if (arcs == 1)
    return {{builder.line(LineType::kCircle, {at(0.0), at(0.3), at(0.6), at(0.0)}), false}};
  Loop loop;
  for (int i = 0; i < arcs; ++i) {
    const double from = static_cast<double>(i) / arcs;
    const int next = (i + 1) % arcs;
    const double to = static_cast<double>(next) / arcs;
    const Vec3 middle = at(from + 0.5 / arcs);
    // Every second line runs against the loop.
    const bool isReversed = i % 2 == 1;
    loop.push_back(
        {builder.line(LineType::kArc, isReversed ? std::vector{at(to), middle, at(from)}
                                                 : std::vector{at(from), middle, at(to)}),
         isReversed});
  }
  return loop;
}

Model capped(ModelBuilder builder, const Loop& bottom, const Loop& top) {
  builder.patch(PatchType::kTube, {bottom, top});
  builder.patch(PatchType::kPlanar, {bottom});
  builder.patch(PatchType::kPlanar, {top});
  return std::move(builder.model);
}

/// Meshes the solid and returns its volume.
double solidVolume(const Model& model, double size) {
  const ModelPreview preview = previewModel(model, {}, MeshOptions{.size = size});
  for (const Diagnostic& diagnostic : preview.diagnostics)
    EXPECT_NE(diagnostic.severity, Severity::kError) << static_cast<int>(diagnostic.code);
  MeshOptions options;
  options.size = size;
  // The volume does not depend on the elements' shapes.
  options.optimization = Optimization::kNone;
  MeshRun run(model, {}, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  for (const Diagnostic& diagnostic : run.diagnostics())
    EXPECT_NE(diagnostic.severity, Severity::kError) << static_cast<int>(diagnostic.code);
  EXPECT_EQ(complaintAbout(run.volume(), run.surface()), "");
  return enclosedVolume(run.surface());
}

TEST(MesherTubes, CylindersHaveTheirVolume) {
  for (const double height : {0.5, 2.0, 6.0}) {
    SCOPED_TRACE(height);
    ModelBuilder builder;
    const Loop bottom = rim(builder, 1.0, 0.0, 1, 0.0, false);
    const Loop top = rim(builder, 1.0, height, 1, 0.0, false);
    const Model model = capped(std::move(builder), bottom, top);
    const double exact = kHalfTurn * height;
    const double coarse = exact - solidVolume(model, 0.5);
    const double fine = exact - solidVolume(model, 0.2);
    // Chords lie inside, with an error of second order.
    EXPECT_GT(coarse, 0.0);
    EXPECT_LT(coarse, 0.05 * exact);
    EXPECT_GT(fine, 0.0);
    EXPECT_LT(fine, 0.008 * exact);
  }
}

TEST(MesherTubes, ConesHaveTheirVolume) {
  ModelBuilder builder;
  const Loop bottom = rim(builder, 1.0, 0.0, 1, 0.0, false);
  const Loop top = rim(builder, 0.25, 1.5, 1, 0.0, false);
  const double exact = kHalfTurn * 1.5 / 3.0 * (1.0 + 0.25 + 0.0625);
  const double volume = solidVolume(capped(std::move(builder), bottom, top), 0.15);
  EXPECT_NEAR(volume, exact, 0.01 * exact);
}

TEST(MesherTubes, NodesOfACylinderAreOnIt) {
  ModelBuilder builder;
  const Loop bottom = rim(builder, 1.0, 0.0, 1, 0.4, false);
  const Loop top = rim(builder, 1.0, 2.0, 3, 2.9, true);
  const Model model = capped(std::move(builder), bottom, top);
  MeshOptions options;
  options.size = 0.3;
  MeshRun run(model, {}, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  const SurfaceMesh& surface = run.surface();
  for (std::size_t t = 0; t < surface.trianglePatch.size(); ++t) {
    if (surface.trianglePatch[t] != 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = surface.triangles[3 * t + k];
      ASSERT_NEAR(std::hypot(surface.points[3 * node], surface.points[3 * node + 1]), 1.0, 1e-12);
    }
  }
}

TEST(MesherTubes, AnyStartDirectionAndNumberOfLinesGivesTheSameSolid) {
  const double exact = kHalfTurn * 1.2;
  // Each start and each number of lines occurs in both directions.
  bool isClockwise = false;
  for (const int bottomLines : {1, 2, 4}) {
    for (const int topLines : {1, 3}) {
      for (const double start : {0.0, 1.0, kHalfTurn, 5.5}) {
        SCOPED_TRACE(::testing::Message()
                     << bottomLines << ' ' << topLines << ' ' << start << ' ' << isClockwise);
        ModelBuilder builder;
        const Loop bottom = rim(builder, 1.0, 0.0, bottomLines, 0.7, false);
        const Loop top = rim(builder, 1.0, 1.2, topLines, start, isClockwise);
        const double volume = solidVolume(capped(std::move(builder), bottom, top), 0.4);
        EXPECT_NEAR(volume, exact, 0.035 * exact);
        isClockwise = !isClockwise;
      }
      isClockwise = !isClockwise;
    }
  }
}

TEST(MesherTubes, ACircleCanBeJoinedToASquare) {
  ModelBuilder builder;
  const Loop bottom = builder.polygon({{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}});
  const Loop top = rim(builder, 0.8, 1.5, 1, 0.2, true);
  const double volume = solidVolume(capped(std::move(builder), bottom, top), 0.25);
  // Between the solids over the smaller and over the larger section.
  EXPECT_GT(volume, 1.5 * kHalfTurn * 0.64);
  EXPECT_LT(volume, 1.5 * 4.0);
}

TEST(MesherTubes, PrismsAreExactWithTheirEdges) {
  for (int corners = 3; corners < 8; ++corners) {
    SCOPED_TRACE(corners);
    ModelBuilder builder;
    std::vector<Vec3> low;
    std::vector<Vec3> high;
    for (int i = 0; i < corners; ++i) {
      low.push_back(around(2.0 * kHalfTurn * i / corners));
      high.push_back(low.back() + Vec3(0.0, 0.0, 0.9));
    }
    std::ranges::rotate(high, high.begin() + 2);
    std::ranges::reverse(high);
    const Loop bottom = builder.polygon(low);
    const Loop top = builder.polygon(high);
    const double area = 0.5 * corners * std::sin(2.0 * kHalfTurn / corners);
    const double volume = solidVolume(capped(std::move(builder), bottom, top), 0.3);
    EXPECT_NEAR(volume, 0.9 * area, 1e-12);
  }
}

TEST(MesherTubes, AHalfRoundTubeKeepsItsTwoEdges) {
  ModelBuilder builder;
  const auto half = [&](double height) {
    const Vec3 up(0.0, 0.0, height);
    return Loop{{builder.line(LineType::kArc,
                              {Vec3(1, 0, 0) + up, Vec3(0, 1, 0) + up, Vec3(-1, 0, 0) + up}),
                 false},
                builder.straight(Vec3(-1, 0, 0) + up, Vec3(1, 0, 0) + up)};
  };
  const Loop bottom = half(0.0);
  const Loop top = half(1.0);
  const Model model = capped(std::move(builder), bottom, top);
  EXPECT_NEAR(solidVolume(model, 0.2), 0.5 * kHalfTurn, 0.006 * kHalfTurn);
}

TEST(MesherTubes, RimsMayBeBentAndInclined) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    ModelBuilder builder;
    const auto ring = [&](double height, int count) {
      const Vec3 tilt = random.inBox(0.3);
      const double start = random.between(0.0, 6.0);
      std::vector<Vec3> positions;
      for (int i = 0; i < count; ++i) {
        const Vec3 at = random.between(0.8, 1.2) * around(start + 2.0 * kHalfTurn * i / count);
        positions.push_back(at + Vec3(0.0, 0.0, height + glm::dot(tilt, at)));
      }
      positions.push_back(positions.front());
      return Loop{{builder.line(LineType::kSpline, positions), false}};
    };
    const Loop bottom = ring(0.0, 7);
    const Loop top = ring(2.0, 9);
    const double volume = solidVolume(capped(std::move(builder), bottom, top), 0.35);
    EXPECT_NEAR(volume, 2.0 * kHalfTurn, 0.5 * kHalfTurn);
  }
}

TEST(MesherTubes, NarrowTubesInACoarseFieldStayClosed) {
  ModelBuilder builder;
  const Loop bottom = rim(builder, 0.1, 0.0, 1, 0.0, false);
  const Loop top = rim(builder, 0.1, 4.0, 1, 1.0, false);
  const double exact = kHalfTurn * 0.01 * 4.0;
  EXPECT_NEAR(solidVolume(capped(std::move(builder), bottom, top), 2.0), exact, 0.25 * exact);
}

TEST(MesherTubes, AFlatRingIsATubeToo) {
  ModelBuilder builder;
  const Loop inner = rim(builder, 0.5, 0.0, 1, 0.0, false);
  const Loop outer = rim(builder, 1.0, 0.0, 1, 2.0, true);
  const Loop upper = rim(builder, 0.5, 1.0, 1, 0.0, false);
  const Loop upperOuter = rim(builder, 1.0, 1.0, 1, 4.0, false);
  builder.patch(PatchType::kTube, {inner, outer});
  builder.patch(PatchType::kTube, {upper, upperOuter});
  builder.patch(PatchType::kTube, {inner, upper});
  builder.patch(PatchType::kTube, {outer, upperOuter});
  const double exact = 0.75 * kHalfTurn;
  EXPECT_NEAR(solidVolume(builder.model, 0.2), exact, 0.02 * exact);
}

TEST(MesherTubes, TheMatchDoesNotDependOnWhereTheRimsBegin) {
  Random random(3);
  for (int round = 0; round < 50; ++round) {
    ModelBuilder builder;
    const double start = random.between(0.0, 6.0);
    const double other = random.between(0.0, 6.0);
    const bool isClockwise = random.coin();
    const Loop bottom = rim(builder, 1.0, 0.0, 1, start, false);
    const Loop top = rim(builder, 2.0, 1.0, 1, other, isClockwise);
    builder.patch(PatchType::kTube, {bottom, top});
    const ResolvedModel resolved(builder.model);
    const TubeSurface tube = tubeSurface(resolved, builder.model.patches.front());
    EXPECT_EQ(tube.isReversed(), isClockwise);
    for (double xi = 0.0; xi < 1.0; xi += 0.1) {
      const Vec3 expected = 1.5 * around(start + 2.0 * kHalfTurn * xi) + Vec3(0.0, 0.0, 0.5);
      ASSERT_LT(glm::length(tube.evaluate({xi, 0.5}).position - expected), 1e-13) << round;
    }
  }
}

// ---- invalid tubes -------------------------------------------------------------------------------

/// Returns the codes of the errors about patch 0.
std::vector<DiagnosticCode> errorsOfPatch(const Model& model) {
  std::vector<DiagnosticCode> codes;
  for (const Diagnostic& diagnostic :
       previewModel(model, {}, MeshOptions{.size = 0.3}).diagnostics) {
    const bool isAboutPatch = std::ranges::any_of(diagnostic.entities, [](const Entity& entity) {
      return entity.kind == EntityKind::kPatch && entity.index == 0;
    });
    if (isAboutPatch && diagnostic.code != DiagnosticCode::kOpenEdge)
      codes.push_back(diagnostic.code);
  }
  return codes;
}

TEST(MesherTubes, ATubeNeedsTwoLoops) {
  for (const std::size_t count : {1U, 3U}) {
    ModelBuilder builder;
    std::vector<Loop> loops;
    for (std::size_t i = 0; i < count; ++i)
      loops.push_back(rim(builder, 1.0, static_cast<double>(i), 1, 0.0, false));
    builder.patch(PatchType::kTube, loops);
    EXPECT_EQ(errorsOfPatch(builder.model), std::vector{DiagnosticCode::kWrongLoopCount});
  }
}

TEST(MesherTubes, RimsThatAreTheSameLineAreReported) {
  ModelBuilder builder;
  const Loop loop = rim(builder, 1.0, 0.0, 1, 0.0, false);
  builder.patch(PatchType::kTube, {loop, loop});
  EXPECT_EQ(errorsOfPatch(builder.model), std::vector{DiagnosticCode::kLoopsIntersect});
}

TEST(MesherTubes, RimsThatShareAPointAreReported) {
  ModelBuilder builder;
  const Loop first = rim(builder, 1.0, 0.0, 1, 0.0, false);
  const Loop second{builder.exactCircle({1, 0, 1}, 1.0, {0, 0, -1}, {1, 0, 0})};
  builder.patch(PatchType::kTube, {first, second});
  EXPECT_EQ(errorsOfPatch(builder.model), std::vector{DiagnosticCode::kLoopsIntersect});
}

TEST(MesherTubes, RimsOnTopOfEachOtherAreReported) {
  ModelBuilder builder;
  const Loop first = rim(builder, 1.0, 0.0, 1, 0.0, false);
  const Loop second = rim(builder, 1.0, 0.0, 1, 1.0, false);
  builder.patch(PatchType::kTube, {first, second});
  EXPECT_EQ(errorsOfPatch(builder.model), std::vector{DiagnosticCode::kLoopsIntersect});
}

TEST(MesherTubes, RimsThatCrossInTheirPlaneFold) {
  ModelBuilder builder;
  const Loop first = rim(builder, 1.0, 0.0, 1, 0.0, false);
  const Loop second{builder.exactCircle({1, 0, 0}, 1.1)};
  builder.patch(PatchType::kTube, {first, second});
  EXPECT_EQ(errorsOfPatch(builder.model), std::vector{DiagnosticCode::kDegeneratePatch});
}

}  // namespace
}  // namespace tetrafront::testing
