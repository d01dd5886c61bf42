// The sides of lines (Löhner & Parikh 1988, section 5.1): their lengths compared with the size field.

#include "surface/line_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

SizeField gridField(const Vec3& low, const Vec3& high, auto&& sizeAt) {
  return SizeField::fromGrid(GridLocator(boxGrid(low, high, sizeAt)));
}

/// Per side: length / target size at its middle.
std::vector<double> ratios(const LineDivision& division, const SizeField& field) {
  std::vector<double> found;
  FieldHint hint;
  for (std::size_t i = 0; i + 1 < division.nodes.size(); ++i) {
    const Vec3& a = division.nodes[i];
    const Vec3& b = division.nodes[i + 1];
    found.push_back(glm::length(b - a) / field.sizeAt(0.5 * (a + b), hint));
  }
  return found;
}

void expectWellFormed(const LineDivision& division, const Curve& curve) {
  ASSERT_EQ(division.status, LineDivisionStatus::kDivided);
  ASSERT_EQ(division.nodes.size(), division.parameters.size());
  EXPECT_EQ(division.nodes.front(), curve.start());
  EXPECT_EQ(division.nodes.back(), curve.end());
  for (std::size_t i = 0; i + 1 < division.parameters.size(); ++i)
    EXPECT_LT(division.parameters[i], division.parameters[i + 1]);
}

TEST(SurfaceLineMesher, StraightLineOfUniformSizeIsDividedIntoEqualSides) {
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {10, 0, 0}});
  for (const double size : {0.3, 1.0, 2.6, 7.0, 30.0}) {
    const LineDivision division = divideLine(curve, SizeField::uniform(size), 1);
    expectWellFormed(division, curve);
    EXPECT_EQ(division.sideCount(), std::max(1U, static_cast<std::uint32_t>(10.0 / size + 0.5)));
    for (const double ratio : ratios(division, SizeField::uniform(size)))
      EXPECT_NEAR(ratio * size, 10.0 / static_cast<double>(division.sideCount()), 1e-9);
  }
}

TEST(SurfaceLineMesher, HasAtLeastTheGivenNumberOfSides) {
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(divideLine(curve, SizeField::uniform(50.0), 1).sideCount(), 1U);
  EXPECT_EQ(divideLine(curve, SizeField::uniform(50.0), 3).sideCount(), 3U);
}

TEST(SurfaceLineMesher, SidesFollowAGradedField) {
  // Lines of all types across a box in which the size grows tenfold.
  const Vec3 low(-3, -3, -3);
  const Vec3 high(9, 3, 3);
  const SizeField field = gridField(low, high, [](const Vec3& p) { return p.x < 0 ? 0.05 : 0.5; });
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const int count = random.integer(2, 8);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i)
      points.push_back(Vec3(6.0 * i / (count - 1), 0, 0) + random.inBox(0.25));
    const LineType type = count == 2   ? LineType::kStraight
                          : count == 3 ? LineType::kParabolic
                                       : LineType::kSpline;
    const Curve curve(type, points);
    const LineDivision division = divideLine(curve, field, 1);
    expectWellFormed(division, curve);
    const std::vector<double> found = ratios(division, field);
    const auto [smallest, largest] = std::ranges::minmax(found);
    EXPECT_GT(smallest, 0.5) << "seed " << seed;
    EXPECT_LT(largest, 1.5) << "seed " << seed;
    double mean = 0.0;
    for (const double ratio : found) mean += ratio / static_cast<double>(found.size());
    EXPECT_NEAR(mean, 1.0, 0.05) << "seed " << seed;
  }
}

TEST(SurfaceLineMesher, SidesFollowASteepField) {
  // The size is 1 at one end and 1/1000 at the other, ten units away.
  const SizeField field =
      gridField({-1, -1, -1}, {11, 1, 1}, [](const Vec3& p) { return p.x < 0 ? 1e-3 : 1.0; });
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {10, 0, 0}});
  const LineDivision division = divideLine(curve, field, 1);
  expectWellFormed(division, curve);
  const std::vector<double> found = ratios(division, field);
  const auto [smallest, largest] = std::ranges::minmax(found);
  EXPECT_GT(smallest, 0.75);
  EXPECT_LT(largest, 1.25);
  // The integral of dx / h: ln(h1/h0) / slope.
  const double slope = (1.0 - 1e-3) / 12.0;
  const double expected = std::log((1e-3 + 11 * slope) / (1e-3 + slope)) / slope;
  EXPECT_NEAR(static_cast<double>(division.sideCount()), expected, 1.0);
}

TEST(SurfaceLineMesher, FindsASmallSizeInTheMiddleOfALine) {
  // A grid whose size falls from 5 to 0.1 and rises again: a cross-section of a wake.
  BackgroundGrid grid =
      boxGrid({-1, -1, -1}, {5, 1, 1}, [](const Vec3& p) { return p.x < 0 ? 5.0 : 0.1; });
  const BackgroundGrid right =
      boxGrid({5, -1, -1}, {11, 1, 1}, [](const Vec3& p) { return p.x > 10 ? 5.0 : 0.1; });
  for (const auto& tet : right.tetrahedra)
    grid.tetrahedra.push_back({tet[0] + 8, tet[1] + 8, tet[2] + 8, tet[3] + 8});
  grid.nodes.insert(grid.nodes.end(), right.nodes.begin(), right.nodes.end());
  const SizeField field = SizeField::fromGrid(GridLocator(grid));
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {10, 0, 0}});
  const LineDivision division = divideLine(curve, field, 1);
  expectWellFormed(division, curve);
  const auto [smallest, largest] = std::ranges::minmax(ratios(division, field));
  EXPECT_GT(smallest, 0.5);
  EXPECT_LT(largest, 1.5);
}

