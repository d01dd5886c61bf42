// Lines as curves: they pass through their points, their derivative is the limit of differences,
// and known shapes have their known length.

#include "model/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

std::vector<Vec3> randomPoints(Random& random, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(Vec3(i, 0, 0) + random.inBox(0.8));
  return points;
}

std::vector<Curve> randomCurves(std::uint64_t seed) {
  Random random(seed);
  std::vector<Curve> curves;
  curves.emplace_back(LineType::kStraight, randomPoints(random, 2));
  curves.emplace_back(LineType::kParabolic, randomPoints(random, 3));
  for (int count = 3; count < 9; ++count)
    curves.emplace_back(LineType::kSpline, randomPoints(random, count));
  for (int count = 2; count < 6; ++count) {
    curves.emplace_back(LineType::kHermite, randomPoints(random, count));
    EndTangents tangents;
    if (random.coin()) tangents.start = glm::normalize(random.inBox());
    if (random.coin()) tangents.end = glm::normalize(random.inBox());
    curves.emplace_back(LineType::kHermite, randomPoints(random, count), tangents);
    if (count > 2) curves.emplace_back(LineType::kSpline, randomPoints(random, count), tangents);
  }
  curves.emplace_back(LineType::kArc, randomPoints(random, 3));
  std::vector<Vec3> circle = randomPoints(random, 3);
  circle.push_back(circle.front());
  curves.emplace_back(LineType::kCircle, std::move(circle));
  return curves;
}

TEST(ModelCurve, EndsAreTheGivenPointsBitForBit) {
  Random random(1);
  for (int count = 3; count < 30; ++count) {
    const std::vector<Vec3> points = randomPoints(random, count);
    const Curve curve(LineType::kSpline, points);
    EXPECT_EQ(curve.position(0.0), points.front());
    EXPECT_EQ(curve.position(1.0), points.back());
  }
}

TEST(ModelCurve, SplinePassesEveryPointAtItsKnot) {
  Random random(2);
  const std::vector<Vec3> points = randomPoints(random, 12);
  const Curve curve(LineType::kSpline, points);
  ASSERT_EQ(curve.knots().size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(glm::length(curve.position(curve.knots()[i]) - points[i]), 1e-13);
}

TEST(ModelCurve, SplineThroughThreePointsIsTheNaturalOne) {
  // With knots 0, 1/2, 1 and the heights 0, 1, 0, the equation at the middle gives -12 as the only second derivative:
  // the height is 3t - 4t^3 up to the middle, and the same backwards after it.
  const double side = 3.0;
  const Curve curve(LineType::kSpline, {{-side, 0, 0}, {0, 1, 0}, {side, 0, 0}});
  for (int i = 0; i <= 32; ++i) {
    const double t = i / 32.0;
    const double toEnd = std::min(t, 1.0 - t);
    const Vec3 expected(side * (2.0 * t - 1.0), 3.0 * toEnd - 4.0 * toEnd * toEnd * toEnd, 0.0);
    EXPECT_LT(glm::length(curve.position(t) - expected), 1e-14) << t;
  }
}

TEST(ModelCurve, SecondDerivativesAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const Curve& curve : randomCurves(seed)) {
      SCOPED_TRACE(static_cast<int>(curve.type()));
      for (const double t : {0.013, 0.27, 0.511, 0.87}) {
        const Vec3 difference =
            (curve.derivative(t + kStep) - curve.derivative(t - kStep)) / (2.0 * kStep);
        EXPECT_LT(glm::length(curve.secondDerivative(t) - difference),
                  1e-7 * (100.0 + glm::length(difference)));
      }
    }
  }
}

