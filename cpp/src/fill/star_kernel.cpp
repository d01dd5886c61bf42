#include "fill/star_kernel.h"

#include <cmath>
#include <limits>

namespace tetrafront {

void StarKernel::add(const ExactPoints& points, const NodeTriple& innerFace) {
  const auto& n = innerFace;
  const Vec3& a = points.position(n[0]);
  const Vec3& b = points.position(n[1]);
  const Vec3& c = points.position(n[2]);
  const Vec3 normal = glm::cross(b - a, c - a);
  const double length = std::sqrt(glm::dot(normal, normal));
  if (!(length > 0.0)) return;
  planes_.push_back({normal * (1.0 / length), a, (a + b + c) * (1.0 / 3.0), std::sqrt(length)});
}

double StarKernel::depth(const Vec3& p, std::size_t& worst) const {
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const double d = glm::dot(planes_[i].normal, p - planes_[i].position);
    if (d >= smallest) continue;
    smallest = d;
    worst = i;
  }
  return smallest;
}

Vec3 StarKernel::middle() const {
  Vec3 sum(0.0);
  double weight = 0.0;
  for (const Plane& plane : planes_) {
    sum += plane.centroid * plane.size;
    weight += plane.size;
  }
  return weight > 0.0 ? sum * (1.0 / weight) : sum;
}

Vec3 StarKernel::deepest(const Vec3& start) const {
  constexpr int kSteps = 300;
  constexpr double kFirstStep = 0.5;  // of the mean size
  constexpr double kShrink = 0.95;
  if (planes_.empty()) return start;
  double step = 0.0;
  for (const Plane& plane : planes_) step += plane.size;
  step *= kFirstStep / static_cast<double>(planes_.size());
  Vec3 current = start;
  Vec3 best = start;
  std::size_t worst = 0;
  double bestDepth = depth(current, worst);
  for (int i = 0; i < kSteps; ++i, step *= kShrink) {
    current += planes_[worst].normal * step;
    const double there = depth(current, worst);
    if (there <= bestDepth) continue;
    bestDepth = there;
    best = current;
  }
  return best;
}

}  // namespace tetrafront
