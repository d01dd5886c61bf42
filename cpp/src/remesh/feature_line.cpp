#include "remesh/feature_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geom/measure.h"

namespace tetrafront {

FeatureLine::FeatureLine(std::vector<NodeId> nodes, std::vector<Vec3> points, bool isClosed)
    : nodes_(std::move(nodes)), points_(std::move(points)), isClosed_(isClosed) {
  arcs_.reserve(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    arcs_.push_back(i == 0 ? 0.0 : arcs_.back() + glm::length(points_[i] - points_[i - 1]));
  }
}

Vec3 FeatureLine::at(double arc) const {
  if (isClosed_) arc -= std::floor(arc / length()) * length();
  arc = std::clamp(arc, 0.0, length());
  const auto above = std::upper_bound(arcs_.begin(), arcs_.end(), arc) - arcs_.begin();
  const auto last = static_cast<std::ptrdiff_t>(arcs_.size()) - 1;
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, last));
  const double part = (arc - arcs_[i - 1]) / (arcs_[i] - arcs_[i - 1]);
  if (part <= 0.0) return points_[i - 1];
  return part >= 1.0 ? points_[i] : points_[i - 1] + (points_[i] - points_[i - 1]) * part;
}

Vec3 FeatureLine::centroidFrom(const Vec3& origin, double from, double to) const {
  Vec3 sum(0.0);
  Vec3 last = at(from) - origin;
  double arc = from;
  const auto add = [&](double next, const Vec3& point) {
    sum += (last + point) * (0.5 * (next - arc));
    last = point;
    arc = next;
  };
  // On a closed line, an arc may pass the first point once.
  const double end = isClosed_ ? length() : 0.0;
  for (double shift = 0.0; shift <= end; shift += length()) {
    auto i = std::upper_bound(arcs_.begin(), arcs_.end(), from - shift) - arcs_.begin();
    for (; i < std::ssize(arcs_) && arcs_[i] < to - shift; ++i) {
      add(arcs_[i] + shift, points_[i] - origin);
    }
  }
  add(to, at(to) - origin);
  return sum / (to - from);
}

double FeatureLine::squaredDeviation(double from, double to, const Vec3& a, const Vec3& b) const {
  double largest =
      std::max(squaredDistanceToSegment(at(from), a, b), squaredDistanceToSegment(at(to), a, b));
  // On a closed line, an arc may pass the first point once.
  const double end = isClosed_ ? length() : 0.0;
  for (double shift = 0.0; shift <= end; shift += length()) {
    auto i = std::upper_bound(arcs_.begin(), arcs_.end(), from - shift) - arcs_.begin();
    for (; i < std::ssize(arcs_) && arcs_[i] < to - shift; ++i) {
      largest = std::max(largest, squaredDistanceToSegment(points_[i], a, b));
    }
  }
  return largest;
}

bool sharePatch(const FeatureLine& a, const FeatureLine& b) {
  return std::ranges::any_of(a.patches, [&](std::uint32_t patch) {
    return std::ranges::find(b.patches, patch) != b.patches.end();
  });
}

}  // namespace tetrafront
