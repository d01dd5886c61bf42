// Lines as functions of a parameter. Only + - * / sqrt are used, so that every platform places the
// same nodes.

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

Curve::Curve(LineType type, std::vector<Vec3> points, const EndTangents& tangents)
    : type_(type), points_(std::move(points)), tangents_(tangents), flat_(points_) {
  for (const std::optional<Vec3>& tangent : {tangents.start, tangents.end})
    if (tangent) flat_.restrictToDirection(*tangent);
  if (type_ == LineType::kSpline) {
    fitSpline();
  } else if (type_ == LineType::kHermite) {
    fitKnots();
    hermite_ = HermiteCubics(knots_, points_, endSlope(tangents_.start), endSlope(tangents_.end));
  } else {
    knots_ = {0.0, 1.0};
  }
  if (type_ == LineType::kArc) arc_ = CircularArc::through(points_[0], points_[1], points_[2]);
  if (type_ == LineType::kCircle)
    arc_ = CircularArc::circleThrough(points_[0], points_[1], points_[2]);
  length_ = length(0.0, 1.0);
}

bool Curve::isClosed() const { return points_.front() == points_.back(); }

void Curve::fitKnots() {
  const std::size_t count = points_.size();
  knots_.assign(count, 0.0);
  for (std::size_t i = 1; i < count; ++i)
    knots_[i] = knots_[i - 1] + glm::length(points_[i] - points_[i - 1]);
  chords_ = knots_.back();
  for (double& knot : knots_) knot /= chords_;
  knots_.back() = 1.0;
}

void Curve::fitSpline() {
  fitKnots();
  spline_ = isClosed() ? CubicSpline<Vec3>::closed(knots_, points_)
                       : CubicSpline<Vec3>(knots_, points_, endSlope(tangents_.start),
                                           endSlope(tangents_.end));
}

std::optional<Vec3> Curve::endSlope(const std::optional<Vec3>& tangent) const {
  // The derivative with respect to the length of the chords has the length 1.
  if (!tangent) return std::nullopt;
  return chords_ * *tangent;
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
    case LineType::kHermite: {
      const HermiteCubics::Sample sample = hermite_.sample(t);
      return {sample.value, sample.first};
    }
    case LineType::kSpline:
      break;
  }
  const CubicSpline<Vec3>::Sample sample = spline_.sample(t);
  return {sample.value, sample.first};
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

double Curve::parameterOfPoint(std::size_t index) const {
  switch (type_) {
    case LineType::kParabolic:
      return 0.5 * static_cast<double>(index);
    case LineType::kArc:
    case LineType::kCircle:
      // The ends of a circle are one point, of which both ends of the angle are parameters.
      if (index + 1 == points_.size()) return 1.0;
      return arc_.parameterOf(points_[index]);
    case LineType::kStraight:
    case LineType::kSpline:
    case LineType::kHermite:
      break;
  }
  return knots_[index];
}

Vec3 Curve::secondDerivative(double t) const {
  Vec3 result(0.0);
  switch (type_) {
    case LineType::kStraight:
      break;
    case LineType::kParabolic:
      result = 4.0 * points_[0] - 8.0 * points_[1] + 4.0 * points_[2];
      break;
    case LineType::kArc:
    case LineType::kCircle:
      result = arc_.secondDerivative(t);
      break;
    case LineType::kSpline:
      result = spline_.sample(t).second;
      break;
    case LineType::kHermite:
      result = hermite_.sample(t).second;
      break;
  }
  flat_.settleDirection(result);
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
  const auto isAlong = [&](const Vec3& direction, double limit) {
    return glm::length(glm::cross(chord, direction)) <= Tolerance::kCoincidence * limit;
  };
  for (const std::optional<Vec3>& tangent : {tangents_.start, tangents_.end})
    if (tangent && !isAlong(*tangent, glm::length(chord))) return false;
  return std::ranges::all_of(
             points_, [&](const Vec3& point) { return isAlong(point - start(), squared); }) &&
         squared > 0.0;
}

Curve::Sample OrientedCurve::sample(double t) const {
  if (!reversed_) return curve_->sample(t);
  const Curve::Sample along = curve_->sample(1.0 - t);
  return {along.position, -along.derivative};
}

}  // namespace tetrafront
