#pragma once

/// @file Range of the coordinates that the engine accepts.

#include <cmath>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Coordinates above this limit would overflow the expansions of the exact predicates; they count
/// as infinite.
inline constexpr double kLargestCoordinate = 0x1p100;

/// Nonzero coordinates below this limit would underflow in the expansions. It is far below any model's extent, as
/// rounded zeros are.
inline constexpr double kSmallestCoordinate = 0x1p-250;

/// If all coordinates are below this limit, products of three differences lose their last bits.
inline constexpr double kSmallestExtent = 0x1p-100;

/// Returns the largest magnitude of the coordinates.
[[nodiscard]] inline double magnitudeOf(const Vec3& position) {
  return std::fmax(std::fabs(position.x), std::fmax(std::fabs(position.y), std::fabs(position.z)));
}

/// Returns true if no coordinate is NaN or beyond kLargestCoordinate.
[[nodiscard]] inline bool isFinite(const Vec3& position) {
  // A comparison with NaN is false.
  return std::fabs(position.x) <= kLargestCoordinate &&
         std::fabs(position.y) <= kLargestCoordinate && std::fabs(position.z) <= kLargestCoordinate;
}

/// Returns the first coordinate that keeps a position from being finite, or its x if there is
/// none.
[[nodiscard]] inline double refusedCoordinate(const Vec3& position) {
  for (const double coordinate : {position.x, position.y, position.z})
    if (!(std::fabs(coordinate) <= kLargestCoordinate)) return coordinate;
  return position.x;
}

/// Returns the position with zeros in place of coordinates below kSmallestCoordinate.
[[nodiscard]] inline Vec3 inExactRange(Vec3 position) {
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(position[k]) < kSmallestCoordinate) position[k] = 0.0;
  }
  return position;
}

/// Returns the position nearest to the given one that is exact in coordinates about `centre`, too: adding the centre to it
/// rounds nothing.
[[nodiscard]] inline Vec3 exactAbout(const Vec3& centre, const Vec3& position) {
  return inExactRange((position + centre) - centre);
}

}  // namespace tetrafront
