#pragma once

/// @file Coordinates that all points of a line or patch share. Weights that sum to one do so only
/// up to rounding; without care the nodes of a patch in the plane z = 0.1 would leave it by a few
/// units in the last place, and exact predicates would find room for tetrahedra in between.

#include <array>
#include <span>

#include "tetrafront/vec3.h"

namespace tetrafront {

class FlatAxes {
 public:
  /// No axis is flat.
  FlatAxes() = default;

  /// Each axis along which all `points` have bit for bit the same coordinate is flat.
  explicit FlatAxes(std::span<const Vec3> points) : value_(points.front()) {
    flat_.fill(true);
    for (const Vec3& point : points) restrictTo(point);
  }

  /// Axes along which `point` lies elsewhere are no longer flat.
  void restrictTo(const Vec3& point) {
    for (int k = 0; k < 3; ++k) flat_[k] = flat_[k] && point[k] == value_[k];
  }

  /// Puts a computed position back to where rounding took it from.
  void settle(Vec3& position) const {
    for (int k = 0; k < 3; ++k)
      if (flat_[k]) position[k] = value_[k];
  }

  /// Removes from a direction what leads away.
  void settleDirection(Vec3& direction) const {
    for (int k = 0; k < 3; ++k)
      if (flat_[k]) direction[k] = 0.0;
  }

 private:
  std::array<bool, 3> flat_{};
  Vec3 value_{0.0};
};

}  // namespace tetrafront
