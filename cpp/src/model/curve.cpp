// Lines as functions of a parameter. Only + - * / sqrt are used, so that every platform places the
// same nodes. The spline's second derivatives solve the usual tridiagonal system for a continuous
// slope (for example de Boor 1978), with natural ends; closed splines have no ends.

#include "model/curve.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/tolerance.h"

namespace tetrafront {

namespace {

/// Five-point Gauss-Legendre rule: abscissae and weights for [-1, 1].
constexpr std::array<double, 5> kGaussAbscissae{-0.9061798459386640, -0.5384693101056831, 0.0,
                                                0.5384693101056831, 0.9061798459386640};
constexpr std::array<double, 5> kGaussWeights{0.2369268850561891, 0.4786286704993665,
                                              0.5688888888888889, 0.4786286704993665,
                                              0.2369268850561891};
/// Pieces per smooth span for integrating the arc length: a parabola bent by 90 degrees is then
/// exact to about 1e-12.
constexpr int kPiecesPerSpan = 8;

}  // namespace

/// Equations that couple the second derivatives i - 1, i, i + 1 at the inner knots. They are
/// diagonally dominant, so elimination needs no pivoting.
class Curve::SplineEquations {
 public:
  explicit SplineEquations(std::span<const double> knots)
      : knots_(knots), pivots_(knots.size(), 1.0) {
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
      pivots_[i] = 2.0 * (step(i - 1) + step(i)) - (i > 1 ? step(i - 1) * upper(i - 1) : 0.0);
  }

  /// Replaces right-hand sides at the inner knots by solutions; those at the ends are zero.
  template <class Value>
  [[nodiscard]] std::vector<Value> solve(std::vector<Value> values) const {
    const std::size_t last = values.size() - 1;
    values.front() = Value(0.0);
    values.back() = Value(0.0);
    for (std::size_t i = 1; i < last; ++i)
      values[i] = (values[i] - step(i - 1) * values[i - 1]) / pivots_[i];
    for (std::size_t i = last - 1; i >= 1; --i) values[i] -= upper(i) * values[i + 1];
    return values;
  }

 private:
  [[nodiscard]] double step(std::size_t i) const { return knots_[i + 1] - knots_[i]; }
  [[nodiscard]] double upper(std::size_t i) const { return step(i) / pivots_[i]; }

