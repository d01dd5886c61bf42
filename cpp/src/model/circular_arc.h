#pragma once

/// @file A circle, or a part of it, through three points.

#include "tetrafront/vec3.h"

namespace tetrafront {

class CircularArc {
 public:
  /// Makes an arc without extent.
  CircularArc() = default;

  /// The arc from `start` over `middle` to `end`. The points must not lie on one straight line.
  static CircularArc through(const Vec3& start, const Vec3& middle, const Vec3& end);
  /// The whole circle from `start` over `second` and `third` back to `start`.
  static CircularArc circleThrough(const Vec3& start, const Vec3& second, const Vec3& third);

  /// Position at a part t of the angle, 0 to 1: on the circle up to rounding, relative to the radius.
  [[nodiscard]] Vec3 position(double t) const;
  /// Derivative with respect to t.
  [[nodiscard]] Vec3 derivative(double t) const;
  [[nodiscard]] Vec3 secondDerivative(double t) const;
  /// The parameter of a position on the circle, from 0.
  [[nodiscard]] double parameterOf(const Vec3& position) const;
  [[nodiscard]] double length() const { return angle_ * glm::length(radius_); }

 private:
  CircularArc(const Vec3& start, const Vec3& second, const Vec3& third);
  [[nodiscard]] double angleAt(const Vec3& position) const;

  Vec3 start_{0.0};
  Vec3 radius_{0.0};   ///< from the centre to the start
  Vec3 forward_{0.0};  ///< of the length of the radius, in the direction of travel at the start
  double angle_ = 0.0;
};

}  // namespace tetrafront
