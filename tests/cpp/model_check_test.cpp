// Every problem of a drawn model, one at a time, and models without problems.

#include "model/check_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "support/models.h"
#include "support/random.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

std::vector<DiagnosticCode> codesOf(const Model& model) {
  std::vector<DiagnosticCode> codes;
  for (const Diagnostic& diagnostic : diagnoseModel(model)) codes.push_back(diagnostic.code);
  return codes;
}

/// Returns the only diagnostic of a model, which must have exactly one.
Diagnostic onlyDefect(const Model& model) {
  const std::vector<Diagnostic> found = diagnoseModel(model);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? Diagnostic{} : found.front();
}

bool names(const Diagnostic& diagnostic, EntityKind kind, std::uint32_t index) {
  return std::ranges::any_of(diagnostic.entities, [&](const Entity& entity) {
    return entity.kind == kind && entity.index == index;
  });
}

Model square() { return polygonModel({squareCorners({0, 0, 0}, 1.0)}); }

Model coonsSquare() {
  Model model = square();
  model.patches.front().type = PatchType::kCoons;
  return model;
}

TEST(ModelCheck, ValidModelsPass) {
  EXPECT_TRUE(codesOf(square()).empty());
  EXPECT_TRUE(codesOf(coonsSquare()).empty());
  EXPECT_TRUE(codesOf(boxModel({0, 0, 0}, {1, 2, 3})).empty());
  EXPECT_TRUE(codesOf(seamedTube(1.0, 3.0)).empty());
  EXPECT_TRUE(codesOf(polygonModel({squareCorners({0, 0, 0}, 3.0), squareCorners({1, 1, 0}, 1.0)}))
                  .empty());
}

TEST(ModelCheck, DiscOfOneClosedSplineAndOfTwoLinesPass) {
  for (const int arcs : {1, 2, 3}) {
    ModelBuilder builder;
    builder.patch(PatchType::kPlanar, {builder.circle({0, 0, 0}, 1.0, arcs)});
    EXPECT_TRUE(codesOf(builder.model).empty()) << arcs;
  }
}

TEST(ModelCheck, RandomModelsPass) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    double area = 0.0;
    EXPECT_TRUE(codesOf(randomPolygonModel(seed, area)).empty()) << seed;
    EXPECT_TRUE(codesOf(randomCoonsModel(seed, 0.15)).empty()) << seed;
  }
}

TEST(ModelCheck, NotFinite) {
  for (const double wrong :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e40}) {
    Model model = square();
    model.points[2].y = wrong;
    const Diagnostic defect = onlyDefect(model);
    EXPECT_EQ(defect.code, DiagnosticCode::kNotFinite);
    EXPECT_TRUE(names(defect, EntityKind::kPoint, 2));
  }
}

/// The problem is the scale, not the lines whose lengths underflow.
TEST(ModelCheck, AModelTooSmallToComputeWithIsReportedOnce) {
  EXPECT_TRUE(diagnoseModel(boxModel(Vec3(0.0), Vec3(1e-30))).empty());
  for (const double scale : {5e-31, 1e-40, 1e-110, 1e-200, 1e-310}) {
    const Model model = boxModel(Vec3(0.0), Vec3(scale));
    const std::vector<Diagnostic> found = diagnoseModel(model);
    ASSERT_EQ(found.size(), 1U) << scale;
    EXPECT_EQ(found[0].code, DiagnosticCode::kNotFinite);
    ASSERT_EQ(found[0].entities.size(), 1U);
    EXPECT_EQ(found[0].entities[0].kind, EntityKind::kPoint);
    EXPECT_EQ(found[0].values, std::vector<double>{scale});
    MeshOptions options;
    options.size = 0.3 * scale;
    EXPECT_EQ(previewModel(model, {}, options).diagnostics.size(), 1U) << scale;
  }
}

TEST(ModelCheck, IndexOutOfRange) {
  Model model = square();
  model.lines[1].points[1] = 77;
  const std::vector<Diagnostic> found = diagnoseModel(model);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().code, DiagnosticCode::kIndexOutOfRange);
  EXPECT_TRUE(names(found.front(), EntityKind::kLine, 1));
  EXPECT_EQ(found.front().values, std::vector<double>{77.0});

  model = square();
  model.patches.front().loops.front()[3].line = 9;
  const Diagnostic defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kIndexOutOfRange);
  EXPECT_TRUE(names(defect, EntityKind::kPatch, 0));
}