  std::span<const double> knots_;
  std::vector<double> pivots_;
};

Curve::Curve(LineType type, std::vector<Vec3> points)
    : type_(type), points_(std::move(points)), flat_(points_) {
  if (type_ == LineType::kSpline)
    fitSpline();
  else
    knots_ = {0.0, 1.0};
  if (type_ == LineType::kArc) arc_ = CircularArc::through(points_[0], points_[1], points_[2]);
  if (type_ == LineType::kCircle)
    arc_ = CircularArc::circleThrough(points_[0], points_[1], points_[2]);
  length_ = length(0.0, 1.0);
}

bool Curve::isClosed() const { return points_.front() == points_.back(); }

void Curve::fitSpline() {
  const std::size_t count = points_.size();
  knots_.assign(count, 0.0);
  for (std::size_t i = 1; i < count; ++i)
    knots_[i] = knots_[i - 1] + glm::length(points_[i] - points_[i - 1]);
  const double total = knots_.back();
  for (double& knot : knots_) knot /= total;
  knots_.back() = 1.0;

  std::vector<Vec3> slopeChanges(count, Vec3(0.0));
  for (std::size_t i = 1; i + 1 < count; ++i)
    slopeChanges[i] = 6.0 * (chordSlope(i) - chordSlope(i - 1));
  const SplineEquations equations(knots_);
  secondDerivatives_ = equations.solve(std::move(slopeChanges));
  if (isClosed()) closeSpline(equations);
}

Vec3 Curve::chordSlope(std::size_t piece) const {
  return (points_[piece + 1] - points_[piece]) / (knots_[piece + 1] - knots_[piece]);
}

void Curve::closeSpline(const SplineEquations& equations) {
  // A second derivative m at the seam adds a multiple of `influence` to all others; the equation at
  // the seam then gives m.
  const std::size_t last = points_.size() - 1;
  const double first = knots_[1] - knots_[0];
  const double final = knots_[last] - knots_[last - 1];
  std::vector<double> ends(points_.size(), 0.0);
  ends[1] -= first;
  ends[last - 1] -= final;
  const std::vector<double> influence = equations.solve(std::move(ends));
  const Vec3 slopeChange = 6.0 * (chordSlope(0) - chordSlope(last - 1));
  const Vec3 m =
      (slopeChange - first * secondDerivatives_[1] - final * secondDerivatives_[last - 1]) /
      (2.0 * (first + final) + first * influence[1] + final * influence[last - 1]);
  for (std::size_t i = 1; i < last; ++i) secondDerivatives_[i] += influence[i] * m;
  secondDerivatives_.front() = m;
  secondDerivatives_.back() = m;
}

Curve::Sample Curve::sample(double t) const {
  Sample result = sampleByType(t);
  flat_.settle(result.position);
  flat_.settleDirection(result.derivative);
  return result;
}

Curve::Sample Curve::sampleByType(double t) const {
  switch (type_) {
    case LineType::kStraight:
      return {points_[0] + t * (points_[1] - points_[0]), points_[1] - points_[0]};
    case LineType::kParabolic:
      return sampleParabola(t);
    case LineType::kArc:
    case LineType::kCircle:
      return {arc_.position(t), arc_.derivative(t)};
    case LineType::kSpline:
      break;
  }
  return sampleSpline(t);
}

Curve::Sample Curve::sampleParabola(double t) const {
  // Lagrange polynomials through t = 0, 1/2, 1.
  const Vec3& a = points_[0];
  const Vec3& m = points_[1];
  const Vec3& b = points_[2];
  const double s = 1.0 - t;
  return {(s * (1.0 - 2.0 * t)) * a + (4.0 * t * s) * m + (t * (2.0 * t - 1.0)) * b,
          (4.0 * t - 3.0) * a + (4.0 - 8.0 * t) * m + (4.0 * t - 1.0) * b};
}

Curve::Sample Curve::sampleSpline(double t) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double step = knots_[i + 1] - knots_[i];
  const double a = (knots_[i + 1] - t) / step;
  const double b = (t - knots_[i]) / step;
  const Vec3& left = secondDerivatives_[i];
  const Vec3& right = secondDerivatives_[i + 1];
  const double weight = step * step / 6.0;
  Sample result;
  result.position = (a * points_[i] + b * points_[i + 1]) + (weight * (a * a * a - a)) * left +
                    (weight * (b * b * b - b)) * right;
  result.derivative = (points_[i + 1] - points_[i]) / step -
                      (step * (3.0 * a * a - 1.0) / 6.0) * left +
                      (step * (3.0 * b * b - 1.0) / 6.0) * right;
  return result;
}

Vec3 Curve::position(double t) const {
  if (t <= 0.0) return points_.front();
  if (t >= 1.0) return points_.back();
  return sample(t).position;
}

Vec3 Curve::derivative(double t) const { return sample(t).derivative; }

double Curve::length(double from, double to) const {
  if (type_ == LineType::kStraight) return (to - from) * glm::length(points_[1] - points_[0]);
  if (type_ == LineType::kArc || type_ == LineType::kCircle) return (to - from) * arc_.length();
  double sum = 0.0;
  for (std::size_t span = 0; span + 1 < knots_.size(); ++span) {
    const double begin = std::max(from, knots_[span]);
    const double end = std::min(to, knots_[span + 1]);
    if (begin >= end) continue;
    const double half = (end - begin) / (2.0 * kPiecesPerSpan);
    for (int piece = 0; piece < kPiecesPerSpan; ++piece) {
      const double middle = begin + (2.0 * piece + 1.0) * half;
      for (std::size_t k = 0; k < kGaussAbscissae.size(); ++k)
        sum +=
            half * kGaussWeights[k] * glm::length(derivative(middle + half * kGaussAbscissae[k]));
    }
  }
  return sum;
}

bool Curve::isStraight() const {
  const Vec3 chord = end() - start();
  const double squared = glm::dot(chord, chord);
  return std::ranges::all_of(points_,
                             [&](const Vec3& point) {
                               return glm::length(glm::cross(chord, point - start())) <=
                                      Tolerance::kCoincidence * squared;
                             }) &&
         squared > 0.0;
}

Curve::Sample OrientedCurve::sample(double t) const {
  if (!reversed_) return curve_->sample(t);
  const Curve::Sample along = curve_->sample(1.0 - t);
  return {along.position, -along.derivative};
}

}  // namespace tetrafront
