#include "model/edge_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/sine.h"

namespace tetrafront {

namespace {

/// Gauss-Legendre quadrature with four nodes.
constexpr std::array<double, 2> kQuadratureNodes{0.33998104358485626, 0.86113631159405258};
constexpr std::array<double, 2> kQuadratureWeights{0.65214515486254614, 0.34785484513745386};
/// Pieces between two knots over which lengths and angles are summed.
constexpr int kPieces = 8;

}  // namespace

EdgeCurve::EdgeCurve(const TrimmedModel& model, const TrimmedEdge& edge)
    : curve_(&model.curves[*edge.curve]),
      first_(edge.first),
      last_(edge.last),
      start_(model.vertices[edge.start]),
      end_(model.vertices[edge.end]) {
  knots_.push_back(0.0);
  for (const double knot : knotsBetween(*curve_, first_, last_)) {
    const double t = (knot - first_) / (last_ - first_);
    if (t > knots_.back() && t < 1.0) knots_.push_back(t);
  }
  knots_.push_back(1.0);
}

Vec3 EdgeCurve::position(double t) const {
  if (!(t > 0.0)) return start_;
  if (!(t < 1.0)) return end_;
  return evaluate(*curve_, parameterAt(t)).position;
}

EdgeCurve::Sample EdgeCurve::sample(double t) const {
  return {position(t), (last_ - first_) * evaluate(*curve_, parameterAt(t)).first};
}

double EdgeCurve::length(double from, double to) const {
  double sum = 0.0;
  const auto integrate = [&](double low, double high) {
    const double half = 0.5 * (high - low) / kPieces;
    for (int piece = 0; piece < kPieces; ++piece) {
      const double middle = low + (2 * piece + 1) * half;
      for (std::size_t i = 0; i < kQuadratureNodes.size(); ++i)
        sum += half * kQuadratureWeights[i] *
               (glm::length(derivative(middle - half * kQuadratureNodes[i])) +
                glm::length(derivative(middle + half * kQuadratureNodes[i])));
    }
  };
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const double low = std::max(from, knots_[i]);
    const double high = std::min(to, knots_[i + 1]);
    if (high > low) integrate(low, high);
  }
  return sum;
}

double EdgeCurve::turning() const {
  double sum = 0.0;
  Vec3 before = derivative(0.0);
  const auto turnTo = [&](double t) {
    const Vec3 next = derivative(t);
    const double sine = glm::length(glm::cross(before, next));
    const double cosine = glm::dot(before, next);
    if (sine > 0.0 || cosine < 0.0) sum += angleOf({cosine, sine});
    before = next;
  };
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
    for (int piece = 1; piece <= kPieces; ++piece)
      turnTo(knots_[i] + (knots_[i + 1] - knots_[i]) * piece / kPieces);
  return sum;
}

}  // namespace tetrafront
