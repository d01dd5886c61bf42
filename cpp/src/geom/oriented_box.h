#pragma once

/// @file Boxes aligned with their contents. The oriented box of a needle is as thin as the needle,
/// while its axis-parallel box can be as thick as the needle is long. The same holds for many
/// needles side by side.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Contains its contents in spite of rounding.
struct OrientedBox {
  Vec3 centre{0.0};
  /// Half the edges, approximately at right angles: along, across and normal to the contents.
  std::array<Vec3, 3> halves{Vec3(0.0), Vec3(0.0), Vec3(0.0)};

  /// Returns the box of a triangle, aligned with its longest edge and its plane.
  static OrientedBox of(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Returns a box around both, aligned with the directions they have in common.
  static OrientedBox hull(const OrientedBox& a, const OrientedBox& b);

  /// Returns true only if the boxes have no point in common. It may return false for boxes that
  /// have none.
  [[nodiscard]] bool isApartFrom(const OrientedBox& other) const;
};

}  // namespace tetrafront