TEST(ModelCheck, WrongPointCount) {
  Model model = square();
  model.lines[2].type = LineType::kParabolic;
  Diagnostic defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kWrongPointCount);
  EXPECT_TRUE(names(defect, EntityKind::kLine, 2));
  EXPECT_EQ(defect.values, std::vector<double>{2.0});

  model = square();
  model.lines[0].points.clear();
  defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kWrongPointCount);
  EXPECT_EQ(defect.values, std::vector<double>{0.0});
}

TEST(ModelCheck, CoincidentPoints) {
  ModelBuilder builder;
  const std::uint32_t line =
      builder.line(LineType::kSpline, {{0, 0, 0}, {1, 0, 0}, {2, 0, 1}, {3, 0, 0}});
  builder.patch(PatchType::kPlanar, {{{line, false}, builder.straight({3, 0, 0}, {0, 0, 0})}});
  builder.model.points[2] = builder.model.points[1];
  const Diagnostic defect = onlyDefect(builder.model);
  EXPECT_EQ(defect.code, DiagnosticCode::kCoincidentPoints);
  EXPECT_TRUE(names(defect, EntityKind::kLine, line));
  EXPECT_TRUE(names(defect, EntityKind::kPoint, 1));
  EXPECT_TRUE(names(defect, EntityKind::kPoint, 2));
  EXPECT_TRUE(defect.hasPosition);
}

TEST(ModelCheck, ZeroLengthLine) {
  Model model = square();
  model.points[1] = model.points[0];
  const Diagnostic defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kZeroLengthLine);
  EXPECT_TRUE(names(defect, EntityKind::kLine, 0));
}

TEST(ModelCheck, WrongLineCount) {
  Model model = polygonModel({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  model.patches.front().type = PatchType::kCoons;
  Diagnostic defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kWrongLineCount);
  EXPECT_EQ(defect.values, (std::vector<double>{3.0, 4.0}));

  model = square();
  model.patches.front().loops.clear();
  defect = onlyDefect(model);
  EXPECT_EQ(defect.code, DiagnosticCode::kWrongLineCount);
  EXPECT_EQ(defect.values, (std::vector<double>{0.0, 1.0}));
}

TEST(ModelCheck, WrongLineTypeNamesPatchAndLine) {
  Model model = polygonModel({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  model.patches.front().type = PatchType::kIsoparametricTriangle;
  const std::vector<Diagnostic> found = diagnoseModel(model);
  ASSERT_EQ(found.size(), 3U);
  for (std::uint32_t line = 0; line < 3; ++line) {
    EXPECT_EQ(found[line].code, DiagnosticCode::kWrongLineType);
    EXPECT_TRUE(names(found[line], EntityKind::kPatch, 0));
    EXPECT_TRUE(names(found[line], EntityKind::kLine, line));
  }
}

TEST(ModelCheck, LoopNotClosedNamesPatchLineAndPoint) {
  Model model = square();
  model.patches.front().loops.front()[1].reversed = true;
  const std::vector<Diagnostic> found = diagnoseModel(model);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kLoopNotClosed);
  EXPECT_TRUE(names(found[0], EntityKind::kPatch, 0));
  EXPECT_TRUE(names(found[0], EntityKind::kLine, 0));
  EXPECT_TRUE(names(found[0], EntityKind::kPoint, 1));
  EXPECT_TRUE(found[0].hasPosition);
  EXPECT_EQ(found[0].position, model.points[1]);
}

TEST(ModelCheck, OneOpenLineIsNoLoop) {
  ModelBuilder builder;
  builder.patch(PatchType::kPlanar, {{builder.straight({0, 0, 0}, {1, 0, 0})}});
  EXPECT_EQ(onlyDefect(builder.model).code, DiagnosticCode::kLoopNotClosed);
}

TEST(ModelCheck, LoopTouchesItself) {
  // A bow tie with unequal wings; a hole across the edge; a hole that touches it; a line used
  // twice.
  const Model bowTie = polygonModel({{{0, 0, 0}, {3, 1, 0}, {3, 0, 0}, {0, 2, 0}}});
  EXPECT_EQ(onlyDefect(bowTie).code, DiagnosticCode::kLoopsIntersect);
  const Model crossing =
      polygonModel({squareCorners({0, 0, 0}, 2.0), squareCorners({1.5, 0.5, 0}, 1.0)});
  const Diagnostic defect = onlyDefect(crossing);
  EXPECT_EQ(defect.code, DiagnosticCode::kLoopsIntersect);
  EXPECT_TRUE(names(defect, EntityKind::kLine, 1));
  const Model touching =
      polygonModel({squareCorners({0, 0, 0}, 2.0), {{2, 1, 0}, {1, 0.5, 0}, {1, 1.5, 0}}});
  EXPECT_EQ(onlyDefect(touching).code, DiagnosticCode::kLoopsIntersect);
  const Model spike =
      polygonModel({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}}});
  EXPECT_EQ(onlyDefect(spike).code, DiagnosticCode::kLoopsIntersect);
}

