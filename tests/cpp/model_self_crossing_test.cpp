// Lines that intersect themselves, compared with curves whose intersections are known.

#include "model/self_crossing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/check_model.h"
#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

Curve spline(std::vector<Vec3> points) { return {LineType::kSpline, std::move(points)}; }

/// Points of a figure of eight that passes through the origin twice without a point there; `lift`
/// is its rise from end to end.
std::vector<Vec3> figureOfEight(double lift) {
  std::vector<Vec3> points;
  constexpr int kPoints = 21;
  for (int i = 0; i < kPoints; ++i) {
    const double part = (i + 0.5) / kPoints;
    const double angle = 2.0 * std::numbers::pi * (part + 0.25);
    points.emplace_back(std::sin(angle), std::sin(2.0 * angle), lift * part);
  }
  return points;
}

TEST(SelfCrossing, StraightLinesAndBentParabolasHaveNone) {
  EXPECT_FALSE(findSelfCrossing({LineType::kStraight, {{0, 0, 0}, {1, 0, 0}}}));
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    EXPECT_FALSE(
        findSelfCrossing({LineType::kParabolic, {random.inBox(), random.inBox(), random.inBox()}}))
        << seed;
  }
}

TEST(SelfCrossing, ParabolaWithItsMidpointNearAnEndRunsBack) {
  // Along its chord x(t) = 4 m t (1 - t) + t (2 t - 1) ascends only for m in [1/4, 3/4].
  for (const double middle : {-0.5, 0.1, 0.24, 0.76, 1.5})
    EXPECT_TRUE(findSelfCrossing({LineType::kParabolic, {{0, 0, 0}, {middle, 0, 0}, {1, 0, 0}}}))
        << middle;
  for (const double middle : {0.25, 0.26, 0.5, 0.75})
    EXPECT_FALSE(findSelfCrossing({LineType::kParabolic, {{0, 0, 0}, {middle, 0, 0}, {1, 0, 0}}}))
        << middle;
}

TEST(SelfCrossing, FigureOfEightIsFoundAtItsCentre) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Vec3> points = figureOfEight(0.0);
    for (Vec3& point : points) point *= scale;
    const std::optional<Vec3> position = findSelfCrossing(spline(points));
    ASSERT_TRUE(position) << scale;
    EXPECT_LT(glm::length(*position), 0.02 * scale);
  }
}

TEST(SelfCrossing, IsFoundAtTheEndOfALongSpline) {
  for (const int count : {10, 400, 10'000}) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i)
      points.emplace_back(static_cast<double>(i) / count, 1e-4 * std::sin(0.3 * i), 0.0);
    const double last = points.back().x;
    points.emplace_back(last + 0.1, 0.1, 0.0);
    EXPECT_FALSE(findSelfCrossing(spline(points))) << count;
    points.emplace_back(last - 0.1, 0.1, 0.0);
    points.emplace_back(last - 0.2, -0.1, 0.0);
    const std::optional<Vec3> position = findSelfCrossing(spline(points));
    ASSERT_TRUE(position) << count;
    EXPECT_NEAR(position->x, last - 0.16, 0.04) << count;
  }
}

TEST(SelfCrossing, PassagesApartInSpaceDoNotCross) {
  for (const double lift : {1.0, 1e-3, 1e-6})
    EXPECT_FALSE(findSelfCrossing(spline(figureOfEight(lift)))) << lift;
}

TEST(SelfCrossing, OnePieceMayCrossItself) {
  // Close points between far ones: the spline's long pieces overshoot in opposite directions.
  const Curve loop = spline({{0, 0, 0}, {1, 0.02, 0}, {0.98, 0.05, 0}, {0.02, -0.3, 0}, {1, 1, 0}});
  // Oracle: the signs of the polyline's crossings, sampled far finer than its features.
  constexpr int kSamples = 3000;
  std::vector<Vec3> samples;
  for (int i = 0; i <= kSamples; ++i)
    samples.push_back(loop.position(static_cast<double>(i) / kSamples));
  const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  bool crosses = false;
  for (int i = 0; i < kSamples && !crosses; ++i) {
    for (int k = i + 2; k < kSamples; ++k) {
      crosses = crosses || (turn(samples[i], samples[i + 1], samples[k]) *
                                    turn(samples[i], samples[i + 1], samples[k + 1]) <
                                0.0 &&
                            turn(samples[k], samples[k + 1], samples[i]) *
                                    turn(samples[k], samples[k + 1], samples[i + 1]) <
                                0.0);
    }
  }
  EXPECT_EQ(findSelfCrossing(loop).has_value(), crosses);
}

TEST(SelfCrossing, AgreesWithFineSamplesOnRandomPlaneSplines) {
  int crossing = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    std::vector<Vec3> points;
    for (int i = random.integer(4, 7); i > 0; --i)
      points.emplace_back(random.between(-1, 1), random.between(-1, 1), 0.0);
    const Curve curve = spline(points);
    constexpr int kSamples = 800;
    std::vector<Vec3> samples;
    for (int i = 0; i <= kSamples; ++i)
      samples.push_back(curve.position(static_cast<double>(i) / kSamples));
    const auto turn = [](const Vec3& a, const Vec3& b, const Vec3& c) {
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0;
    };
    bool crosses = false;
    for (int i = 0; i < kSamples && !crosses; ++i) {
      for (int k = i + 2; k < kSamples && !crosses; ++k)
        crosses = turn(samples[i], samples[i + 1], samples[k]) !=
                      turn(samples[i], samples[i + 1], samples[k + 1]) &&
                  turn(samples[k], samples[k + 1], samples[i]) !=
                      turn(samples[k], samples[k + 1], samples[i + 1]);
    }
    EXPECT_EQ(findSelfCrossing(curve).has_value(), crosses) << seed;
    crossing += crosses ? 1 : 0;
  }
  EXPECT_GT(crossing, 5);
  EXPECT_LT(crossing, 55);
}

TEST(SelfCrossing, CommonEndOfAClosedSplineIsNoCrossing) {
  ModelBuilder builder;
  builder.circle({0, 0, 0}, 1.0, 1);
  const ResolvedModel resolved(builder.model);
  EXPECT_FALSE(findSelfCrossing(resolved.curve(LineId(0U))));
}

TEST(SelfCrossing, LineThatEndsOnItselfIsReportedWithItsPosition) {
  ModelBuilder builder;
  builder.line(LineType::kSpline,
               {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {1, 1, 0}, {1, 0, 0}});
  std::vector<Diagnostic> found = diagnoseModel(builder.model);
  std::erase_if(found, [](const Diagnostic& d) { return d.code == DiagnosticCode::kEmptyModel; });
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kLineSelfIntersection);
  EXPECT_EQ(found[0].severity, Severity::kWarning) << "no patch uses it";
  EXPECT_TRUE(found[0].hasPosition);
  EXPECT_LT(glm::length(found[0].position - Vec3(1, 0, 0)), 1e-6);
}

}  // namespace
}  // namespace tetrafront::testing
