// Points and lines drawn twice, and the closure of a surface as its loops show it.

#include "model/check_closure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/check_model.h"
#include "support/models.h"

namespace tetrafront::testing {
namespace {

std::vector<LineId> eachAlone(const Model& model) {
  std::vector<LineId> lines;
  for (const LineId line : IdRange<LineId>(model.lines.size())) lines.push_back(line);
  return lines;
}

Closure closureOf(const Model& model) {
  CheckedModel found = checkModel(model);
  found.duplicates.lines = eachAlone(model);
  return checkClosure(model, found);
}

/// A ring of `count` Coons patches; every line across is shared by two. If `twisted`, the last
/// patch joins the first upside down.
Model ring(int count, bool twisted) {
  ModelBuilder builder;
  for (int i = 0; i < count; ++i) {
    const auto position = [&](int at, double z) { return Vec3(at, at * at, z); };
    const bool turns = twisted && i + 1 == count;
    const int next = (i + 1) % count;
    builder.patch(PatchType::kCoons,
                  {{builder.straight(position(i, 0), position(next, turns ? 1 : 0)),
                    builder.straight(position(next, turns ? 1 : 0), position(next, turns ? 0 : 1)),
                    builder.straight(position(next, turns ? 0 : 1), position(i, 1)),
                    builder.straight(position(i, 1), position(i, 0))}});
  }
  return builder.model;
}

std::size_t countOf(const std::vector<Diagnostic>& found, DiagnosticCode code) {
  return static_cast<std::size_t>(std::ranges::count(found, code, &Diagnostic::code));
}

TEST(ModelClosure, ClosedModelsPass) {
  EXPECT_TRUE(closureOf(boxModel({0, 0, 0}, {1, 2, 3})).isPlain);
  EXPECT_TRUE(closureOf(randomBentBox(1, 0.1)).diagnostics.empty());
}

TEST(ModelClosure, EveryOpenLineIsReportedWithItsPatch) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.patches.erase(model.patches.begin() + 1);
  const Closure closure = closureOf(model);
  EXPECT_FALSE(closure.isPlain);
  ASSERT_EQ(closure.diagnostics.size(), 4U);
  for (const Diagnostic& open : closure.diagnostics) {
    EXPECT_EQ(open.code, DiagnosticCode::kOpenEdge);
    ASSERT_EQ(open.entities.size(), 2U);
    EXPECT_EQ(open.entities[0].kind, EntityKind::kLine);
    EXPECT_EQ(open.entities[1].kind, EntityKind::kPatch);
    const Loop& loop = model.patches[open.entities[1].index].loops.front();
    EXPECT_TRUE(std::ranges::any_of(
        loop, [&](const OrientedLine& walked) { return walked.line == open.entities[0].index; }));
    EXPECT_TRUE(open.hasPosition);
    EXPECT_DOUBLE_EQ(open.position.z, 1.0) << "in the middle of an edge of the missing top";
  }
}

TEST(ModelClosure, ThreePatchesMayShareALine) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.patches.push_back(model.patches[0]);
  const Closure closure = closureOf(model);
  EXPECT_TRUE(closure.diagnostics.empty());
  EXPECT_FALSE(closure.isPlain);
}

TEST(ModelClosure, TwistedRingCannotBeOriented) {
  EXPECT_EQ(
      countOf(closureOf(ring(5, false)).diagnostics, DiagnosticCode::kInconsistentOrientation), 0U);
  EXPECT_EQ(countOf(closureOf(ring(5, true)).diagnostics, DiagnosticCode::kInconsistentOrientation),
            1U);
}

TEST(ModelClosure, OrientationIsRelativeToTheFirstLoop) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  const std::vector<std::uint8_t> before = closureOf(model).isReversed;
  Loop& loop = model.patches[3].loops.front();
  std::ranges::reverse(loop);
  for (OrientedLine& walked : loop) walked.reversed = !walked.reversed;
  std::vector<std::uint8_t> after = closureOf(model).isReversed;
  EXPECT_NE(after[3], before[3]);
  after[3] = before[3];
  EXPECT_EQ(after, before);
}