TEST(ModelCurve, HermiteLinesPassTheirPointsWithContinuousTangents) {
  constexpr double kBeside = 1e-9;
  Random random(21);
  for (int count = 3; count < 9; ++count) {
    const std::vector<Vec3> points = randomPoints(random, count);
    const Curve curve(LineType::kHermite, points);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const double t = curve.knots()[i];
      EXPECT_LT(glm::length(curve.position(t) - points[i]), 1e-13);
      EXPECT_LT(glm::length(curve.derivative(t - kBeside) - curve.derivative(t + kBeside)), 1e-5);
    }
    // Without given tangents, the ends are natural.
    EXPECT_LT(glm::length(curve.secondDerivative(0.0)), 1e-9);
    EXPECT_LT(glm::length(curve.secondDerivative(1.0)), 1e-9);
  }
}

TEST(ModelCurve, AHermiteLineThroughPointsOfAParabolaIsTheParabolaInside) {
  // The points lie at equal chords only nearly; with exact chord-length parameters the slopes are those of the parabola
  // through three points, and a cubic with the ends and slopes of a quadratic is the quadratic.
  const Curve curve(LineType::kHermite, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
  for (int i = 0; i <= 12; ++i)
    EXPECT_LT(glm::length(curve.position(i / 12.0) - Vec3(i / 4.0, 0, 0)), 1e-15);
  EXPECT_TRUE(curve.isStraight());
}

TEST(ModelCurve, APointOfAHermiteLineMovesFourPiecesOnly) {
  Random random(22);
  std::vector<Vec3> points = randomPoints(random, 9);
  const Curve before(LineType::kHermite, points);
  // A move around the axis through the neighbours keeps the chords, so that the parameters stay.
  const Vec3 axis = points[3] - points[1];
  const Vec3 foot =
      points[1] + (glm::dot(points[2] - points[1], axis) / glm::dot(axis, axis)) * axis;
  points[2] = foot - (points[2] - foot);
  const Curve after(LineType::kHermite, points);
  for (int i = 0; i <= 64; ++i) {
    const double t = before.knots()[4] + (1.0 - before.knots()[4]) * (i / 64.0);
    EXPECT_LT(glm::length(before.position(t) - after.position(t)), 1e-13);
  }
  EXPECT_GT(glm::length(before.position(before.knots()[2]) - after.position(after.knots()[2])),
            0.01);
}

TEST(ModelCurve, GivenTangentsAreThoseOfTheEnds) {
  Random random(23);
  for (const LineType type : {LineType::kSpline, LineType::kHermite}) {
    for (int i = 0; i < 20; ++i) {
      const EndTangents tangents{glm::normalize(random.inBox()), glm::normalize(random.inBox())};
      const Curve curve(type, randomPoints(random, 3 + i % 4), tangents);
      EXPECT_LT(glm::length(glm::normalize(curve.derivative(0.0)) - *tangents.start), 1e-13);
      EXPECT_LT(glm::length(glm::normalize(curve.derivative(1.0)) - *tangents.end), 1e-13);
      if (type == LineType::kHermite) continue;
      for (std::size_t k = 1; k + 1 < curve.knots().size(); ++k) {
        const double t = curve.knots()[k];
        EXPECT_LT(glm::length(curve.secondDerivative(t - 1e-9) - curve.secondDerivative(t + 1e-9)),
                  1e-4);
      }
    }
  }
}

TEST(ModelCurve, ASplineWithTheTangentsOfACircleIsNearIt) {
  // Clamped splines converge with the fourth power of the distance of their points, natural ones only with the second.
  const auto deviation = [](int count, bool clamped) {
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) {
      const double angle = 0.5 * std::numbers::pi * i / count;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    const Curve curve(LineType::kSpline, points,
                      clamped ? EndTangents{Vec3(0, 1, 0), Vec3(-1, 0, 0)} : EndTangents{});
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i)
      worst = std::max(worst, std::fabs(glm::length(curve.position(i / 1000.0)) - 1.0));
    return worst;
  };
  EXPECT_GT(deviation(4, true) / deviation(8, true), 12.0);
  EXPECT_LT(deviation(8, true), 0.02 * deviation(8, false));
}

