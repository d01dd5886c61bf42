#include "geom/sine.h"

#include <cmath>
#include <numbers>

namespace tetrafront {

namespace {

/// pi / 2 in two parts; the first one has few enough bits that its multiples are exact.
constexpr double kQuarterHigh = 1.57079632673412561417;
constexpr double kQuarterLow = 6.07710050650619224932e-11;
constexpr double kQuarter = std::numbers::pi / 2.0;

/// Taylor series; at pi / 4 the first terms left out are 1e-19 and 4e-18 of the result.
SineCosine ofSmallAngle(double angle) {
  const double square = angle * angle;
  double sine = 0.0;
  for (int n = 17; n >= 3; n -= 2) sine = (1.0 - sine) * square / (n * (n - 1));
  double cosine = 0.0;
  for (int n = 16; n >= 2; n -= 2) cosine = (1.0 - cosine) * square / (n * (n - 1));
  return {angle - angle * sine, 1.0 - cosine};
}

/// Newton steps from a first guess that is wrong by less than 0.08; each leaves about the fifth
/// power of the error.
constexpr int kAngleSteps = 3;

}  // namespace

SineCosine sineCosine(double angle) {
  const double quarters = std::floor(angle / kQuarter + 0.5);
  const double rest = (angle - quarters * kQuarterHigh) - quarters * kQuarterLow;
  const auto [sine, cosine] = ofSmallAngle(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double angleOf(const Vec2& direction) {
  const Vec2 unit = direction / glm::length(direction);
  const double x = std::fabs(unit.x);
  const double y = std::fabs(unit.y);
  // Within the first quadrant, an angle is about proportional to y / (x + y).
  double angle = kQuarter * (y / (x + y));
  for (int step = 0; step < kAngleSteps; ++step) {
    const auto [sine, cosine] = sineCosine(angle);
    const double difference = y * cosine - x * sine;
    angle += difference + difference * difference * difference / 6.0;
  }
  if (unit.x < 0.0) angle = std::numbers::pi - angle;
  return unit.y < 0.0 ? 2.0 * std::numbers::pi - angle : angle;
}

}  // namespace tetrafront
