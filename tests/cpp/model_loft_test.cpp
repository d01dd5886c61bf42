// Lofts: they follow their sections and sides with continuous curvature, and reproduce sums of two splines.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "model/check_model.h"
#include "model/patch_surface.h"
#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

struct Grid {
  Model model;
  std::vector<std::vector<Vec3>> points;
};

/// A loft through a grid of points: rows as sections, columns as sides, all splines.
Grid gridLoft(int rows, int columns, const std::function<Vec3(int, int)>& at) {
  Grid grid;
  ModelBuilder builder;
  std::vector<std::uint32_t> lines;
  std::array<std::vector<Vec3>, 2> sides;
  for (int j = 0; j < rows; ++j) {
    std::vector<Vec3>& row = grid.points.emplace_back();
    for (int i = 0; i < columns; ++i) row.push_back(at(i, j));
    lines.push_back(builder.line(LineType::kSpline, row));
    sides[0].push_back(row.front());
    sides[1].push_back(row.back());
  }
  const std::uint32_t left = builder.line(LineType::kSpline, sides[0]);
  const std::uint32_t right = builder.line(LineType::kSpline, sides[1]);
  builder.patch(PatchType::kLoft,
                {{{lines.front(), false}, {right, false}, {lines.back(), true}, {left, true}}});
  for (int j = 1; j + 1 < rows; ++j)
    builder.model.patches[0].sections.push_back({lines[static_cast<std::size_t>(j)], false});
  grid.model = builder.model;
  return grid;
}

TEST(ModelLoft, FollowsItsSectionsAndSides) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Grid grid =
        gridLoft(5, 4, [&](int i, int j) { return Vec3(i, j, 0) + random.inBox(0.3); });
    EXPECT_TRUE(diagnoseModel(grid.model).empty());
    const ResolvedModel resolved(grid.model);
    const UnitSurface surface = unitSurface(resolved, grid.model.patches[0]);
    const Loop& loop = grid.model.patches[0].loops[0];
    const OrientedCurve left = resolved.curve(loop[3]).reverse();
    const OrientedCurve right = resolved.curve(loop[1]);
    for (std::size_t j = 1; j + 1 < grid.points.size(); ++j) {
      const OrientedCurve section = resolved.curve(grid.model.patches[0].sections[j - 1]);
      for (int step = 0; step <= 16; ++step) {
        const double u = step / 16.0;
        const double v = (1.0 - u) * left.knot(j) + u * right.knot(j);
        EXPECT_LT(glm::length(surface.evaluate({u, v}).position - section.position(u)), 1e-12);
      }
    }
    for (int step = 0; step <= 16; ++step) {
      const double v = step / 16.0;
      EXPECT_LT(glm::length(surface.evaluate({0, v}).position - left.position(v)), 1e-12);
      EXPECT_LT(glm::length(surface.evaluate({1, v}).position - right.position(v)), 1e-12);
    }
  }
}

TEST(ModelLoft, TangentsAreTheLimitOfDifferencesAndCurvatureIsContinuous) {
  constexpr double kStep = 1e-5;
  Random random(3);
  const Grid grid = gridLoft(6, 5, [&](int i, int j) { return Vec3(i, j, 0) + random.inBox(0.3); });
  const ResolvedModel resolved(grid.model);
  const UnitSurface surface = unitSurface(resolved, grid.model.patches[0]);
  const OrientedCurve left = resolved.curve(grid.model.patches[0].loops[0][3]).reverse();
  const OrientedCurve right = resolved.curve(grid.model.patches[0].loops[0][1]);
  for (int i = 0; i < 50; ++i) {
    const Vec2 unit(random.between(0.05, 0.95), random.between(0.05, 0.95));
    const SurfacePoint point = surface.evaluate(unit);
    const auto difference = [&](const Vec2& step) {
      return (surface.evaluate(unit + step).position - surface.evaluate(unit - step).position) /
             (2.0 * kStep);
    };
    EXPECT_LT(glm::length(point.alongXi - difference({kStep, 0})), 1e-6);
    EXPECT_LT(glm::length(point.alongEta - difference({0, kStep})), 1e-6);
    // Second derivatives across a section, from either side.
    const std::size_t j = 1 + static_cast<std::size_t>(i % 4);
    const double v = (1.0 - unit.x) * left.knot(j) + unit.x * right.knot(j);
    const auto second = [&](double side, bool byXi) {
      const SurfacePoint here = surface.evaluate({unit.x, v});
      const SurfacePoint there = surface.evaluate({unit.x, v + side});
      return byXi ? (there.alongXi - here.alongXi) / side : (there.alongEta - here.alongEta) / side;
    };
    for (const bool byXi : {false, true})
      EXPECT_LT(glm::length(second(kStep, byXi) - second(-kStep, byXi)), 0.05);
  }
}