TEST(ModelCheck, HoleOutside) {
  const Model beside = polygonModel({squareCorners({0, 0, 0}, 1.0), squareCorners({2, 0, 0}, 1.0)});
  const Diagnostic defect = onlyDefect(beside);
  EXPECT_EQ(defect.code, DiagnosticCode::kHoleOutside);
  EXPECT_TRUE(names(defect, EntityKind::kLine, 4));
  const Model nested = polygonModel({squareCorners({0, 0, 0}, 4.0), squareCorners({1, 1, 0}, 2.0),
                                     squareCorners({1.5, 1.5, 0}, 1.0)});
  EXPECT_EQ(onlyDefect(nested).code, DiagnosticCode::kHoleOutside);
}

TEST(ModelCheck, NotPlanarNamesTheMovedPointAndItsDistance) {
  // A hexagon in a tilted plane with a square hole; each point is moved in turn.
  const Vec3 u(0.6, 0.64, 0.48);
  const Vec3 v(-0.8, 0.48, 0.36);
  const Vec3 normal = glm::cross(u, v);
  const auto at = [&](double x, double y) { return x * u + y * v; };
  const Model flat = polygonModel({{at(0, 0), at(3, -1), at(5, 0), at(5, 3), at(3, 4), at(0, 3)},
                                   {at(2, 1), at(3, 1), at(3, 2), at(2, 2)}});
  ASSERT_TRUE(codesOf(flat).empty());
  for (std::uint32_t point = 0; point < flat.points.size(); ++point) {
    Model model = flat;
    model.points[point] += 0.3 * normal;
    const Diagnostic defect = onlyDefect(model);
    EXPECT_EQ(defect.code, DiagnosticCode::kNotPlanar);
    EXPECT_TRUE(names(defect, EntityKind::kPoint, point));
    EXPECT_EQ(std::ranges::count(defect.entities, EntityKind::kPoint, &Entity::kind), 1);
    EXPECT_TRUE(names(defect, EntityKind::kPatch, 0));
    EXPECT_EQ(std::ranges::count(defect.entities, EntityKind::kLine, &Entity::kind), 2);
    EXPECT_EQ(defect.position, model.points[point]);
    EXPECT_NEAR(defect.values.front(), 0.3, 1e-12);
  }
}

TEST(ModelCheck, NotPlanarNamesTheMovedCornerOfABox) {
  // Each face has only four corners, any of which might be the moved one; the three faces agree on
  // it.
  for (std::uint32_t point = 0; point < 8; ++point) {
    Model model = boxModel({0, 0, 0}, {1, 2, 3});
    model.points[point] += Vec3(0.1, 0.07, -0.05);
    const std::vector<Diagnostic> found = diagnoseModel(model);
    ASSERT_EQ(found.size(), 3U);
    for (const Diagnostic& defect : found) {
      EXPECT_EQ(defect.code, DiagnosticCode::kNotPlanar);
      EXPECT_TRUE(names(defect, EntityKind::kPoint, point));
      EXPECT_EQ(defect.position, model.points[point]);
    }
  }
}

TEST(ModelCheck, NotPlanarNamesThePointOfALargePolygon) {
  // Too many triples of points to try all of them.
  std::vector<Vec3> corners;
  for (int i = 0; i < 5000; ++i)
    corners.emplace_back(std::cos(i * 0.001256), std::sin(i * 0.001256), 0.25);
  corners[1234].z = 0.5;
  const Diagnostic defect = onlyDefect(polygonModel({corners}));
  EXPECT_EQ(defect.code, DiagnosticCode::kNotPlanar);
  EXPECT_TRUE(names(defect, EntityKind::kPoint, 1234));
  EXPECT_EQ(std::ranges::count(defect.entities, EntityKind::kPoint, &Entity::kind), 1);
}

TEST(ModelCheck, NotPlanarNamesNoPointIfAmbiguous) {
  Random random(21);
  std::vector<Vec3> corners;
  for (int i = 0; i < 7; ++i)
    corners.push_back(Vec3(std::cos(0.9 * i), std::sin(0.9 * i), 0.3 * random.unit()));
  const Diagnostic defect = onlyDefect(polygonModel({corners}));
  EXPECT_EQ(defect.code, DiagnosticCode::kNotPlanar);
  EXPECT_EQ(std::ranges::count(defect.entities, EntityKind::kPoint, &Entity::kind), 0);
  EXPECT_EQ(defect.entities.size(), 2U);
  EXPECT_GT(defect.values.front(), 0.0);
}

