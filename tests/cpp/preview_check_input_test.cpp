// The check of a model and its sizes: it reports all problems at once, and the same ones in a preview and in a run.

#include "preview/check_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "model/resolved_model.h"
#include "support/models.h"
#include "support/random.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

BackgroundGrid gridOf(double size) {
  return boxGrid(Vec3(-9.0), Vec3(9.0), [=](const Vec3&) { return size; });
}

/// Both models in one, without common points.
Model both(Model first, const Model& second) {
  const auto points = static_cast<std::uint32_t>(first.points.size());
  const auto lines = static_cast<std::uint32_t>(first.lines.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (Line line : second.lines) {
    for (std::uint32_t& point : line.points) point += points;
    first.lines.push_back(line);
  }
  for (Patch patch : second.patches) {
    for (Loop& loop : patch.loops)
      for (OrientedLine& walked : loop) walked.line += lines;
    first.patches.push_back(patch);
  }
  return first;
}

/// A closed tube of four Coons patches along z, with planar ends.
Model tube(double radius, double low, double high) {
  ModelBuilder builder;
  const Loop bottom = builder.circle({0, 0, low}, radius, 4);
  const Loop top = builder.circle({0, 0, high}, radius, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto corner = [&](std::size_t k, double z) {
      const double angle = 0.5 * std::numbers::pi * static_cast<double>(k % 4);
      return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    const auto find = [&](const Vec3& position) {
      const Model& model = builder.model;
      return *std::ranges::min_element(
          model.points, {}, [&](const Vec3& point) { return glm::length(point - position); });
    };
    const OrientedLine up = builder.straight(find(corner(i + 1, low)), find(corner(i + 1, high)));
    const OrientedLine down = builder.straight(find(corner(i, high)), find(corner(i, low)));
    builder.patch(PatchType::kCoons, {{bottom[i], up, {top[i].line, !top[i].reversed}, down}});
  }
  builder.patch(PatchType::kPlanar, {bottom});
  builder.patch(PatchType::kPlanar, {top});
  return builder.model;
}

using Finding = std::tuple<DiagnosticCode, std::vector<std::pair<EntityKind, std::uint32_t>>>;

std::set<Finding> errorsAmong(const std::vector<Diagnostic>& diagnostics) {
  std::set<Finding> result;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.severity != Severity::kError) continue;
    std::vector<std::pair<EntityKind, std::uint32_t>> entities;
    for (const Entity& entity : diagnostic.entities)
      entities.emplace_back(entity.kind, entity.index);
    result.emplace(diagnostic.code, entities);
  }
  return result;
}

std::vector<Diagnostic> foundIn(const Model& model, double size = 0.5) {
  return checkInput(model, gridOf(size), {}).preview.diagnostics;
}

std::size_t countOf(const std::vector<Diagnostic>& found, DiagnosticCode code) {
  return static_cast<std::size_t>(std::ranges::count(found, code, &Diagnostic::code));
}

const Diagnostic& the(DiagnosticCode code, const std::vector<Diagnostic>& found) {
  return *std::ranges::find(found, code, &Diagnostic::code);
}

// ---- intersecting patches ----------------------------------------------------------------------

TEST(IntersectingPatches, ValidModelsHaveNone) {
  EXPECT_TRUE(foundIn(boxModel({0, 0, 0}, {1, 2, 3})).empty());
  EXPECT_TRUE(foundIn(tube(1.0, 0.0, 2.0)).empty());
  for (std::uint64_t seed = 0; seed < 12; ++seed)
    EXPECT_TRUE(errorsAmong(foundIn(randomBentBox(seed, 0.15))).empty()) << seed;
}