TEST(ModelCurve, SplineKnotsAreProportionalToTheChords) {
  const Curve curve(LineType::kSpline, {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 2, 1}});
  EXPECT_DOUBLE_EQ(curve.knots()[1], 0.25);
  EXPECT_DOUBLE_EQ(curve.knots()[2], 0.75);
}

TEST(ModelCurve, ParabolaPassesItsMiddlePointHalfway) {
  const Curve curve(LineType::kParabolic, {{0, 0, 0}, {0.4, 1, 0.2}, {2, 0, 0}});
  EXPECT_LT(glm::length(curve.position(0.5) - Vec3(0.4, 1, 0.2)), 1e-15);
}

TEST(ModelCurve, DerivativeIsTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  for (const Curve& curve : randomCurves(3)) {
    for (double t = 0.013; t < 1.0; t += 0.0617) {
      const Vec3 difference =
          (curve.position(t + kStep) - curve.position(t - kStep)) / (2.0 * kStep);
      EXPECT_LT(glm::length(curve.derivative(t) - difference),
                1e-7 * glm::length(difference) + 1e-8);
    }
  }
}

TEST(ModelCurve, SplineIsSmoothToTheSecondDerivativeAcrossKnots) {
  constexpr double kStep = 1e-5;
  Random random(4);
  const Curve curve(LineType::kSpline, randomPoints(random, 8));
  for (std::size_t i = 1; i + 1 < curve.knots().size(); ++i) {
    const double knot = curve.knots()[i];
    const Vec3 slopeBefore = curve.derivative(knot - 1e-12);
    EXPECT_LT(glm::length(curve.derivative(knot) - slopeBefore), 1e-8 * glm::length(slopeBefore));
    const Vec3 bendBefore = (curve.derivative(knot) - curve.derivative(knot - kStep)) / kStep;
    const Vec3 bendAfter = (curve.derivative(knot + kStep) - curve.derivative(knot)) / kStep;
    EXPECT_LT(glm::length(bendAfter - bendBefore), 1e-2 * (1.0 + glm::length(bendBefore)));
  }
}

TEST(ModelCurve, SplineEndsAreNatural) {
  constexpr double kStep = 1e-6;
  Random random(5);
  const Curve curve(LineType::kSpline, randomPoints(random, 6));
  const Vec3 atStart = (curve.derivative(kStep) - curve.derivative(0.0)) / kStep;
  const Vec3 inside = (curve.derivative(0.1 + kStep) - curve.derivative(0.1)) / kStep;
  EXPECT_LT(glm::length(atStart), 1e-3 * glm::length(inside));
}

/// A closed spline through `count` random positions.
std::vector<Vec3> randomRing(Random& random, int count) {
  std::vector<Vec3> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    ring.push_back(Vec3(std::cos(angle), std::sin(angle), 0.0) + random.inBox(0.3));
  }
  ring.push_back(ring.front());
  return ring;
}

TEST(ModelCurve, ClosedSplineIsSmoothToTheSecondDerivativeAtItsSeam) {
  constexpr double kStep = 1e-5;
  Random random(8);
  for (int count = 3; count < 12; ++count) {
    const Curve curve(LineType::kSpline, randomRing(random, count));
    EXPECT_TRUE(curve.isClosed());
    EXPECT_EQ(curve.position(0.0), curve.position(1.0));
    const double speed = glm::length(curve.derivative(0.0));
    EXPECT_LT(glm::length(curve.derivative(0.0) - curve.derivative(1.0)), 1e-12 * speed);
    const Vec3 before = (curve.derivative(1.0) - curve.derivative(1.0 - kStep)) / kStep;
    const Vec3 after = (curve.derivative(kStep) - curve.derivative(0.0)) / kStep;
    EXPECT_GT(glm::length(after), 1.0);
    EXPECT_LT(glm::length(after - before), 1e-3 * glm::length(after)) << count;
    for (std::size_t i = 0; i < curve.points().size(); ++i)
      EXPECT_LT(glm::length(curve.position(curve.knots()[i]) - curve.points()[i]), 1e-13);
  }
}