TEST(SurfaceLineMesher, ClosedSplineIsDividedAlongItsWholeLength) {
  ModelBuilder builder;
  const Loop loop = builder.circle({0, 0, 0}, 1.0, 1);
  const Curve curve(LineType::kSpline, [&] {
    std::vector<Vec3> points;
    for (const std::uint32_t point : builder.model.lines[loop[0].line].points)
      points.push_back(builder.model.points[point]);
    return points;
  }());
  const LineDivision division = divideLine(curve, SizeField::uniform(0.1), 3);
  expectWellFormed(division, curve);
  EXPECT_EQ(division.nodes.front(), division.nodes.back());
  EXPECT_NEAR(static_cast<double>(division.sideCount()), 20.0 * std::numbers::pi, 1.0);
}

TEST(SurfaceLineMesher, ReportsWhereALineLeavesTheGrid) {
  const SizeField field = gridField({0, 0, 0}, {1, 1, 1}, [](const Vec3&) { return 0.1; });
  const Curve curve(LineType::kStraight, {{0.5, 0.5, 0.5}, {0.5, 0.5, 1.5}});
  const LineDivision division = divideLine(curve, field, 1);
  EXPECT_EQ(division.status, LineDivisionStatus::kOutsideGrid);
  EXPECT_GT(division.position.z, 1.0);
  EXPECT_LT(division.position.z, 1.2);
}

TEST(SurfaceLineMesher, RejectsAnAbsurdSize) {
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {1, 0, 0}});
  const LineDivision division = divideLine(curve, SizeField::uniform(1e-9), 1);
  EXPECT_EQ(division.status, LineDivisionStatus::kTooManySides);
  EXPECT_NEAR(division.requiredSides, 1e9, 1e5);
  EXPECT_LT(division.position.x, 1e-4) << "without walking a million sides";
}

TEST(SurfaceLineMesher, LongWalksContinueThroughASmallSizeAtOnePosition) {
  // The size is tiny at one position and grows from there, so few additional sides are needed.
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {1, 0, 0}});
  SizeField field = SizeField::uniform(1.0 / 30000.0);
  field.addSources(
      std::vector{SizeSource{.points = {Vec3(0.75, 0, 0), Vec3(0.0), Vec3(0.0)}, .size = 1e-13}});
  const LineDivision division = divideLine(curve, field, 1);
  EXPECT_EQ(division.status, LineDivisionStatus::kDivided);
  EXPECT_GT(division.sideCount(), 30000U);
}

TEST(SurfaceLineMesher, RejectsASizeBelowTheResolutionOfTheParameter) {
  // From both ends, sizes fall towards a node in the middle of the line.
  constexpr double kTiny = 1e-17;
  BackgroundGrid grid =
      boxGrid({0, -1, -1}, {1, 1, 1}, [](const Vec3& p) { return p.x > 0.5 ? kTiny : 0.3; });
  const BackgroundGrid right =
      boxGrid({1, -1, -1}, {2, 1, 1}, [](const Vec3& p) { return p.x < 1.5 ? kTiny : 0.3; });
  for (const auto& tet : right.tetrahedra)
    grid.tetrahedra.push_back({tet[0] + 8, tet[1] + 8, tet[2] + 8, tet[3] + 8});
  grid.nodes.insert(grid.nodes.end(), right.nodes.begin(), right.nodes.end());
  const Curve curve(LineType::kStraight, {{0, 0, 0}, {2, 0, 0}});
  const LineDivision division = divideLine(curve, SizeField::fromGrid(GridLocator(grid)), 1);
  ASSERT_EQ(division.status, LineDivisionStatus::kTooManySides);
  EXPECT_NEAR(division.position.x, 1.0, 1e-9);
  EXPECT_GE(division.requiredSides, kMaxSidesPerLine);
  EXPECT_TRUE(std::isfinite(division.requiredSides));
}

TEST(SurfaceLineMesher, HalvedSideHasItsNodeInTheMiddle) {
  const Curve curve(LineType::kParabolic, {{0, 0, 0}, {0.2, 1, 0}, {2, 0, 0}});
  LineDivision division = divideLine(curve, SizeField::uniform(0.7), 1);
  const std::vector<double> before = division.parameters;
  halveSide(curve, 1, division);
  ASSERT_EQ(division.parameters.size(), before.size() + 1);
  EXPECT_EQ(division.parameters[1], before[1]);
  EXPECT_EQ(division.parameters[3], before[2]);
  const double middle = division.parameters[2];
  EXPECT_NEAR(curve.length(before[1], middle), curve.length(middle, before[2]), 1e-5);
  EXPECT_EQ(division.nodes[2], curve.position(middle));
}

}  // namespace
}  // namespace tetrafront::testing