TEST(IntersectingPatches, BoxesThatCrossReportEveryPairWithAPosition) {
  const Model model =
      both(boxModel({0, 0, 0}, {1, 1, 1}), boxModel({0.5, 0.25, 0.25}, {2, 0.75, 0.75}));
  const std::vector<Diagnostic> found = foundIn(model);
  // The four long patches of the second box intersect the right patch of the first.
  ASSERT_EQ(countOf(found, DiagnosticCode::kPatchesIntersect), 4U);
  EXPECT_EQ(errorsAmong(found).size(), 4U);
  for (const Diagnostic& meeting : found) {
    ASSERT_EQ(meeting.entities.size(), 2U);
    EXPECT_LT(meeting.entities[0].index, 6U);
    EXPECT_GE(meeting.entities[1].index, 6U);
    ASSERT_TRUE(meeting.hasPosition);
    // The position is on the right patch and on one of the long ones.
    EXPECT_NEAR(meeting.position.x, 1.0, 1e-12);
    const Vec3 fromAxis = glm::abs(meeting.position - Vec3(1.0, 0.5, 0.5));
    EXPECT_NEAR(std::max(fromAxis.y, fromAxis.z), 0.25, 1e-12);
  }
}

TEST(IntersectingPatches, ATipThatTouchesIsThePosition) {
  ModelBuilder builder;
  builder.model = boxModel({0, 0, 0}, {2, 2, 2});
  const Vec3 tip(1.0, 1.0, 2.0);
  const std::array<Vec3, 3> base{Vec3(0.7, 1.0, 1.5), Vec3(1.3, 1.0, 1.5), Vec3(1.0, 1.4, 1.5)};
  builder.patch(PatchType::kPlanar, {builder.polygon({base[0], base[1], base[2]})});
  for (std::size_t k = 0; k < 3; ++k)
    builder.patch(PatchType::kPlanar, {builder.polygon({base[k], base[(k + 1) % 3], tip})});
  const std::vector<Diagnostic> found = foundIn(builder.model);
  ASSERT_EQ(countOf(found, DiagnosticCode::kPatchesIntersect), 3U);
  for (const Diagnostic& meeting : found) EXPECT_LT(glm::length(meeting.position - tip), 1e-12);
}

TEST(IntersectingPatches, ABoxStandingOnAnotherOverlapsIt) {
  const Model model = both(boxModel({0, 0, 0}, {2, 2, 1}), boxModel({0.5, 0.5, 1}, {1.5, 1.5, 2}));
  const std::vector<Diagnostic> found = foundIn(model);
  EXPECT_GE(countOf(found, DiagnosticCode::kPatchesIntersect), 1U);
  EXPECT_TRUE(std::ranges::any_of(found, [](const Diagnostic& meeting) {
    return meeting.entities[0].index == 1 && meeting.entities[1].index == 6;
  })) << "the top of the one and the bottom of the other";
}

TEST(IntersectingPatches, CurvedPatchesThatCrossALittleAreFound) {
  for (const double depth : {0.2, 0.02}) {
    const Model model =
        both(tube(1.0, 0.0, 2.0), boxModel({1.0 - depth, -0.5, 0.5}, {3, 0.5, 1.5}));
    EXPECT_GE(countOf(foundIn(model), DiagnosticCode::kPatchesIntersect), 1U) << depth;
  }
}

