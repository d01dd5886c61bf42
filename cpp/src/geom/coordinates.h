#pragma once

/// @file Which coordinates can be computed with.

#include <cmath>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Larger coordinates would overflow the exact predicates' expansions; they are as good as
/// infinite.
inline constexpr double kLargestCoordinate = 0x1p100;

/// Where all coordinates are smaller, products of three differences of them lose their last bits.
inline constexpr double kSmallestExtent = 0x1p-100;

/// The largest of the coordinates, without their signs.
[[nodiscard]] inline double magnitudeOf(const Vec3& place) {
  return std::fmax(std::fabs(place.x), std::fmax(std::fabs(place.y), std::fabs(place.z)));
}

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
