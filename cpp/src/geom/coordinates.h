#pragma once

/// @file Range of the coordinates that the engine accepts.

#include <cmath>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Coordinates above this limit would overflow the expansions of the exact predicates; they count
/// as infinite.
inline constexpr double kLargestCoordinate = 0x1p100;

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

}  // namespace tetrafront