TEST(ModelLoft, ThroughTranslatedRowsIsTheSumOfTwoSplines) {
  // Then all rows have the same knots, and the surface is that of bicubic pieces: one spline plus another.
  Random random(4);
  std::vector<Vec3> row{Vec3(0.0)};
  std::vector<Vec3> column{Vec3(0.0)};
  for (int i = 1; i < 6; ++i) row.push_back(Vec3(i, 0, 0) + random.inBox(0.4));
  for (int j = 1; j < 5; ++j) column.push_back(Vec3(0, j, 0) + random.inBox(0.4));
  const Grid grid = gridLoft(5, 6, [&](int i, int j) {
    return row[static_cast<std::size_t>(i)] + column[static_cast<std::size_t>(j)];
  });
  const ResolvedModel resolved(grid.model);
  const UnitSurface surface = unitSurface(resolved, grid.model.patches[0]);
  const Curve along(LineType::kSpline, row);
  const Curve up(LineType::kSpline, column);
  for (int i = 0; i < 100; ++i) {
    const Vec2 unit(random.unit(), random.unit());
    EXPECT_LT(glm::length(surface.evaluate(unit).position -
                          (along.position(unit.x) + up.position(unit.y))),
              1e-12);
  }
}

TEST(ModelLoft, WithoutSectionsIsTheCoonsPatch) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Model coons = randomCoonsModel(seed, kTypicalBend);
    Model loft = coons;
    loft.patches[0].type = PatchType::kLoft;
    const ResolvedModel resolved(coons);
    const UnitSurface expected = unitSurface(resolved, coons.patches[0]);
    const UnitSurface surface = unitSurface(resolved, loft.patches[0]);
    Random random(seed);
    for (int i = 0; i < 5; ++i) {
      const Vec2 unit(random.unit(), random.unit());
      EXPECT_LT(glm::length(surface.evaluate(unit).position - expected.evaluate(unit).position),
                1e-13);
    }
  }
}

TEST(ModelLoft, SectionsThatDoNotRunBetweenTheSidesAreNamed) {
  const auto codes = [](const Model& model) {
    std::vector<DiagnosticCode> result;
    for (const Diagnostic& diagnostic : diagnoseModel(model))
      if (diagnostic.code == DiagnosticCode::kMisplacedSection) result.push_back(diagnostic.code);
    return result;
  };
  const std::vector expected{DiagnosticCode::kMisplacedSection};
  Model model = gridLoft(5, 4, [](int i, int j) { return Vec3(i, j, i * j * 0.1); }).model;
  EXPECT_TRUE(codes(model).empty());
  Model swapped = model;
  std::swap(swapped.patches[0].sections[0], swapped.patches[0].sections[1]);
  EXPECT_EQ(codes(swapped), expected);
  Model reversed = model;
  reversed.patches[0].sections[0].reversed = true;
  EXPECT_EQ(codes(reversed), expected);
  Model border = model;
  border.patches[0].sections[0] = border.patches[0].loops[0][0];
  EXPECT_EQ(codes(border), expected);
  Model missing = model;
  missing.patches[0].sections[0].line = 1000;
  EXPECT_EQ(diagnoseModel(missing).front().code, DiagnosticCode::kIndexOutOfRange);
}

}  // namespace
}  // namespace tetrafront::testing
