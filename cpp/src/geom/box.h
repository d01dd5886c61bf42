#pragma once

/// @file Axis-parallel boxes in single precision, rounded outward: half the memory traffic of
/// doubles, and never smaller than what they hold.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// The next float below, or above, a finite value.
inline float nextBelow(float value) {
  if (value == 0.0F) return std::bit_cast<float>(0x80000001U);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return std::bit_cast<float>(value > 0.0F ? bits - 1 : bits + 1);
}
inline float nextAbove(float value) { return -nextBelow(-value); }

// Without branches, which would be coin tosses. A zero that was rounded away from its value has the
// value's sign, so that its neighbour is the next number of that sign.
inline float roundedDown(double value) {
  const auto rounded = static_cast<float>(value);
  const auto bits = std::bit_cast<std::uint32_t>(rounded);
  const std::uint32_t isAbove = static_cast<double>(rounded) > value ? 1 : 0;
  return std::bit_cast<float>(bits + isAbove * (2 * (bits >> 31) - 1));
}
inline float roundedUp(double value) { return -roundedDown(-value); }

struct Box {
  std::array<float, 3> low;
  std::array<float, 3> high;

  /// The box of three points.
  static Box of(const Vec3& a, const Vec3& b, const Vec3& c) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = roundedDown(std::min(a[k], std::min(b[k], c[k])));
      box.high[k] = roundedUp(std::max(a[k], std::max(b[k], c[k])));
    }
    return box;
  }

  /// Grows to hold the box that reaches so far around `centre`. Returns true if it grew.
  bool include(const Vec3& centre, const Vec3& reach = Vec3(0.0)) {
    bool grew = false;
    for (int k = 0; k < 3; ++k) {
      const float from = roundedDown(centre[k] - reach[k]);
      const float to = roundedUp(centre[k] + reach[k]);
      grew = grew || from < low[k] || to > high[k];
      low[k] = std::min(low[k], from);
      high[k] = std::max(high[k], to);
    }
    return grew;
  }

  [[nodiscard]] float largestExtent() const {
    return std::max(high[0] - low[0], std::max(high[1] - low[1], high[2] - low[2]));
  }
};

}  // namespace tetrafront