TEST(IntersectingPatches, CurvedPatchesThatAreMerelyCloseAreNotReported) {
  // Splines only approximate circles: find the range of their radii.
  const Model outer = tube(1.0, 0.0, 2.0);
  const ResolvedModel resolved(outer);
  double least = 1.0;
  double most = 1.0;
  for (int i = 0; i <= 1000; ++i) {
    const double radius = glm::length(resolved.curve(LineId(0U)).position(0.001 * i));
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  ASSERT_GT(least, 0.9);
  // Rotate one of them, so that the chords of the outer one intersect the inner one.
  for (const double gap : {0.1, 3e-3, 3e-4}) {
    Model inner = tube((1.0 - gap) * least / most, 0.5, 1.5);
    const double c = std::cos(0.3);
    const double s = std::sin(0.3);
    for (Vec3& point : inner.points)
      point = Vec3(c * point.x - s * point.y, s * point.x + c * point.y, point.z);
    const std::vector<Diagnostic> found = foundIn(both(outer, inner));
    EXPECT_TRUE(errorsAmong(found).empty()) << gap;
  }
}

TEST(IntersectingPatches, PatchesDrawnManyTimesAreReportedUpToALimit) {
  Model model = boxModel(Vec3(0.0), Vec3(1.0));
  const Patch face = model.patches.front();
  model.patches.insert(model.patches.end(), 200, face);
  const std::vector<Diagnostic> found = previewModel(model, {}, {.size = 0.5}).diagnostics;
  const auto meeting = std::ranges::count(found, DiagnosticCode::kPatchesIntersect,
                                          [](const auto& d) { return d.code; });
  EXPECT_EQ(meeting, 1000);  // of 20 100 pairs
}

TEST(IntersectingPatches, TouchingAtACommonLineOrPointIsValid) {
  ModelBuilder builder;
  builder.model = boxModel({0, 0, 0}, {1, 1, 1});
  const auto face = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    builder.patch(PatchType::kPlanar, {builder.polygon({a, b, c, d})});
  };
  // A second box with the common line x = y = 1.
  const auto p = [](double x, double y, double z) { return Vec3(1 + x, 1 + y, z); };
  face(p(0, 0, 0), p(1, 0, 0), p(1, 1, 0), p(0, 1, 0));
  face(p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1));
  face(p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  face(p(0, 1, 0), p(1, 1, 0), p(1, 1, 1), p(0, 1, 1));
  face(p(0, 0, 0), p(0, 1, 0), p(0, 1, 1), p(0, 0, 1));
  face(p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  EXPECT_EQ(countOf(foundIn(builder.model), DiagnosticCode::kPatchesIntersect), 0U);
}

// ---- regions, sizes, counts --------------------------------------------------------------------

TEST(CheckInput, NestedShellsAreReportedWithTheirRegionsAndCavities) {
  const Model hollow = both(boxModel({0, 0, 0}, {4, 4, 4}), boxModel({1, 1, 1}, {3, 3, 3}));
  std::vector<Diagnostic> found = foundIn(hollow);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kNestedRegions);
  EXPECT_EQ(found[0].severity, Severity::kInformation);
  EXPECT_EQ(found[0].values, (std::vector<double>{1.0, 1.0}));
  found = foundIn(both(hollow, boxModel({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5})));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].values, (std::vector<double>{2.0, 1.0}));
}

TEST(CheckInput, TheNumberOfElementsIsEstimatedFromTheVolumeBeforeMeshing) {
  const Model box = boxModel({0, 0, 0}, {1, 2, 3});
  MeshOptions options;
  options.size = 0.001;
  const std::vector<Diagnostic> found = checkInput(box, {}, options).preview.diagnostics;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kTooManyElements);
  // A regular tetrahedron with edges of length h has the volume h^3 / (6 sqrt 2).
  EXPECT_NEAR(found[0].values.at(0) / (6.0 * 6.0 * std::sqrt(2.0) * 1e9), 1.0, 1e-6);
  options.size = 0.02;
  EXPECT_TRUE(checkInput(box, {}, options).preview.diagnostics.empty());
}

TEST(CheckInput, TooManyElementsNameTheSourceThatRequiresTheMost) {
  const Model box = boxModel({0, 0, 0}, {1, 2, 3});
  BackgroundGrid grid;
  const auto source = [](const Vec3& position, double size, double distance) {
    return SizeSource{SourceType::kPoint, {position, Vec3(0.0), Vec3(0.0)}, size, distance, 0.3};
  };
  // The second source is smaller than the third, but acts in a much smaller volume.
  grid.sources = {source({0.5, 1, 1}, 0.1, 0.3), source({0.5, 1, 2}, 1e-4, 1e-4),
                  source({0.5, 1, 1.5}, 1e-3, 0.4)};
  MeshOptions options;
  options.size = 0.5;
  std::vector<Diagnostic> found = checkInput(box, grid, options).preview.diagnostics;
  ASSERT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
  ASSERT_EQ(found.back().entities.size(), 1U);
  EXPECT_EQ(found.back().entities[0].kind, EntityKind::kSource);
  EXPECT_EQ(found.back().entities[0].index, 2U);
  // The uniform size requires more than any source.
  options.size = 1e-3;
  found = checkInput(box, grid, options).preview.diagnostics;
  ASSERT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
  EXPECT_TRUE(found.back().entities.empty());
}

