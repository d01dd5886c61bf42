// Arcs and circles: nodes lie on the circle, at equal angles, in the given direction.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "field/size_field.h"
#include "model/check_model.h"
#include "model/curve.h"
#include "model/patch_surface.h"
#include "support/models.h"
#include "support/random.h"
#include "surface/line_mesher.h"

namespace tetrafront::testing {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// A circle in a random plane, with the library's functions.
struct Circle {
  Vec3 centre{0.0};
  double radius = 1.0;
  Vec3 u{1.0, 0.0, 0.0};
  Vec3 v{0.0, 1.0, 0.0};

  [[nodiscard]] Vec3 at(double angle) const {
    return centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
  }
};

Circle randomCircle(Random& random) {
  Circle circle;
  circle.centre = random.inBox(2.0);
  circle.radius = std::exp2(random.between(-3.0, 3.0));
  circle.u = glm::normalize(random.inBox(1.0) + Vec3(0.0, 0.0, 1.5));
  circle.v = glm::normalize(glm::cross(circle.u, Vec3(1.0, 0.3, 0.1)));
  return circle;
}

TEST(ModelArc, PositionsAreOnTheCircleAtEqualAngles) {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Circle circle = randomCircle(random);
    const double start = random.between(0.0, kFullTurn);
    const double angle = random.between(0.3, 6.0);
    const double middle = start + random.between(0.2, 0.8) * angle;
    const Curve arc(LineType::kArc,
                    {circle.at(start), circle.at(middle), circle.at(start + angle)});
    const double tolerance = 2e-14 * (circle.radius + glm::length(circle.centre));
    EXPECT_NEAR(arc.length(), angle * circle.radius, 20.0 * tolerance);
    for (double t = 0.0; t <= 1.0; t += 0.0625)
      ASSERT_LT(glm::length(arc.position(t) - circle.at(start + t * angle)), 20.0 * tolerance)
          << round << ' ' << t;
  }
}

TEST(ModelArc, PositionsOfACircleKeepTheirDistanceFromItsCentreTo1e15) {
  // Points with exact coordinates, so that the centre and the radius are known exactly.
  for (const Vec3& centre : {Vec3(0.0), Vec3(0.5, -0.25, 1.0)}) {
    const Vec3 a = centre + Vec3(3, 4, 0);
    const Vec3 b = centre + Vec3(-5, 0, 0);
    const Vec3 c = centre + Vec3(0, -5, 0);
    const Curve circle(LineType::kCircle, {a, b, c, a});
    EXPECT_NEAR(circle.length(), kFullTurn * 5.0, 1e-14);
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 position = circle.position(i / 1000.0);
      ASSERT_NEAR(glm::length(position - centre) / 5.0, 1.0, 1e-15) << i;
      ASSERT_EQ(position.z, centre.z);
    }
  }
}

TEST(ModelArc, ACircleBeginsAndEndsAtItsFirstPointWithoutAKink) {
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    const Circle circle = randomCircle(random);
    const Vec3 start = circle.at(0.3);
    const Curve curve(LineType::kCircle, {start, circle.at(2.0), circle.at(4.0), start});
    EXPECT_TRUE(curve.isClosed());
    EXPECT_EQ(curve.position(0.0), start);
    EXPECT_EQ(curve.position(1.0), start);
    EXPECT_LT(glm::length(curve.derivative(0.0) - curve.derivative(1.0)), 1e-14 * curve.length());
    // It passes its second point before its third.
    EXPECT_LT(glm::length(curve.position(1.7 / kFullTurn) - circle.at(2.0)),
              1e-12 * curve.length());
  }
}