/// If one line of a loop has the wrong direction, the diagnostic is about this loop, not about the
/// orientation of the patches around it.
TEST(ModelClosure, AnInvalidLoopDoesNotDefineOrientation) {
  for (std::size_t patch = 0; patch < 6; ++patch) {
    for (std::size_t side = 0; side < 4; ++side) {
      Model model = boxModel({0, 0, 0}, {1, 1, 1});
      OrientedLine& walked = model.patches[patch].loops.front()[side];
      walked.reversed = !walked.reversed;
      EXPECT_EQ(countOf(diagnoseModel(model), DiagnosticCode::kLoopNotClosed), 2U);
      const Closure closure = closureOf(model);
      EXPECT_TRUE(closure.diagnostics.empty()) << patch << ", " << side;
      EXPECT_FALSE(closure.isPlain);
    }
  }
}

TEST(ModelClosure, SeparateSolidsAreSeparateComponents) {
  ModelBuilder builder;
  builder.model = boxModel({0, 0, 0}, {1, 1, 1});
  const Model other = boxModel({3, 0, 0}, {4, 1, 1});
  const auto points = static_cast<std::uint32_t>(builder.model.points.size());
  const auto lines = static_cast<std::uint32_t>(builder.model.lines.size());
  Model both = builder.model;
  both.points.insert(both.points.end(), other.points.begin(), other.points.end());
  for (Line line : other.lines) {
    for (std::uint32_t& point : line.points) point += points;
    both.lines.push_back(line);
  }
  for (Patch patch : other.patches) {
    for (OrientedLine& walked : patch.loops.front()) walked.line += lines;
    both.patches.push_back(patch);
  }
  const std::vector<PatchId> component = closureOf(both).component;
  for (std::size_t patch = 0; patch < component.size(); ++patch)
    EXPECT_EQ(component[patch], PatchId(patch < 6 ? 0U : 6U));
}

TEST(ModelClosure, InvalidReferencesAreIgnored) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.patches[2].loops[0][1].line = 4'000'000;
  model.lines[0].points.clear();
  model.lines[1].points = {77, 78};
  EXPECT_FALSE(closureOf(model).diagnostics.empty());
}

// ---- drawn twice -------------------------------------------------------------------------------

/// A box whose patch `apart` has corners and lines of its own.
Model boxWithASeparatePatch(std::size_t apart) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  for (OrientedLine& walked : model.patches[apart].loops.front()) {
    Line line = model.lines[walked.line];
    for (std::uint32_t& point : line.points) {
      const Vec3 position = model.points[point];
      const auto own = std::find(model.points.begin() + 8, model.points.end(), position);
      point = static_cast<std::uint32_t>(own - model.points.begin());
      if (own == model.points.end()) model.points.push_back(position);
    }
    walked.line = static_cast<std::uint32_t>(model.lines.size());
    model.lines.push_back(line);
  }
  return model;
}

TEST(ModelDuplicates, DuplicateCornersAndLinesAreErrorsButNotTheGap) {
  const Model model = boxWithASeparatePatch(2);
  ASSERT_EQ(model.points.size(), 12U);
  const CheckedModel found = checkModel(model);
  EXPECT_EQ(countOf(found.diagnostics, DiagnosticCode::kDuplicatePoints), 4U);
  EXPECT_EQ(countOf(found.diagnostics, DiagnosticCode::kDuplicateLines), 4U);
  EXPECT_EQ(found.diagnostics.size(), 8U);
  for (const Diagnostic& twice : found.diagnostics) {
    EXPECT_EQ(twice.severity, Severity::kError);
    EXPECT_TRUE(twice.hasPosition);
    ASSERT_EQ(twice.entities.size(), 2U);
    EXPECT_LT(twice.entities[0].index, twice.entities[1].index);
  }
  EXPECT_TRUE(checkClosure(model, found).diagnostics.empty());
}

