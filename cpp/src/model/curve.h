#pragma once

/// @file A line that can be evaluated: position and derivative at a parameter t in [0, 1], arc
/// length (Löhner & Parikh 1988, section 4, line types 1 to 3; arcs and circles are added).

#include <span>
#include <vector>

#include "model/circular_arc.h"
#include "model/flat_axes.h"
#include "tetrafront/model.h"

namespace tetrafront {

class Curve {
 public:
  struct Sample {
    Vec3 position{0.0};
    Vec3 derivative{0.0};
  };

  /// `points` must have the number of points that the type requires (see LineType), finite,
  /// successive ones distinct, those of arcs and circles not collinear.
  Curve(LineType type, std::vector<Vec3> points);

  /// Position at t; bit-exact copies of the first and last point at t = 0 and t = 1.
  [[nodiscard]] Vec3 position(double t) const;
  [[nodiscard]] Vec3 derivative(double t) const;
  [[nodiscard]] Sample sample(double t) const;

  /// Arc length of the whole line, or between two parameters, from <= to.
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double length(double from, double to) const;

  [[nodiscard]] LineType type() const { return type_; }
  [[nodiscard]] std::span<const Vec3> points() const { return points_; }
  [[nodiscard]] const Vec3& start() const { return points_.front(); }
  [[nodiscard]] const Vec3& end() const { return points_.back(); }

  /// True if all points lie on the chord, up to rounding: the line is straight, whatever its type.
  [[nodiscard]] bool isStraight() const;

  /// True for a line that ends where it begins; it is as smooth there as anywhere else.
  [[nodiscard]] bool isClosed() const;

  /// Parameters at which the curve is not infinitely smooth, ascending, 0 and 1 included.
  [[nodiscard]] std::span<const double> knots() const { return knots_; }

 private:
  [[nodiscard]] Sample sampleByType(double t) const;
  [[nodiscard]] Sample sampleParabola(double t) const;
  [[nodiscard]] Sample sampleSpline(double t) const;
  class SplineEquations;
  void fitSpline();
  void closeSpline(const SplineEquations& equations);
  [[nodiscard]] Vec3 chordSlope(std::size_t piece) const;

  LineType type_;
  std::vector<Vec3> points_;
  std::vector<double> knots_;
  std::vector<Vec3> secondDerivatives_;  ///< for a spline: one per point
  CircularArc arc_;                      ///< for an arc or a circle
  FlatAxes flat_;
  double length_ = 0.0;
};

/// A curve in the direction of a loop: t = 0 where the loop enters.
class OrientedCurve {
 public:
  OrientedCurve(const Curve& curve, bool reversed) : curve_(&curve), reversed_(reversed) {}

  [[nodiscard]] Vec3 position(double t) const { return curve_->position(reversed_ ? 1.0 - t : t); }
  [[nodiscard]] Curve::Sample sample(double t) const;
  [[nodiscard]] const Vec3& start() const { return reversed_ ? curve_->end() : curve_->start(); }
  [[nodiscard]] const Vec3& end() const { return reversed_ ? curve_->start() : curve_->end(); }
  [[nodiscard]] double length() const { return curve_->length(); }
  [[nodiscard]] std::span<const Vec3> points() const { return curve_->points(); }
  [[nodiscard]] bool isStraight() const { return curve_->isStraight(); }
  [[nodiscard]] OrientedCurve reverse() const { return {*curve_, !reversed_}; }

 private:
  const Curve* curve_;
  bool reversed_;
};

}  // namespace tetrafront
