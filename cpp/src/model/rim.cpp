#include "model/rim.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetrafront {

namespace {

/// Cosine of 2 degrees: lines at a larger angle form a corner.
constexpr double kMinSmoothCosine = 0.99939082701909573;

}  // namespace

double wrapped(double part) {
  const double fraction = part - std::floor(part);
  // A tiny negative number is rounded up to 1.
  return fraction < 1.0 ? fraction : 0.0;
}

Rim::Rim(std::vector<OrientedCurve> curves) : curves_(std::move(curves)) {
  for (const OrientedCurve& curve : curves_) {
    starts_.push_back(length_);
    length_ += curve.length();
  }
  for (double& start : starts_) start /= length_;
}

Curve::Sample Rim::sample(double part) const {
  const double at = wrapped(part);
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end(), at);
  const auto index = static_cast<std::size_t>(after - starts_.begin()) - 1;
  const double width = endOf(index) - starts_[index];
  Curve::Sample sample = curves_[index].sample((at - starts_[index]) / width);
  sample.derivative /= width;
  return sample;
}

bool Rim::hasCornerAt(std::size_t index) const {
  const OrientedCurve& before = curves_[(index + curves_.size() - 1) % curves_.size()];
  const Vec3 incoming = before.sample(1.0).derivative;
  const Vec3 outgoing = curves_[index].sample(0.0).derivative;
  const double lengths = glm::length(incoming) * glm::length(outgoing);
  return glm::dot(incoming, outgoing) < kMinSmoothCosine * lengths;
}

double Rim::partAt(std::size_t index, double t) const {
  return starts_[index] + t * (endOf(index) - starts_[index]);
}

}  // namespace tetrafront
