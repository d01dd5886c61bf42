#include "model/hermite_cubics.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

HermiteCubics::HermiteCubics(std::vector<double> knots, std::vector<Vec3> points,
                             const std::optional<Vec3>& startSlope,
                             const std::optional<Vec3>& endSlope)
    : knots_(std::move(knots)), points_(std::move(points)), slopes_(points_.size(), Vec3(0.0)) {
  const std::size_t last = points_.size() - 1;
  for (std::size_t i = 1; i < last; ++i)
    slopes_[i] = besselSlope(chordSlope(i - 1), step(i - 1), chordSlope(i), step(i));
  if (points_.front() == points_.back()) {
    slopes_.front() = besselSlope(chordSlope(last - 1), step(last - 1), chordSlope(0), step(0));
    slopes_.back() = slopes_.front();
    return;
  }
  // Both ends of a single piece without slopes: a straight line.
  if (last == 1) slopes_ = {chordSlope(0), chordSlope(0)};
  if (startSlope) slopes_.front() = *startSlope;
  if (endSlope) slopes_.back() = *endSlope;
  if (!startSlope) slopes_.front() = 0.5 * (3.0 * chordSlope(0) - slopes_[1]);
  if (!endSlope) slopes_.back() = 0.5 * (3.0 * chordSlope(last - 1) - slopes_[last - 1]);
}

HermiteCubics::Sample HermiteCubics::sample(double t) const {
  const auto above = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - knots_.begin()) - 1;
  const double length = step(i);
  const double local = (t - knots_[i]) / length;
  const auto blend = [&](const HermiteBasis& basis) {
    return (basis.start * points_[i] + basis.end * points_[i + 1]) +
           length * (basis.startSlope * slopes_[i] + basis.endSlope * slopes_[i + 1]);
  };
  return {blend(HermiteBasis::at(local)), blend(HermiteBasis::derivativeAt(local)) / length,
          blend(HermiteBasis::secondDerivativeAt(local)) / (length * length)};
}

}  // namespace tetrafront