TEST(CheckInput, TooManyElementsInAPlateBlameNoSourceForVolumeOutsideIt) {
  BackgroundGrid grid;
  grid.sources = {{SourceType::kPoint, {Vec3(5, 5, 0.05), Vec3(0.0), Vec3(0.0)}, 0.05, 1.0, 0.3}};
  MeshOptions options;
  options.size = 0.1;
  options.maxTetrahedra = 50'000;
  const Model plate = boxModel({0, 0, 0}, {10, 10, 0.1});
  std::vector<Diagnostic> found = checkInput(plate, grid, options).preview.diagnostics;
  ASSERT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
  EXPECT_TRUE(found.back().entities.empty());
  // With a greater distance, the source requires the most in the plate, too.
  grid.sources[0].distance = 4.0;
  found = checkInput(plate, grid, options).preview.diagnostics;
  ASSERT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
  ASSERT_EQ(found.back().entities.size(), 1U);
  EXPECT_EQ(found.back().entities[0].kind, EntityKind::kSource);
}

TEST(CheckInput, TooManyElementsNameTheBackgroundNodeThatRequiresTheMost) {
  BackgroundGrid grid = coveringGrid(Vec3(0.0), Vec3(1, 2, 3), 0.005, CoverShape::kBox);
  grid.nodes[3].size = 0.004;
  const std::vector<Diagnostic> found =
      checkInput(boxModel({0, 0, 0}, {1, 2, 3}), grid, {}).preview.diagnostics;
  ASSERT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
  ASSERT_EQ(found.back().entities.size(), 1U);
  EXPECT_EQ(found.back().entities[0].kind, EntityKind::kBackgroundNode);
  EXPECT_EQ(found.back().entities[0].index, 3U);
}

TEST(CheckInput, ElementsOfThinRegionsAreEstimatedFromTheSurface) {
  MeshOptions options;
  options.size = 1e-5;
  const std::vector<Diagnostic> found =
      checkInput(boxModel({0, 0, 0}, {1, 1, 1e-9}), {}, options).preview.diagnostics;
  EXPECT_EQ(countOf(found, DiagnosticCode::kTooManyElements), 1U);
}

TEST(CheckInput, ASizeLargerThanTheModelIsAWarning) {
  const Model box = boxModel({0, 0, 0}, {1, 2, 3});
  EXPECT_TRUE(foundIn(box, 2.9).empty());
  const std::vector<Diagnostic> found = foundIn(box, 3.1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kSizeTooLarge);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_NEAR(found[0].values.at(0), 3.1, 1e-9);
  EXPECT_NEAR(found[0].values.at(1), 3.0, 1e-9);
}

TEST(CheckInput, ACoordinateOutOfRangeIsReported) {
  Model box = boxModel({0, 0, 0}, {1, 1, 1});
  box.points[3].y = -1e200;
  BackgroundGrid grid = boxGrid(Vec3(-1.0), Vec3(2.0), [](const Vec3&) { return 0.5; });
  grid.nodes[0].position.z = 1e201;
  grid.sources = {{SourceType::kPoint, {Vec3(1e202, 0.0, 0.0), Vec3(0.0), Vec3(0.0)}, 0.5}};
  std::vector<double> reported;
  for (const Diagnostic& finding : checkInput(box, grid, {}).preview.diagnostics)
    if (finding.code == DiagnosticCode::kNotFinite) reported.push_back(finding.values.at(0));
  std::sort(reported.begin(), reported.end());
  EXPECT_EQ(reported, (std::vector<double>{-1e200, 1e201, 1e202}));
}

// ---- all problems at once, in a preview and in a run -------------------------------------------

/// A box with many problems, each at a different entity.
Model damagedBox() {
  Model model = both(boxModel({0, 0, 0}, {1, 1, 1}), boxModel({0.5, 0.25, 0.25}, {2, 0.75, 0.75}));
  model = both(model, boxModel({4, 0, 0}, {5, 1, 1}));
  model.patches.pop_back();                       // open
  model.points.push_back({-3, 0, std::nan("")});  // not finite
  model.points.push_back({-4, 0, 0});
  model.points.push_back({-4, 0, 0});  // drawn twice
  const auto last = static_cast<std::uint32_t>(model.points.size() - 1);
  model.lines.push_back({LineType::kStraight, {last, last}});    // no length
  model.lines.push_back({LineType::kStraight, {last, 12345}});   // leads nowhere
  model.lines.push_back(model.lines[3]);                         // drawn twice
  model.patches.push_back({PatchType::kCoons, {{{0, false}}}});  // too few lines, not closed
  return model;
}

