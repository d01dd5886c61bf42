#include "geom/measure.h"

#include <algorithm>
#include <limits>

namespace tetrafront {
namespace {

using Triangle = std::array<Vec3, 3>;

/// Returns the point of segment p q at the parameter part / whole, clamped to the segment; p if
/// the parameter is not a number.
Vec3 partWay(const Vec3& p, const Vec3& q, double part, double whole) {
  const double t = part / whole;
  return t > 0.0 ? p + (q - p) * std::min(t, 1.0) : p;
}

Vec3 crossingOfPlane(const Vec3& p, const Vec3& q, const Triangle& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  return partWay(p, q, glm::dot(t[0] - p, normal), glm::dot(q - p, normal));
}

Vec3 crossingOfLine(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const Vec3 across = glm::cross(q - p, b - a);
  return partWay(p, q, glm::dot(glm::cross(a - p, b - a), across), glm::dot(across, across));
}

/// Collects candidate points and keeps those that are in both triangles.
class CommonPoints {
 public:
  CommonPoints(const Triangle& a, const Triangle& b) : a_(a), b_(b) {
    double square = 0.0;
    for (const Triangle& t : {a, b}) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = t[(k + 1) % 3] - t[k];
        square = std::max(square, glm::dot(side, side));
      }
    }
    near_ = kSharedDistance * kSharedDistance * square;
  }

  void add(const Vec3& p) {
    const double apart = std::max(squaredDistanceToTriangle(p, a_[0], a_[1], a_[2]),
                                  squaredDistanceToTriangle(p, b_[0], b_[1], b_[2]));
    if (apart < least_) {
      least_ = apart;
      nearest_ = p;
    }
    if (!(apart <= near_)) return;
    sum_ += p;
    count_ += 1.0;
  }

  [[nodiscard]] Vec3 mean() const { return count_ > 0.0 ? sum_ / count_ : nearest_; }

 private:
  /// A point this close to both triangles, relative to their longest edge, counts as shared. The
  /// points result from divisions by small angles, which cost some of the 16 digits. This only
  /// chooses the position of a marker, not topology.
  static constexpr double kSharedDistance = 1e-10;
  const Triangle& a_;
  const Triangle& b_;
  double near_;
  double least_ = std::numeric_limits<double>::infinity();
  Vec3 nearest_{0.0};
  Vec3 sum_{0.0};
  double count_ = 0.0;
};

}  // namespace

Vec3 nearestPointOfSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  return partWay(a, b, glm::dot(p - a, ab), glm::dot(ab, ab));
}

Vec3 nearestPointOfTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const bool beyondAb = glm::dot(glm::cross(b - a, p - a), normal) < 0.0;
  const bool beyondBc = glm::dot(glm::cross(c - b, p - b), normal) < 0.0;
  const bool beyondCa = glm::dot(glm::cross(a - c, p - c), normal) < 0.0;
  if (square > 0.0 && !beyondAb && !beyondBc && !beyondCa) {
    return p - normal * (glm::dot(p - a, normal) / square);
  }
  const auto squaredLength = [](const Vec3& v) { return glm::dot(v, v); };
  Vec3 nearest = nearestPointOfSegment(p, a, b);
  for (const Vec3& other : {nearestPointOfSegment(p, b, c), nearestPointOfSegment(p, c, a)}) {
    if (squaredLength(other - p) < squaredLength(nearest - p)) nearest = other;
  }
  return nearest;
}

double longestEdgeLengthOf(const std::array<Vec3, 3>& corners) {
  const auto [a, b, c] = corners;
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

Vec3 intersectionPosition(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  CommonPoints common(a, b);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    common.add(a[i]);
    common.add(b[i]);
    common.add(crossingOfPlane(a[i], a[j], b));
    common.add(crossingOfPlane(b[i], b[j], a));
    for (std::size_t k = 0; k < 3; ++k)
      common.add(crossingOfLine(a[i], a[j], b[k], b[(k + 1) % 3]));
  }
  return common.mean();
}

}  // namespace tetrafront
