#pragma once

/// @file Which coordinates can be computed with.

#include <cmath>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Larger coordinates would overflow the exact predicates' expansions; they are as good as
/// infinite.
inline constexpr double kLargestCoordinate = 0x1p100;

/// True if no coordinate is NaN or beyond kLargestCoordinate.
[[nodiscard]] inline bool isFinite(const Vec3& place) {
  // A comparison with NaN is false.
  return std::fabs(place.x) <= kLargestCoordinate && std::fabs(place.y) <= kLargestCoordinate &&
         std::fabs(place.z) <= kLargestCoordinate;
}

/// The first coordinate that keeps a place from being finite; its x where none does.
[[nodiscard]] inline double refusedCoordinate(const Vec3& place) {
  for (const double coordinate : {place.x, place.y, place.z})
    if (!(std::fabs(coordinate) <= kLargestCoordinate)) return coordinate;
  return place.x;
}

}  // namespace tetrafront