TEST(ModelCheck, PlanarityDoesNotDependOnTheModelsSize) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    Model model = square();
    model.points[2].z = 2e-5;
    for (Vec3& point : model.points) point *= scale;
    EXPECT_TRUE(codesOf(model).empty()) << scale;
  }
}

TEST(ModelCheck, UnusedPointsDoNotAffectTheTolerance) {
  Model model = square();
  model.points.push_back(Vec3(1e15, 0, 0));
  model.points.push_back(Vec3(-1e15, 0, 0));
  EXPECT_TRUE(codesOf(model).empty());
  const auto far = static_cast<std::uint32_t>(model.points.size() - 2);
  model.lines.push_back({LineType::kStraight, {far, far + 1}});
  EXPECT_TRUE(codesOf(model).empty());
}

TEST(ModelCheck, NotPlanarNamesTheMovedCornersOfManyBoxes) {
  // The three non-planar faces of each box agree on its corner, independent of the other boxes.
  Model model;
  constexpr std::uint32_t kBoxes = 500;
  for (std::uint32_t i = 0; i < kBoxes; ++i) {
    const Model box = boxModel(Vec3(3.0 * i, 0, 0), Vec3(3.0 * i + 1.0, 2, 3));
    const auto points = static_cast<std::uint32_t>(model.points.size());
    const auto lines = static_cast<std::uint32_t>(model.lines.size());
    model.points.insert(model.points.end(), box.points.begin(), box.points.end());
    for (Line line : box.lines) {
      for (std::uint32_t& point : line.points) point += points;
      model.lines.push_back(line);
    }
    for (Patch patch : box.patches) {
      for (Loop& loop : patch.loops)
        for (OrientedLine& walked : loop) walked.line += lines;
      model.patches.push_back(patch);
    }
    model.points[points + i % 8] += Vec3(0.1, 0.07, -0.05);
  }
  const std::vector<Diagnostic> found = diagnoseModel(model);
  ASSERT_EQ(found.size(), std::size_t{3} * kBoxes);
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    const std::uint32_t box = i / 3;
    EXPECT_EQ(found[i].code, DiagnosticCode::kNotPlanar);
    EXPECT_TRUE(names(found[i], EntityKind::kPoint, 8 * box + box % 8)) << box;
  }
}

TEST(ModelCheck, EmptyModel) {
  EXPECT_EQ(onlyDefect(Model{}).code, DiagnosticCode::kEmptyModel);
  Model lines = square();
  lines.patches.clear();
  EXPECT_EQ(onlyDefect(lines).code, DiagnosticCode::kEmptyModel);
}

TEST(ModelCheck, DegeneratePatch) {
  const Model flat = polygonModel({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}});
  EXPECT_EQ(onlyDefect(flat).code, DiagnosticCode::kDegeneratePatch);
  Model bowTie = polygonModel({{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}});
  bowTie.patches.front().type = PatchType::kCoons;
  EXPECT_EQ(onlyDefect(bowTie).code, DiagnosticCode::kDegeneratePatch);
}

TEST(ModelCheck, MidPointNearAnEndFoldsAnIsoparametricPatch) {
  for (const PatchType type : {PatchType::kIsoparametricTriangle, PatchType::kSerendipity}) {
    const std::size_t count = type == PatchType::kSerendipity ? 4 : 3;
    const std::array<Vec3, 4> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    for (const auto& [share, lift] : std::vector<std::pair<double, double>>{{0.5, 0},
                                                                            {0.3, 0},
                                                                            {0.25, 0},
                                                                            {0.24, 0},
                                                                            {0.1, 0},
                                                                            {0.9, 0},
                                                                            {0.1, 0.02},
                                                                            {0.9, 0.02}}) {
      ModelBuilder builder;
      Loop loop;
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3& from = corners[i];
        const Vec3& to = corners[(i + 1) % count];
        const double at = i == 1 ? share : 0.5;
        const Vec3 middle = from + at * (to - from) + Vec3(i == 1 ? lift : 0.0, 0, 0);
        loop.push_back({builder.line(LineType::kParabolic, {from, middle, to}), false});
      }
      builder.patch(type, {loop});
      if (share >= 0.25 && share <= 0.75) {
        EXPECT_TRUE(codesOf(builder.model).empty()) << share;
        continue;
      }
      const Diagnostic defect = onlyDefect(builder.model);
      // The line itself runs back along its chord.
      EXPECT_EQ(defect.code, lift == 0.0 ? DiagnosticCode::kLineSelfIntersection
                                         : DiagnosticCode::kDegeneratePatch);
      EXPECT_TRUE(names(defect, EntityKind::kLine, 1));
      EXPECT_EQ(defect.entities.size(), lift == 0.0 ? 1U : 2U);
      EXPECT_LT(glm::length(defect.position - corners[share < 0.5 ? 1 : 2]), 0.6) << share;
    }
  }
}

