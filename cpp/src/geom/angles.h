#pragma once

/// @file Angles whose functions give the same bits on all platforms.

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tetrafront {

constexpr double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

/// Returns the cosine of an angle from 0 to 180 degrees by its series: library functions differ in the last bit between
/// platforms, but meshes must not.
constexpr double cosineOfDegrees(double degrees) {
  const double square = radians(degrees) * radians(degrees);
  double term = 1.0;
  double sum = 1.0;
  for (int n = 1; n < 20; ++n) {
    term *= -square / ((2.0 * n - 1.0) * (2.0 * n));
    sum += term;
  }
  return sum;
}

/// Returns twice the sine of half the angle of a cosine, which is about the angle itself if that is small.
inline double chordOfCosine(double cosine) { return std::sqrt(std::max(0.0, 2.0 - 2.0 * cosine)); }

}  // namespace tetrafront
