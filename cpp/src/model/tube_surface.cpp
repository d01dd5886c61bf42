#include "model/tube_surface.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tetrafront {

namespace {

/// Rulings whose lengths are summed, and offsets tried in each direction.
constexpr int kRulings = 64;
/// Sums that differ by less, relative to the larger, are equal: their rounding is about 1e-14.
constexpr double kEqualSums = 1e-9;
/// Halvings of the interval in which the best offset lies: to the last bit.
constexpr int kHalvings = 48;
/// An offset that matches two joints of lines up to this share of the rim is taken to match them: rounding, not a gap.
constexpr double kSameJoint = 1e-9;
/// Rulings for the mean length.
constexpr int kMeanRulings = 16;

std::vector<Vec3> positionsOf(const Rim& rim) {
  std::vector<Vec3> positions;
  for (int i = 0; i < kRulings; ++i)
    positions.push_back(rim.position(static_cast<double>(i) / kRulings));
  return positions;
}

class RimMatcher {
 public:
  RimMatcher(const Rim& first, const Rim& second)
      : first_(&first),
        second_(&second),
        positions_(positionsOf(first)),
        others_(positionsOf(second)) {}

  RimMatch run() {
    RimMatch best;
    double least = std::numeric_limits<double>::infinity();
    for (const bool isReversed : {false, true}) {
      for (int step = 0; step < kRulings; ++step) {
        const double sum = sumOfSquares(isReversed, step);
        if (!(sum < least * (1.0 - kEqualSums))) continue;
        least = sum;
        best = {isReversed, static_cast<double>(step) / kRulings};
      }
    }
    best.offset = matchJoints(best.isReversed, refined(best));
    return best;
  }

 private:
  static double directionOf(bool isReversed) { return isReversed ? -1.0 : 1.0; }

  [[nodiscard]] double sumOfSquares(bool isReversed, int step) const {
    double sum = 0.0;
    for (int i = 0; i < kRulings; ++i) {
      const int other = (step + (isReversed ? kRulings - i : i)) % kRulings;
      const Vec3 ruling =
          others_[static_cast<std::size_t>(other)] - positions_[static_cast<std::size_t>(i)];
      sum += glm::dot(ruling, ruling);
    }
    return sum;
  }

  /// Half the derivative of the sum with respect to the offset.
  [[nodiscard]] double slopeAt(bool isReversed, double offset) const {
    double sum = 0.0;
    for (int i = 0; i < kRulings; ++i) {
      const double part = static_cast<double>(i) / kRulings;
      const Curve::Sample other = second_->sample(offset + directionOf(isReversed) * part);
      sum += glm::dot(other.position - positions_[static_cast<std::size_t>(i)], other.derivative);
    }
    return sum;
  }

  [[nodiscard]] double refined(const RimMatch& match) const {
    double low = match.offset - 1.0 / kRulings;
    double high = match.offset + 1.0 / kRulings;
    if (!(slopeAt(match.isReversed, low) < 0.0) || !(slopeAt(match.isReversed, high) > 0.0))
      return match.offset;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      (slopeAt(match.isReversed, middle) < 0.0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Returns the offset that matches two joints exactly if `offset` does so up to rounding.
  [[nodiscard]] double matchJoints(bool isReversed, double offset) const {
    for (const double joint : first_->starts()) {
      for (const double other : second_->starts()) {
        const double exact = other - directionOf(isReversed) * joint;
        const double difference = wrapped(exact - offset + 0.5) - 0.5;
        if (std::fabs(difference) <= kSameJoint) return wrapped(exact);
      }
    }
    return wrapped(offset);
  }

  const Rim* first_;
  const Rim* second_;
  std::vector<Vec3> positions_;
  std::vector<Vec3> others_;
};

}  // namespace

RimMatch matchRims(const Rim& first, const Rim& second) { return RimMatcher(first, second).run(); }

TubeSurface::TubeSurface(Rim first, Rim second)
    : first_(std::move(first)), second_(std::move(second)), match_(matchRims(first_, second_)) {
  for (std::size_t i = 0; i < first_.starts().size(); ++i) {
    for (std::size_t j = 0; j < second_.starts().size(); ++j) {
      const double xi = first_.starts()[i];
      const double difference = wrapped(xiOfSecond(second_.starts()[j]) - xi + 0.5) - 0.5;
      const bool isCorner = first_.hasCornerAt(i) || second_.hasCornerAt(j);
      if (isCorner && std::fabs(difference) <= kSameJoint) creases_.push_back(xi);
    }
  }
}

SurfacePoint TubeSurface::evaluate(const Vec2& unit) const {
  const Curve::Sample from = first_.sample(unit.x);
  const Curve::Sample to = second_.sample(match_.offset + direction() * unit.x);
  const double eta = unit.y;
  const double rest = 1.0 - eta;
  return {rest * from.position + eta * to.position,
          rest * from.derivative + (eta * direction()) * to.derivative,
          to.position - from.position};
}

double TubeSurface::xiOfSecond(double part) const {
  return wrapped(direction() * (part - match_.offset));
}

double TubeSurface::meanRuling() const {
  double sum = 0.0;
  for (int i = 0; i < kMeanRulings; ++i)
    sum += glm::length(evaluate({static_cast<double>(i) / kMeanRulings, 0.0}).alongEta);
  return sum / kMeanRulings;
}

}  // namespace tetrafront
