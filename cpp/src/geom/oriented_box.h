#pragma once

/// @file Boxes that lie along what they hold. A needle's own box is as thin as the needle, where its
/// axis-parallel box is as thick as it is long; so is the box of many needles side by side.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Never smaller than what it holds, whatever the rounding.
struct OrientedBox {
  Vec3 centre{0.0};
  /// Half its edges, about at right angles: along, across and upright to what it holds.
  std::array<Vec3, 3> halves{Vec3(0.0), Vec3(0.0), Vec3(0.0)};

  /// Along the triangle's longest edge, and flat on it.
  static OrientedBox of(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Around both, along the directions that they have in common.
  static OrientedBox hull(const OrientedBox& a, const OrientedBox& b);

  /// True only if the boxes have no point in common. Some that have none are not told apart.
  [[nodiscard]] bool isApartFrom(const OrientedBox& other) const;
};

}  // namespace tetrafront
