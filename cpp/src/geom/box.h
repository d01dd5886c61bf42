#pragma once

/// @file Axis-parallel boxes in single precision, rounded outward: half the memory traffic of
/// doubles, and never smaller than what they hold.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

// Branch-free, because the branch would be unpredictable. A result rounded to zero keeps the sign
// of `value`, so stepping its bit pattern gives the next float of that sign.
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

  /// Returns the box of three points.
  static Box of(const Vec3& a, const Vec3& b, const Vec3& c) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.low[k] = roundedDown(std::min(a[k], std::min(b[k], c[k])));
      box.high[k] = roundedUp(std::max(a[k], std::max(b[k], c[k])));
    }
    return box;
  }

  /// Extends the box by centre - reach and centre + reach. Returns true if it grew.
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

  void include(const Box& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }

  [[nodiscard]] bool contains(const Box& other) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (other.low[k] < low[k] || other.high[k] > high[k]) return false;
    }
    return true;
  }

  /// Returns the squared distance of a position from the box; 0 inside.
  [[nodiscard]] double squaredDistance(const Vec3& position) const {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      const double below = low[k] - position[a];
      const double above = position[a] - high[k];
      const double outside = below > above ? below : above;
      const double gap = outside > 0.0 ? outside : 0.0;
      sum += gap * gap;
    }
    return sum;
  }

  [[nodiscard]] float largestExtent() const {
    return std::max(high[0] - low[0], std::max(high[1] - low[1], high[2] - low[2]));
  }
};

}  // namespace tetrafront
