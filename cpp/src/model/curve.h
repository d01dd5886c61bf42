#pragma once

/// @file A line that can be evaluated: position and derivative at a parameter t in [0, 1], arc
/// length (Löhner & Parikh 1988, section 4, line types 1 to 3; arcs, circles and Hermite lines are added).

#include <optional>
#include <span>
#include <vector>

#include "model/circular_arc.h"
#include "model/cubic_spline.h"
#include "model/flat_axes.h"
#include "model/hermite_cubics.h"
#include "tetrafront/model.h"

namespace tetrafront {

/// Unit tangents at the ends of a spline or Hermite line, in the line's direction; none where the end is natural.
struct EndTangents {
  std::optional<Vec3> start;
  std::optional<Vec3> end;
};

class Curve {
 public:
  struct Sample {
    Vec3 position{0.0};
    Vec3 derivative{0.0};
  };

  /// `points` must have the number of points that the type requires (see LineType), finite,
  /// successive ones distinct, those of arcs and circles not collinear. Lines of other types than
  /// splines and Hermite lines have no use for tangents, nor have closed ones.
  Curve(LineType type, std::vector<Vec3> points, const EndTangents& tangents = {});

  /// Position at t; bit-exact copies of the first and last point at t = 0 and t = 1.
  [[nodiscard]] Vec3 position(double t) const;
  [[nodiscard]] Vec3 derivative(double t) const;
  [[nodiscard]] Sample sample(double t) const;
  /// Second derivative at t; at an inner knot of a Hermite line, that of the piece after it.
  [[nodiscard]] Vec3 secondDerivative(double t) const;

  /// Arc length of the whole line, or between two parameters, from <= to.
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double length(double from, double to) const;

  [[nodiscard]] LineType type() const { return type_; }
  [[nodiscard]] std::span<const Vec3> points() const { return points_; }
  [[nodiscard]] const Vec3& start() const { return points_.front(); }
  [[nodiscard]] const Vec3& end() const { return points_.back(); }

  /// True if all points and tangents lie on the chord, up to rounding: the line is straight, whatever its type.
  [[nodiscard]] bool isStraight() const;

  /// True for a line that ends where it begins; it is as smooth there as anywhere else.
  [[nodiscard]] bool isClosed() const;

  /// Parameter at which the line passes point `index`.
  [[nodiscard]] double parameterOfPoint(std::size_t index) const;

  /// Coordinates that all positions share.
  [[nodiscard]] const FlatAxes& flatAxes() const { return flat_; }

  /// Parameters at which the curve is not infinitely smooth, ascending, 0 and 1 included.
  [[nodiscard]] std::span<const double> knots() const { return knots_; }

 private:
  [[nodiscard]] Sample sampleByType(double t) const;
  [[nodiscard]] Sample sampleParabola(double t) const;
  void fitKnots();
  void fitSpline();
  [[nodiscard]] std::optional<Vec3> endSlope(const std::optional<Vec3>& tangent) const;

  LineType type_;
  std::vector<Vec3> points_;
  std::vector<double> knots_;
  EndTangents tangents_;
  double chords_ = 0.0;       ///< sum of the lengths of the chords, for a spline or Hermite line
  CubicSpline<Vec3> spline_;  ///< for a spline
  HermiteCubics hermite_;     ///< for a Hermite line
  CircularArc arc_;           ///< for an arc or a circle
  FlatAxes flat_;
  double length_ = 0.0;
};

/// A curve in the direction of a loop: t = 0 where the loop enters.
class OrientedCurve {
 public:
  OrientedCurve(const Curve& curve, bool reversed) : curve_(&curve), reversed_(reversed) {}

  [[nodiscard]] Vec3 position(double t) const { return curve_->position(reversed_ ? 1.0 - t : t); }
  [[nodiscard]] Curve::Sample sample(double t) const;
  [[nodiscard]] Vec3 secondDerivative(double t) const {
    return curve_->secondDerivative(reversed_ ? 1.0 - t : t);
  }
  [[nodiscard]] const Vec3& start() const { return reversed_ ? curve_->end() : curve_->start(); }
  [[nodiscard]] const Vec3& end() const { return reversed_ ? curve_->start() : curve_->end(); }
  [[nodiscard]] double length() const { return curve_->length(); }
  /// Points in the direction of the curve, whichever that of the loop.
  [[nodiscard]] std::span<const Vec3> points() const { return curve_->points(); }
  /// Parameter in this direction of points()[index].
  [[nodiscard]] double parameterOfPoint(std::size_t index) const {
    return reversed_ ? 1.0 - curve_->parameterOfPoint(index) : curve_->parameterOfPoint(index);
  }
  [[nodiscard]] const FlatAxes& flatAxes() const { return curve_->flatAxes(); }
  [[nodiscard]] bool isStraight() const { return curve_->isStraight(); }
  [[nodiscard]] LineType type() const { return curve_->type(); }
  /// Knot number `index` in this direction.
  [[nodiscard]] double knot(std::size_t index) const {
    const std::span<const double> knots = curve_->knots();
    return reversed_ ? 1.0 - knots[knots.size() - 1 - index] : knots[index];
  }
  [[nodiscard]] std::size_t knotCount() const { return curve_->knots().size(); }
  [[nodiscard]] OrientedCurve reverse() const { return {*curve_, !reversed_}; }

 private:
  const Curve* curve_;
  bool reversed_;
};

}  // namespace tetrafront
