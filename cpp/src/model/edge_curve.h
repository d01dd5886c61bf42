#pragma once

/// @file An edge of a TrimmedModel as a line that can be divided: t runs from 0 at its start vertex to 1 at its end.

#include <span>
#include <vector>

#include "model/parametric.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront {

class EdgeCurve {
 public:
  struct Sample {
    Vec3 position{0.0};
    Vec3 derivative{0.0};
  };

  /// The edge must not be degenerate, and its references must be valid. `model` must outlive this.
  EdgeCurve(const TrimmedModel& model, const TrimmedEdge& edge);

  /// Position at t; bit-exact copies of the vertices at t = 0 and t = 1.
  [[nodiscard]] Vec3 position(double t) const;
  [[nodiscard]] Vec3 derivative(double t) const { return sample(t).derivative; }
  [[nodiscard]] Sample sample(double t) const;

  /// The curve's own parameter at t.
  [[nodiscard]] double parameterAt(double t) const { return first_ + t * (last_ - first_); }

  /// Arc length between two parameters, from <= to.
  [[nodiscard]] double length(double from, double to) const;

  /// Angle in radians by which the tangent turns along the edge.
  [[nodiscard]] double turning() const;

  /// Parameters at which the curve is not infinitely smooth, ascending, 0 and 1 included.
  [[nodiscard]] std::span<const double> knots() const { return knots_; }

 private:
  const SpaceCurve* curve_;
  double first_;
  double last_;
  Vec3 start_;
  Vec3 end_;
  std::vector<double> knots_;
};

}  // namespace tetrafront
