/// Whole runs: progress reports, independence of the slices, cancellation, and invalid options.

#include "tetrafront/mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"

namespace tetrafront {
namespace {

TEST(MeshRun, RejectsInvalidOptions) {
  const SurfaceMesh surface = testing::gridCube(2);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  for (const double invalid : {-1.0, 1e200, kInfinity, kNotANumber}) {
    for (int which = 0; which < 3; ++which) {
      MeshOptions options;
      (which == 0 ? options.size : which == 1 ? options.growth : options.gradation) = invalid;
      MeshRun run(surface.points, surface.triangles, options);
      ASSERT_EQ(run.advance(1), MeshStatus::kInvalidInput) << which << " " << invalid;
      ASSERT_EQ(run.diagnostics().size(), 1U);
      EXPECT_EQ(run.diagnostics()[0].code, DiagnosticCode::kOptionOutOfRange);
      EXPECT_EQ(run.diagnostics()[0].values[0], which);
    }
  }
}

/// Copies of the front during a run are closed and as large as reported, and do not affect the
/// mesh.
TEST(MeshRun, CopiesItsFrontWhileItAdvances) {
  const SurfaceMesh surface = testing::gridCube(6);
  const MeshOptions options;
  MeshRun run(surface.points, surface.triangles, options);
  EXPECT_TRUE(run.front().empty());
  std::size_t copies = 0;
  while (run.advance(20) == MeshStatus::kRunning) {
    const std::vector<double> corners = run.front();
    if (run.progress().phase != Phase::kVolume) {
      EXPECT_TRUE(corners.empty());
      continue;
    }
    ++copies;
    ASSERT_EQ(corners.size(), 9U * run.progress().frontFaces);
    // The area vectors of a closed surface add up to zero.
    Vec3 sum(0.0);
    const auto corner = [&](std::size_t i) {
      return Vec3(corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]);
    };
    for (std::size_t i = 0; 3 * i < corners.size(); i += 3) {
      sum += glm::cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i));
    }
    EXPECT_LT(glm::length(sum), 1e-12);
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_GT(copies, 5U);
  EXPECT_TRUE(run.front().empty());

  MeshRun other(surface.points, surface.triangles, options);
  while (other.advance(20) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.fingerprint(), other.fingerprint());
}