TEST(ModelCheck, TrianglesHaveThreeCorners) {
  ModelBuilder builder;
  const Loop base = builder.circle({0, 0, 0}, 1.0, 1);
  const OrientedLine seam = builder.straight({1, 0, 0}, {0, 0, 1.5});
  builder.patch(PatchType::kBarnhillGregoryNielson, {{base[0], seam, {seam.line, true}}});
  EXPECT_EQ(onlyDefect(builder.model).code, DiagnosticCode::kLoopsIntersect);
}

TEST(ModelCheck, SharpBendOfACoonsPatchIsNoFold) {
  // A thin wing: the chordwise lines bend by nearly 180 degrees at the nose.
  ModelBuilder builder;
  const auto profile = [](double z) {
    return std::vector<Vec3>{{1, -0.02, z},   {0.5, -0.05, z}, {0.02, -0.02, z}, {0, 0, z},
                             {0.02, 0.02, z}, {0.5, 0.05, z},  {1, 0.02, z}};
  };
  const std::uint32_t root = builder.line(LineType::kSpline, profile(0));
  const std::uint32_t tip = builder.line(LineType::kSpline, profile(2));
  builder.patch(PatchType::kCoons, {{{root, false},
                                     builder.straight({1, 0.02, 0}, {1, 0.02, 2}),
                                     {tip, true},
                                     builder.straight({1, -0.02, 2}, {1, -0.02, 0})}});
  EXPECT_TRUE(codesOf(builder.model).empty());
}

TEST(ModelCheck, MisusedSeams) {
  Model tube = seamedTube(1.0, 2.0);
  tube.patches.front().loops.front()[3] = tube.patches.front().loops.front()[1];
  EXPECT_FALSE(codesOf(tube).empty());
  Model slit = square();
  slit.patches.front().loops.front() = {{0, false}, {0, true}};
  EXPECT_FALSE(codesOf(slit).empty());
}

TEST(ModelCheck, ReportsAllProblemsAtOnce) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  model.points[3].x = std::numeric_limits<double>::quiet_NaN();
  model.lines[0].type = LineType::kSpline;
  model.patches[5].type = PatchType::kSerendipity;
  const std::vector<DiagnosticCode> codes = codesOf(model);
  for (const DiagnosticCode code : {DiagnosticCode::kNotFinite, DiagnosticCode::kWrongPointCount,
                                    DiagnosticCode::kWrongLineType})
    EXPECT_NE(std::ranges::find(codes, code), codes.end()) << static_cast<int>(code);
}

TEST(ModelCheck, SurvivesRandomDamage) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    Model model = seed % 2 == 0 ? boxModel({0, 0, 0}, {1, 2, 3}) : randomCoonsModel(seed, 0.2);
    for (int damage = random.integer(1, 4); damage > 0; --damage) {
      Line& line = model.lines[random.bits() % model.lines.size()];
      Patch& patch = model.patches[random.bits() % model.patches.size()];
      switch (random.integer(0, 7)) {
        case 0:
          model.points[random.bits() % model.points.size()] *= random.coin() ? 1e300 : 0.0;
          break;
        case 1:
          line.points.resize(random.bits() % 6, 4000000000U);
          break;
        case 2:
          line.type = static_cast<LineType>(random.integer(0, 2));
          break;
        case 3:
          patch.type = static_cast<PatchType>(random.integer(0, 4));
          break;
        case 4:
          patch.loops.resize(random.bits() % 3);
          break;
        case 5:
          if (!patch.loops.empty())
            patch.loops[0].push_back(
                {static_cast<std::uint32_t>(random.bits() % 20), random.coin()});
          break;
        case 6:
          if (!patch.loops.empty() && !patch.loops[0].empty())
            patch.loops[0][0].reversed = random.coin();
          break;
        default:
          if (!line.points.empty()) line.points[0] = static_cast<std::uint32_t>(random.bits() % 12);
          break;
      }
    }
    const CheckedModel found = checkModel(model);
    EXPECT_EQ(found.usableLines.size(), model.lines.size());
    EXPECT_EQ(found.usablePatches.size(), model.patches.size());
  }
}

}  // namespace
}  // namespace tetrafront::testing