TEST(CheckInput, NoProblemHidesAnother) {
  BackgroundGrid grid = boxGrid(Vec3(-9.0), {4.5, 9, 9}, [](const Vec3&) { return 0.5; });
  const std::vector<Diagnostic> found = checkInput(damagedBox(), grid, {}).preview.diagnostics;
  for (const DiagnosticCode code :
       {DiagnosticCode::kNotFinite, DiagnosticCode::kDuplicatePoints,
        DiagnosticCode::kZeroLengthLine, DiagnosticCode::kIndexOutOfRange,
        DiagnosticCode::kDuplicateLines, DiagnosticCode::kWrongLineCount,
        DiagnosticCode::kLoopNotClosed, DiagnosticCode::kOpenEdge,
        DiagnosticCode::kPatchesIntersect, DiagnosticCode::kOutsideBackgroundGrid})
    EXPECT_GE(countOf(found, code), 1U) << static_cast<int>(code);
  grid.nodes[2].size = 0.0;
  MeshOptions options;
  options.growth = -1.0;
  const std::vector<Diagnostic> worse = checkInput(damagedBox(), grid, options).preview.diagnostics;
  EXPECT_EQ(countOf(worse, DiagnosticCode::kSizeOutOfRange), 1U);
  EXPECT_EQ(countOf(worse, DiagnosticCode::kOptionOutOfRange), 1U);
  EXPECT_EQ(the(DiagnosticCode::kDuplicateLines, worse).severity, Severity::kWarning);
}

TEST(CheckInput, PreviewAndRunFindTheSame) {
  const std::vector<std::function<void(Model&, BackgroundGrid&)>> damages{
      [](Model& model, BackgroundGrid&) { model = damagedBox(); },
      [](Model& model, BackgroundGrid&) { model.patches.erase(model.patches.begin() + 2); },
      [](Model& model, BackgroundGrid&) { model.patches.push_back(model.patches[0]); },
      [](Model& model, BackgroundGrid&) { model.points[3] = model.points[2]; },
      [](Model& model, BackgroundGrid&) { model.points[3] += Vec3(0.3, 0.2, 0.1); },
      [](Model& model, BackgroundGrid&) { model.patches[1].loops[0][2].reversed ^= true; },
      [](Model& model, BackgroundGrid&) {
        std::swap(model.patches[1].loops[0][2], model.patches[1].loops[0][1]);
      },
      [](Model& model, BackgroundGrid&) { model.patches[4].loops.clear(); },
      [](Model& model, BackgroundGrid&) {
        model = both(model, boxModel({0.5, 0.5, 0.5}, {2, 2, 2}));
      },
      [](Model&, BackgroundGrid& grid) { grid.tetrahedra.clear(); },
      [](Model&, BackgroundGrid& grid) { grid.tetrahedra[1][2] = 99; },
      [](Model&, BackgroundGrid& grid) {
        for (BackgroundNode& node : grid.nodes) node.size = 1e-4;
      },
      [](Model& model, BackgroundGrid&) {
        for (Vec3& point : model.points) point *= 8.5;
      },
  };
  for (std::size_t i = 0; i < damages.size(); ++i) {
    Model model = boxModel({0, 0, 0}, {1, 1.5, 2});
    BackgroundGrid grid = gridOf(0.6);
    damages[i](model, grid);
    const std::set<Finding> seen = errorsAmong(previewModel(model, grid).diagnostics);
    MeshRun run(model, grid, {});
    while (run.advance(5000) == MeshStatus::kRunning) {
    }
    EXPECT_FALSE(seen.empty()) << i;
    EXPECT_EQ(run.status(), MeshStatus::kInvalidInput) << i;
    EXPECT_EQ(errorsAmong(run.diagnostics()), seen) << i;
  }
}

}  // namespace
}  // namespace tetrafront::testing