TEST(MeshRun, RefusesAbsurdSizesBeforeAnythingIsDivided) {
  Model model;
  model.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  model.lines.resize(6);
  const std::array<std::array<std::uint32_t, 2>, 6> ends{
      {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    model.lines[i] = {LineType::kStraight, {ends[i][0], ends[i][1]}};
  }
  model.patches = {{PatchType::kPlanar, {{{0, false}, {1, false}, {2, false}}}},
                   {PatchType::kPlanar, {{{0, false}, {4, false}, {3, true}}}},
                   {PatchType::kPlanar, {{{1, false}, {5, false}, {4, true}}}},
                   {PatchType::kPlanar, {{{2, false}, {3, false}, {5, true}}}}};
  for (const double size : {1e-4, 1e-9, 1e-320}) {
    MeshOptions options;
    options.size = size;
    MeshRun run(model, {}, options);
    while (run.advance(1) == MeshStatus::kRunning) {
      ASSERT_EQ(run.progress().phase, Phase::kCheck) << size;
    }
    ASSERT_EQ(run.status(), MeshStatus::kInvalidInput) << size;
    EXPECT_EQ(run.diagnostics().back().code, DiagnosticCode::kTooManyElements);
  }
  const SurfaceMesh surface = testing::gridCube(12);
  for (const double size : {1e-4, 1e-320}) {
    MeshOptions options;
    options.size = size;
    MeshRun run(surface.points, surface.triangles, options);
    while (run.advance(1000) == MeshStatus::kRunning) {
    }
    ASSERT_EQ(run.status(), MeshStatus::kInvalidInput) << size;
    EXPECT_EQ(run.diagnostics().back().code, DiagnosticCode::kTooManyElements);
  }
  MeshOptions options;
  options.size = 0.3;
  MeshRun run(model, {}, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
}

TEST(MeshRun, QuotesTheLimitOfTheCallerForALineWithTooManySides) {
  // The input check estimates few elements for a thin bar, but its lines have more than a million sides.
  MeshOptions options;
  options.size = 9e-7;
  options.maxTetrahedra = 19'999'999;
  MeshRun run(testing::boxModel({0, 0, 0}, {1, 1e-7, 1e-7}), {}, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kInvalidInput);
  const Diagnostic& tooMany = run.diagnostics().front();
  ASSERT_EQ(tooMany.code, DiagnosticCode::kTooManyElements);
  EXPECT_EQ(tooMany.entities.front().kind, EntityKind::kLine);
  EXPECT_EQ(tooMany.values.back(), options.maxTetrahedra);
}

TEST(MeshRun, ReportsPhasesInTheirOrderAndAFractionThatNeverFalls) {
  const SurfaceMesh surface = testing::geodesicSphere(6);
  MeshRun run(surface.points, surface.triangles, {});
  Progress before = run.progress();
  while (run.advance(200) == MeshStatus::kRunning) {
    const Progress now = run.progress();
    ASSERT_GE(now.phase, before.phase);
    ASSERT_GE(now.fraction, before.fraction);
    ASSERT_LE(now.fraction, 1.0);
    before = now;
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(run.progress().fraction, 1.0);
}

/// Solids for which the exact fill takes long.
std::vector<std::pair<const char*, SurfaceMesh>> needleSolids() {
  std::vector<std::pair<const char*, SurfaceMesh>> solids{
      {"plate", testing::needlePlate(6, 24, 0.05)},
      {"gear", testing::needleGear(100, 0.05)},
      {"thread", testing::screwThread(8, 64)}};
  for (auto& [name, solid] : solids) testing::rotateRandomly(solid, 2);
  return solids;
}

TEST(MeshRun, ReportsTheProgressOfTheExactFill) {
  for (const auto& [name, solid] : needleSolids()) {
    SCOPED_TRACE(name);
    MeshOptions options;
    options.exactFillOnly = true;
    options.optimization = Optimization::kNone;
    MeshRun run(solid.points, solid.triangles, options);
    Progress before = run.progress();
    int filling = 0;
    int steps = 0;
    int still = 0;
    int longestStill = 0;
    while (run.advance(20) == MeshStatus::kRunning) {
      const Progress now = run.progress();
      ASSERT_GE(now.fraction, before.fraction);
      ASSERT_LE(now.exactFillFraction, 1.0);
      if (now.exactFillFraction > 0.0) {
        ASSERT_EQ(now.phase, Phase::kVolume);
        ASSERT_GE(now.exactFillFraction, before.exactFillFraction);
        ++filling;
        const bool moves =
            now.fraction > before.fraction && now.exactFillFraction > before.exactFillFraction;
        steps += moves ? 1 : 0;
        still = moves ? 0 : still + 1;
        longestStill = std::max(longestStill, still);
      }
      before = now;
    }
    ASSERT_EQ(run.status(), MeshStatus::kDone);
    EXPECT_EQ(run.progress().fraction, 1.0);
    EXPECT_EQ(run.progress().exactFillFraction, 0.0);
    EXPECT_GT(steps, 50);
    EXPECT_LT(longestStill, 0.25 * filling) << "of " << filling << " slices";
  }
}

TEST(MeshRun, ProgressNeverFallsWhenTheExactFillTriesAgain) {
  const SurfaceMesh solid = testing::flatPocket();
  MeshOptions options;
  options.exactFillOnly = true;
  options.optimization = Optimization::kNone;
  MeshRun run(solid.points, solid.triangles, options);
  Progress before = run.progress();
  int steps = 0;
  while (run.advance(20) == MeshStatus::kRunning) {
    const Progress now = run.progress();
    ASSERT_GE(now.fraction, before.fraction);
    ASSERT_TRUE(now.exactFillFraction >= before.exactFillFraction || now.exactFillFraction == 0.0);
    steps += now.exactFillFraction > before.exactFillFraction ? 1 : 0;
    before = now;
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_GT(run.recovery().filled, 1U);
  EXPECT_GT(steps, 10);
}

/// The progress rises until everything that the front leaves is filled.
TEST(MeshRun, ProgressRisesWhileNeedlesAreFilled) {
  const SurfaceMesh solid = testing::coarseTube(128, 0.95, 100.0);
  MeshOptions options;
  options.optimization = Optimization::kNone;
  MeshRun run(solid.points, solid.triangles, options);
  double before = 0.0;
  int inVolume = 0;
  int still = 0;
  int longestStill = 0;
  while (run.advance(20) == MeshStatus::kRunning) {
    const Progress now = run.progress();
    ASSERT_GE(now.fraction, before);
    if (now.phase == Phase::kVolume) {
      ++inVolume;
      still = now.fraction > before ? 0 : still + 1;
      longestStill = std::max(longestStill, still);
    }
    before = now.fraction;
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  ASSERT_GT(run.recovery().filled, 0U);
  EXPECT_LT(longestStill, 0.1 * inVolume) << "of " << inVolume << " slices";
}

TEST(MeshRun, KeepsTheWholeFrontIfCancelledDuringTheExactFill) {
  SurfaceMesh solid = testing::needlePlate(6, 24, 0.05);
  testing::rotateRandomly(solid, 2);
  MeshOptions options;
  options.exactFillOnly = true;
  for (const double stop : {0.05, 0.8}) {
    MeshRun run(solid.points, solid.triangles, options);
    while (run.progress().exactFillFraction < stop && run.advance(20) == MeshStatus::kRunning) {
    }
    ASSERT_EQ(run.status(), MeshStatus::kRunning) << stop;
    const double reached = run.progress().fraction;
    run.cancel();
    EXPECT_EQ(run.status(), MeshStatus::kCancelled);
    EXPECT_EQ(run.advance(1000), MeshStatus::kCancelled);
    EXPECT_EQ(run.progress().fraction, reached);
    EXPECT_LT(reached, 1.0);
    EXPECT_EQ(run.volume().tetrahedra.size(), 0U);
    EXPECT_EQ(run.volume().front.size(), solid.triangles.size());
  }
}

TEST(MeshRun, KeepsThePartialMeshWheneverItIsCancelled) {
  const SurfaceMesh surface = testing::geodesicSphere(4);
  MeshRun whole(surface.points, surface.triangles, {});
  int slices = 0;
  while (whole.advance(300) == MeshStatus::kRunning) ++slices;
  for (int stop = 0; stop < slices; stop += 12) {
    MeshRun run(surface.points, surface.triangles, {});
    for (int i = 0; i < stop; ++i) run.advance(300);
    run.cancel();
    ASSERT_EQ(run.status(), MeshStatus::kCancelled);
    ASSERT_EQ(run.advance(300), MeshStatus::kCancelled);
    const VolumeMesh mesh = run.volume();
    // Once the front has closed, there is a valid mesh, optimized or not.
    if (mesh.front.empty() && !mesh.tetrahedra.empty()) {
      ASSERT_EQ(testing::complaintAbout(mesh, run.surface()), "") << "stopped at " << stop;
    }
  }
}

/// The sides of a prism are in one plane up to rounding, so four of their corners may enclose a positive volume. With these
/// diagonals, no three elements fill it.
TEST(MeshRun, LeavesNoFlatElementOnAFacePlaneUpToRounding) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SurfaceMesh prism = testing::schoenhardtPrism(0.0);
    for (std::size_t i = 2; i < prism.points.size(); i += 3)
      prism.points[i] *= 0.5 + 0.1 * static_cast<double>(seed % 10);
    testing::rotateRandomly(prism, seed);
    for (const Optimization level : {Optimization::kFast, Optimization::kDefault}) {
      MeshOptions options;
      options.optimization = level;
      MeshRun run(prism.points, prism.triangles, options);
      while (run.advance(1000) == MeshStatus::kRunning) {
      }
      ASSERT_EQ(run.status(), MeshStatus::kDone) << seed;
      EXPECT_GT(run.quality().minDihedral, 8.0) << seed;
    }
  }
}

TEST(MeshRun, GradesInwardsFromASurfaceFarCoarserThanTheTargetSize) {
  const SurfaceMesh surface = testing::gridBox(Vec3(0.0), Vec3(3.0, 3.0, 2.0), {3, 3, 2});
  for (const double size : {0.5, 0.2, 0.05}) {
    MeshOptions options;
    options.size = size;
    MeshRun run(surface.points, surface.triangles, options);
    while (run.advance(1000) == MeshStatus::kRunning) {
    }
    ASSERT_EQ(run.status(), MeshStatus::kDone) << size;
    EXPECT_GT(run.quality().minDihedral, 25.0) << size;
    EXPECT_EQ(run.recovery().filled, 0U) << size;
  }
}

struct Solid {
  std::string name;
  SurfaceMesh surface;
  MeshOptions options;
};

/// Together, these solids need every step of recovery.
std::vector<Solid> solidsOfEveryRung() {
  MeshOptions striving;
  striving.optimization = Optimization::kThorough;
  MeshOptions filling = striving;
  filling.exactFillOnly = true;
  return {{"tower", testing::schoenhardtTower(3, 57.0), striving},
          {"notches", testing::chazellePolyhedron(3, 0.1), striving},
          {"saddles", testing::saddleSlab(3, 0.1), striving},
          {"fine patch", testing::cubeWithFinePatch(6), striving},
          {"sphere", testing::geodesicSphere(4), striving},
          {"sphere filled exactly", testing::geodesicSphere(4), filling},
          {"cavity filled exactly", testing::cubeWithSphericalCavity(3, 3), filling}};
}

constexpr std::array<std::uint32_t, 3> kShortSlices{1, 17, 1000};
constexpr std::uint32_t kOneSlice = 10'000'000;

void runInSlices(MeshRun& run, std::uint32_t budget) {
  while (run.advance(budget) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
}

TEST(MeshRun, GivesTheSameMeshInSlicesOfAnyLengthAtEveryStepOfRecovery) {
  RecoverySummary most;
  for (const Solid& solid : solidsOfEveryRung()) {
    SCOPED_TRACE(solid.name);
    MeshRun whole(solid.surface.points, solid.surface.triangles, solid.options);
    runInSlices(whole, kOneSlice);
    const RecoverySummary summary = whole.recovery();
    most.relaxed = std::max(most.relaxed, summary.relaxed);
    most.starred = std::max(most.starred, summary.starred);
    most.remeshed = std::max(most.remeshed, summary.remeshed);
    most.filled = std::max(most.filled, summary.filled);
    for (const std::uint32_t budget : kShortSlices) {
      MeshRun run(solid.surface.points, solid.surface.triangles, solid.options);
      runInSlices(run, budget);
      EXPECT_EQ(run.fingerprint(), whole.fingerprint()) << "slices of " << budget;
    }
  }
  EXPECT_GT(most.relaxed, 0U);
  EXPECT_GT(most.starred, 0U);
  EXPECT_GT(most.remeshed, 0U);
  EXPECT_GT(most.filled, 0U);
}

TEST(MeshRun, GivesTheSameMeshOfAModelInSlicesOfAnyLength) {
  const Model model = testing::randomBentBox(3, 0.2);
  MeshOptions options;
  options.size = 0.15;
  MeshRun whole(model, {}, options);
  runInSlices(whole, kOneSlice);
  for (const std::uint32_t budget : kShortSlices) {
    MeshRun run(model, {}, options);
    runInSlices(run, budget);
    EXPECT_EQ(run.surface().points, whole.surface().points) << "slices of " << budget;
    EXPECT_EQ(run.surface().triangles, whole.surface().triangles) << "slices of " << budget;
    EXPECT_EQ(run.fingerprint(), whole.fingerprint()) << "slices of " << budget;
  }
}

}  // namespace
}  // namespace tetrafront
