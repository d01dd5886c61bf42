#pragma once

/// @file Cubic splines through values at ascending knots (for example de Boor 1978), twice continuously differentiable. At
/// either end the second derivative is zero (natural) or the slope is given (clamped); closed splines have no ends. Only
/// + - * / are used, so that every platform computes the same values.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tetrafront {

/// The equations for the second derivatives at the knots. They are diagonally dominant, so elimination needs no pivoting.
class SplineEquations {
 public:
  /// `knots` ascend and must outlive this.
  explicit SplineEquations(std::span<const double> knots, bool startIsClamped = false,
                           bool endIsClamped = false)
      : knots_(knots), pivots_(knots.size(), 1.0), endIsClamped_(endIsClamped) {
    const std::size_t last = knots.size() - 1;
    // The first equation of a natural end is M = 0: it couples with no other.
    firstUpper_ = startIsClamped ? 0.5 : 0.0;
    if (startIsClamped) pivots_[0] = 2.0 * step(0);
    for (std::size_t i = 1; i < last; ++i)
      pivots_[i] = 2.0 * (step(i - 1) + step(i)) - step(i - 1) * upper(i - 1);
    if (endIsClamped) pivots_[last] = 2.0 * step(last - 1) - step(last - 1) * upper(last - 1);
  }

  /// Replaces right-hand sides by second derivatives. Those at natural ends must be zero.
  template <class Value>
  [[nodiscard]] std::vector<Value> solve(std::vector<Value> values) const {
    const std::size_t last = values.size() - 1;
    values.front() = values.front() / pivots_.front();
    for (std::size_t i = 1; i < last; ++i)
      values[i] = (values[i] - step(i - 1) * values[i - 1]) / pivots_[i];
    if (endIsClamped_)
      values[last] = (values[last] - step(last - 1) * values[last - 1]) / pivots_[last];
    for (std::size_t i = last; i-- > 0;) values[i] -= upper(i) * values[i + 1];
    return values;
  }

 private:
  [[nodiscard]] double step(std::size_t i) const { return knots_[i + 1] - knots_[i]; }
  [[nodiscard]] double upper(std::size_t i) const {
    return i == 0 ? firstUpper_ : step(i) / pivots_[i];
  }

  std::span<const double> knots_;
  std::vector<double> pivots_;
  double firstUpper_;
  bool endIsClamped_;
};

/// A spline of numbers or vectors.
template <class Value>
class CubicSpline {
 public:
  struct Sample {
    Value value{0.0};
    Value first{0.0};   ///< derivative
    Value second{0.0};  ///< second derivative
  };

  /// Makes a spline that cannot be evaluated.
  CubicSpline() = default;

  /// At least two knots, ascending, and as many values. A given slope clamps its end.
  CubicSpline(std::vector<double> knots, std::vector<Value> values,
              const std::optional<Value>& startSlope = {},
              const std::optional<Value>& endSlope = {})
      : knots_(std::move(knots)), values_(std::move(values)) {
    std::vector<Value> sides = slopeChanges();
    const std::size_t last = values_.size() - 1;
    if (startSlope) sides.front() = 6.0 * (chordSlope(0) - *startSlope);
    if (endSlope) sides.back() = 6.0 * (*endSlope - chordSlope(last - 1));
    seconds_ = SplineEquations(knots_, startSlope.has_value(), endSlope.has_value())
                   .solve(std::move(sides));
  }

  /// The spline whose slope and second derivative at its end are those at its start.
  [[nodiscard]] static CubicSpline closed(std::vector<double> knots, std::vector<Value> values) {
    CubicSpline spline;
    spline.knots_ = std::move(knots);
    spline.values_ = std::move(values);
    const SplineEquations equations(spline.knots_);
    spline.seconds_ = equations.solve(spline.slopeChanges());
    spline.close(equations);
    return spline;
  }

  [[nodiscard]] Sample sample(double t) const {
    const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
    const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
    const double step = knots_[i + 1] - knots_[i];
    const double a = (knots_[i + 1] - t) / step;
    const double b = (t - knots_[i]) / step;
    const Value& left = seconds_[i];
    const Value& right = seconds_[i + 1];
    const double weight = step * step / 6.0;
    Sample result;
    result.value = (a * values_[i] + b * values_[i + 1]) + (weight * (a * a * a - a)) * left +
                   (weight * (b * b * b - b)) * right;
    result.first = (values_[i + 1] - values_[i]) / step -
                   (step * (3.0 * a * a - 1.0) / 6.0) * left +
                   (step * (3.0 * b * b - 1.0) / 6.0) * right;
    result.second = a * left + b * right;
    return result;
  }

 private:
  [[nodiscard]] Value chordSlope(std::size_t piece) const {
    return (values_[piece + 1] - values_[piece]) / (knots_[piece + 1] - knots_[piece]);
  }

  [[nodiscard]] std::vector<Value> slopeChanges() const {
    std::vector<Value> changes(values_.size(), Value(0.0));
    for (std::size_t i = 1; i + 1 < values_.size(); ++i)
      changes[i] = 6.0 * (chordSlope(i) - chordSlope(i - 1));
    return changes;
  }

  void close(const SplineEquations& equations) {
    // A second derivative m at the seam adds a multiple of `influence` to all others; the equation at
    // the seam then gives m.
    const std::size_t last = values_.size() - 1;
    const double first = knots_[1] - knots_[0];
    const double final = knots_[last] - knots_[last - 1];
    std::vector<double> ends(values_.size(), 0.0);
    ends[1] -= first;
    ends[last - 1] -= final;
    const std::vector<double> influence = equations.solve(std::move(ends));
    const Value slopeChange = 6.0 * (chordSlope(0) - chordSlope(last - 1));
    const Value m = (slopeChange - first * seconds_[1] - final * seconds_[last - 1]) /
                    (2.0 * (first + final) + first * influence[1] + final * influence[last - 1]);
    for (std::size_t i = 1; i < last; ++i) seconds_[i] += influence[i] * m;
    seconds_.front() = m;
    seconds_.back() = m;
  }

  std::vector<double> knots_;
  std::vector<Value> values_;
  std::vector<Value> seconds_;
};

}  // namespace tetrafront