TEST(ModelArc, TheDirectionIsThatOfTheThreePoints) {
  const Curve anticlockwise(LineType::kArc, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
  const Curve clockwise(LineType::kArc, {{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}});
  EXPECT_GT(anticlockwise.position(0.3).y, 0.5);
  EXPECT_LT(clockwise.position(0.3).y, -0.5);
  const Curve long_(LineType::kArc, {{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}});
  EXPECT_NEAR(long_.length(), 0.75 * kFullTurn, 1e-14);
}

TEST(ModelArc, AnArcOfAHugeCircleIsAsExactAsItsChord) {
  constexpr double kSag = 1e-7;
  const Curve arc(LineType::kArc, {{-1, 0, 0}, {0, kSag, 0}, {1, 0, 0}});
  for (double t = 0.0; t <= 1.0; t += 0.125) {
    const double x = 2.0 * t - 1.0;
    ASSERT_NEAR(arc.position(t).x, x, 1e-14);
    ASSERT_NEAR(arc.position(t).y, kSag * (1.0 - x * x), 1e-14);
  }
}

TEST(ModelArc, ReversingALineMovesNoNode) {
  for (const bool isCircle : {false, true}) {
    Model model;
    model.points = {{1, 0.1, 0}, {0.3, 1, 0.2}, {-1, 0, 0.4}};
    model.lines = {
        isCircle ? Line{LineType::kCircle, {0, 1, 2, 0}} : Line{LineType::kArc, {0, 1, 2}},
        isCircle ? Line{LineType::kCircle, {0, 2, 1, 0}} : Line{LineType::kArc, {2, 1, 0}}};
    const ResolvedModel resolved(model);
    const OrientedCurve forward = resolved.curve(OrientedLine{0, false});
    const OrientedCurve backward = resolved.curve(OrientedLine{1, true});
    for (double t = 0.0; t <= 1.0; t += 0.0625)
      EXPECT_EQ(forward.position(t), backward.position(t));
  }
}

TEST(ModelArc, SidesHaveEqualLength) {
  const Vec3 start(2, 0, 0);
  const Curve circle(LineType::kCircle, {start, {0, 2, 0}, {-2, 0, 0}, start});
  const LineDivision division = divideLine(circle, SizeField::uniform(0.3), 6);
  ASSERT_EQ(division.sideCount(), 42U);
  const double side = 4.0 * std::sin(kFullTurn / 2.0 / 42.0);
  for (std::size_t i = 0; i < 42; ++i)
    ASSERT_NEAR(glm::length(division.nodes[i + 1] - division.nodes[i]), side, 1e-12);
}

std::vector<DiagnosticCode> problemsOf(const Model& model) {
  std::vector<DiagnosticCode> codes;
  for (const Diagnostic& diagnostic : diagnoseModel(model)) codes.push_back(diagnostic.code);
  return codes;
}

Model discOf(Line line, std::vector<Vec3> points) {
  Model model;
  model.points = std::move(points);
  const std::uint32_t last = line.points.back();
  const std::uint32_t first = line.points.front();
  model.lines.push_back(std::move(line));
  Loop loop{{0, false}};
  if (first != last) {
    model.lines.push_back({LineType::kStraight, {last, first}});
    loop.push_back({1, false});
  }
  model.patches.push_back({PatchType::kPlanar, {loop}});
  return model;
}

TEST(ModelArc, DiscsOfCirclesAndArcsAreValid) {
  const std::vector<Vec3> points{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  EXPECT_TRUE(problemsOf(discOf({LineType::kCircle, {0, 1, 2, 0}}, points)).empty());
  EXPECT_TRUE(problemsOf(discOf({LineType::kArc, {0, 1, 2}}, points)).empty());
}

TEST(ModelArc, CollinearPointsAreReportedWithTheLine) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
  for (const Line& line :
       {Line{LineType::kArc, {0, 1, 2}}, Line{LineType::kCircle, {0, 1, 2, 0}}}) {
    const std::vector<Diagnostic> found = diagnoseModel(discOf(line, points));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().code, DiagnosticCode::kCollinearPoints);
    ASSERT_EQ(found.front().entities.size(), 1U);
    EXPECT_EQ(found.front().entities.front().kind, EntityKind::kLine);
    EXPECT_EQ(found.front().position, Vec3(1, 1, 1));
  }
}

TEST(ModelArc, CoincidentPointsAreReported) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  for (const Line& line : {Line{LineType::kArc, {0, 1, 2}}, Line{LineType::kCircle, {0, 1, 2, 0}}})
    EXPECT_EQ(problemsOf(discOf(line, points)).front(), DiagnosticCode::kCoincidentPoints);
  EXPECT_EQ(problemsOf(discOf({LineType::kArc, {0, 1, 0}}, points)).front(),
            DiagnosticCode::kCoincidentPoints);
}

TEST(ModelArc, ACircleMustEndAtItsFirstPoint) {
  const std::vector<Vec3> points{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_EQ(problemsOf(discOf({LineType::kCircle, {0, 1, 2, 3}}, points)),
            std::vector{DiagnosticCode::kOpenCircle});
  EXPECT_EQ(problemsOf(discOf({LineType::kCircle, {0, 1, 2}}, points)).front(),
            DiagnosticCode::kWrongPointCount);
  EXPECT_EQ(problemsOf(discOf({LineType::kArc, {0, 1, 2, 3}}, points)).front(),
            DiagnosticCode::kWrongPointCount);
}

TEST(ModelArc, AnArcThatLeavesThePlaneOfItsPatchIsReported) {
  Model model =
      discOf({LineType::kArc, {0, 1, 2}}, {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0.5}});
  model.lines[1] = {LineType::kArc, {2, 3, 0}};
  EXPECT_EQ(problemsOf(model), std::vector{DiagnosticCode::kNotPlanar});
}

TEST(ModelArc, CrossingArcsOfALoopAreReported) {
  // The second arc bulges over the first.
  Model model =
      discOf({LineType::kArc, {0, 1, 2}}, {{1, 0, 0}, {0, 0.5, 0}, {-1, 0, 0}, {0.2, 0.55, 0}});
  model.lines[1] = {LineType::kSpline, {2, 3, 1, 0}};
  const std::vector<DiagnosticCode> codes = problemsOf(model);
  EXPECT_TRUE(std::ranges::find(codes, DiagnosticCode::kLoopsIntersect) != codes.end());
}

}  // namespace
}  // namespace tetrafront::testing