TEST(ModelDuplicates, UnusedDuplicatesAreWarnings) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.points.push_back(model.points[3]);
  model.lines.push_back(model.lines[4]);
  std::ranges::reverse(model.lines.back().points);
  const std::vector<Diagnostic> found = diagnoseModel(model);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kDuplicatePoints);
  EXPECT_EQ(found[1].code, DiagnosticCode::kDuplicateLines);
  for (const Diagnostic& twice : found) EXPECT_EQ(twice.severity, Severity::kWarning);
}

TEST(ModelDuplicates, PointsThatDifferByRoundingCoincideAnywhere) {
  for (const Vec3& origin : {Vec3(0.0), Vec3(1e6, -3e5, 2e4)}) {
    Model model = boxModel(origin, origin + Vec3(1.0));
    model.points.push_back(model.points[5]);
    EXPECT_EQ(countOf(diagnoseModel(model), DiagnosticCode::kDuplicatePoints), 1U);
    model.points.back() += Vec3(0, 1e-6, 0);
    EXPECT_EQ(countOf(diagnoseModel(model), DiagnosticCode::kDuplicatePoints), 0U);
  }
}

TEST(ModelDuplicates, CoursesAreComparedNotOnlyEnds) {
  ModelBuilder builder;
  const Vec3 from(0, 0, 0);
  const Vec3 to(1, 0, 0);
  builder.straight(from, to);
  builder.line(LineType::kParabolic, {from, {0.5, 0.2, 0}, to});
  builder.line(LineType::kParabolic, {from, {0.5, -0.2, 0}, to});
  EXPECT_EQ(countOf(diagnoseModel(builder.model), DiagnosticCode::kDuplicateLines), 0U);
  builder.line(LineType::kParabolic, {to, {0.5, 0.2, 0}, from});
  builder.line(LineType::kParabolic, {to, {0.5, 0, 0}, from});
  const std::vector<Diagnostic> found = diagnoseModel(builder.model);
  EXPECT_EQ(countOf(found, DiagnosticCode::kDuplicateLines), 2U);
}

TEST(ModelDuplicates, EachOfManyLinesBetweenTwoPointsFindsItsLowestDuplicate) {
  // A fan of parabolas, and straight lines, in a mixed order; each several times.
  constexpr std::uint32_t kCourses = 97;
  ModelBuilder builder;
  const Vec3 from(0, 0, 0);
  const Vec3 to(3, 1, 0);
  std::vector<LineId> expected;
  std::vector<LineId> first(kCourses);
  for (std::uint32_t i = 0; i < 3 * kCourses; ++i) {
    const std::uint32_t course = i * i % kCourses;
    const double angle = 0.06 * course;
    const Vec3 middle(1.5 - std::sin(angle), 0.5 + std::cos(angle), 0.3 * std::sin(2.0 * angle));
    std::vector<Vec3> positions{from, middle, to};
    if (course == 0) positions = {from, to};
    if (i % 2 == 1) std::ranges::reverse(positions);
    const LineId line(
        builder.line(course == 0 ? LineType::kStraight : LineType::kParabolic, positions));
    first[course] = std::min(first[course], line);
    expected.push_back(first[course]);
  }
  EXPECT_EQ(checkModel(builder.model).duplicates.lines, expected);
}

TEST(ModelDuplicates, ShortLinesOfALargeModelCoincideDespiteRoundedEnds) {
  Model model = boxModel({0, 0, 0}, {1e4, 1e4, 1e4});
  const auto first = static_cast<std::uint32_t>(model.points.size());
  const Vec3 shift(0, 5e-9, 0);
  for (const Vec3& moved : {Vec3(0.0), shift}) {
    model.points.push_back(Vec3(1, 2, 3) + moved);
    model.points.push_back(Vec3(1, 2, 3.01) + moved);
  }
  for (const std::uint32_t point : {first, first + 2})
    model.lines.push_back({LineType::kStraight, {point, point + 1}});
  EXPECT_EQ(countOf(diagnoseModel(model), DiagnosticCode::kDuplicateLines), 1U);
}

}  // namespace
}  // namespace tetrafront::testing