TEST(ModelCurve, ClosedSplineDoesNotDependOnItsFirstPoint) {
  Random random(9);
  for (int count = 3; count < 12; ++count) {
    std::vector<Vec3> ring = randomRing(random, count);
    const Curve curve(LineType::kSpline, ring);
    ring.pop_back();
    std::ranges::rotate(ring, ring.begin() + 2);
    ring.push_back(ring.front());
    const Curve later(LineType::kSpline, ring);
    const double offset = curve.knots()[2];
    for (double t = 0.0; t < 1.0 - offset; t += 0.01)
      EXPECT_LT(glm::length(later.position(t) - curve.position(t + offset)), 1e-13);
    EXPECT_NEAR(later.length(), curve.length(), 1e-12);
  }
}

TEST(ModelCurve, ClosedSplineThroughACircleHasItsSymmetry) {
  constexpr int kPoints = 12;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<Vec3> ring;
  for (int i = 0; i <= kPoints; ++i) {
    const double angle = kTurn * (i % kPoints) / kPoints;
    ring.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const Curve curve(LineType::kSpline, ring);
  for (double t = 0.0; t < 1.0; t += 0.003)
    EXPECT_NEAR(glm::length(curve.position(t)), 1.0, 2.5e-4);
  for (int piece = 0; piece < kPoints; ++piece)
    EXPECT_NEAR(curve.length(piece / 12.0, (piece + 1) / 12.0), curve.length() / kPoints, 1e-12);
  EXPECT_FALSE(Curve(LineType::kSpline, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}).isClosed());
}

TEST(ModelCurve, SplineThroughCollinearEvenPointsIsStraight) {
  const Curve curve(LineType::kSpline, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  EXPECT_TRUE(curve.isStraight());
  EXPECT_NEAR(curve.length(), 3.0 * std::sqrt(3.0), 1e-13);
  EXPECT_FALSE(Curve(LineType::kParabolic, {{0, 0, 0}, {1, 1e-3, 0}, {2, 0, 0}}).isStraight());
}

TEST(ModelCurve, ParabolaHasItsKnownLength) {
  // y = x^2 from 0 to 1: sqrt(5)/2 + asinh(2)/4.
  const Curve curve(LineType::kParabolic, {{0, 0, 0}, {0.5, 0.25, 0}, {1, 1, 0}});
  EXPECT_NEAR(curve.length(), std::sqrt(5.0) / 2.0 + std::asinh(2.0) / 4.0, 1e-12);
}

TEST(ModelCurve, SplineLengthConvergesToTheArc) {
  double previousError = 1.0;
  for (const int count : {8, 16, 32}) {
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) {
      const double angle = std::numbers::pi * i / count;
      points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    const double error = std::fabs(Curve(LineType::kSpline, points).length() - std::numbers::pi);
    EXPECT_LT(error, 0.3 * previousError) << count;
    previousError = error;
  }
  EXPECT_LT(previousError, 1e-4);
}

TEST(ModelCurve, LengthIsAdditive) {
  for (const Curve& curve : randomCurves(6)) {
    // If the speed of a spline nearly vanishes, it has a kink, where quadrature converges slowly.
    EXPECT_NEAR(curve.length(0.0, 0.37) + curve.length(0.37, 1.0), curve.length(),
                1e-5 * curve.length());
    EXPECT_EQ(curve.length(0.4, 0.4), 0.0);
  }
}

TEST(ModelCurve, ReversedCurveRunsBackwards) {
  for (const Curve& curve : randomCurves(7)) {
    const OrientedCurve backward(curve, true);
    EXPECT_EQ(backward.start(), curve.end());
    EXPECT_EQ(backward.position(0.25), curve.position(0.75));
    EXPECT_EQ(backward.sample(0.25).derivative, -curve.derivative(0.75));
    EXPECT_EQ(backward.reverse().position(0.25), curve.position(0.25));
  }
}

}  // namespace
}  // namespace tetrafront::testing
