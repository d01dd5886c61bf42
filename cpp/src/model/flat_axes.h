#pragma once

/// @file Coordinates that all points of a line or patch share. Weights that sum to one do so only
/// up to rounding. Without this correction, nodes of a patch in the plane z = 0.1 would leave it by
/// a few units in the last place, and exact predicates would find room for tetrahedra there.

#include <array>
#include <span>

#include "tetrafront/vec3.h"

namespace tetrafront {

class FlatAxes {
 public:
  /// Makes an object without flat axes.
  FlatAxes() = default;

  /// Finds the flat axes: those along which all `points` have the same coordinate, bit for bit.
  explicit FlatAxes(std::span<const Vec3> points) : value_(points.front()) {
    flat_.fill(true);
    for (const Vec3& point : points) restrictTo(point);
  }

  /// Removes the axes along which `point` has another coordinate.
  void restrictTo(const Vec3& point) {
    for (int k = 0; k < 3; ++k) flat_[k] = flat_[k] && point[k] == value_[k];
  }

  /// Removes the axes that are not flat in `other`, or along which it has another coordinate.
  void restrictTo(const FlatAxes& other) {
    for (int k = 0; k < 3; ++k)
      flat_[k] = flat_[k] && other.flat_[k] && other.value_[k] == value_[k];
  }

  /// Removes the axes along which `direction` has a component.
  void restrictToDirection(const Vec3& direction) {
    for (int k = 0; k < 3; ++k) flat_[k] = flat_[k] && direction[k] == 0.0;
  }

  /// Restores the flat coordinates of a computed position.
  void settle(Vec3& position) const {
    for (int k = 0; k < 3; ++k)
      if (flat_[k]) position[k] = value_[k];
  }

  /// Sets the flat components of a direction to zero.
  void settleDirection(Vec3& direction) const {
    for (int k = 0; k < 3; ++k)
      if (flat_[k]) direction[k] = 0.0;
  }

 private:
  std::array<bool, 3> flat_{};
  Vec3 value_{0.0};
};

}  // namespace tetrafront
