#pragma once

/// @file A closed chain of lines as one periodic curve.

#include <span>
#include <vector>

#include "model/curve.h"

namespace tetrafront {

/// The parameter counts the parts of the whole length from the start of the first line: each line
/// takes a part as large as its share of the length, and its own parameter divides that part.
class Rim {
 public:
  /// The curves must outlive this.
  explicit Rim(std::vector<OrientedCurve> curves);

  /// Position and derivative at any number, with period 1.
  [[nodiscard]] Curve::Sample sample(double part) const;
  [[nodiscard]] Vec3 position(double part) const { return sample(part).position; }
  [[nodiscard]] double length() const { return length_; }

  /// Returns the parameter of line `index` at t.
  [[nodiscard]] double partAt(std::size_t index, double t) const;
  /// Parameters at which the lines begin, ascending; the first is 0.
  [[nodiscard]] std::span<const double> starts() const { return starts_; }
  /// Returns whether the rim has a corner where line `index` begins.
  [[nodiscard]] bool hasCornerAt(std::size_t index) const;

 private:
  [[nodiscard]] double endOf(std::size_t index) const {
    return index + 1 < starts_.size() ? starts_[index + 1] : 1.0;
  }

  std::vector<OrientedCurve> curves_;
  std::vector<double> starts_;
  double length_ = 0.0;
};

/// Returns the parameter between 0 and 1 of the same position on a rim; below 1.
[[nodiscard]] double wrapped(double part);

}  // namespace tetrafront
