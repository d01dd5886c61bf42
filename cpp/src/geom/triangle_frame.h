#pragma once

/// @file What the distance to a triangle needs, computed once for triangles whose distance is measured very often.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "geom/measure.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

class TriangleFrame {
 public:
  /// Squared distance of a position, and the edges beyond which its projection lies: bit k for the edge from corner k to
  /// corner k + 1. All three if the triangle is too thin to tell.
  struct Distance {
    double squared = 0.0;
    std::uint32_t beyond = 0;
  };

  TriangleFrame() = default;
  explicit TriangleFrame(const std::array<Vec3, 3>& corners);

  [[nodiscard]] Distance measure(const Vec3& position) const;
  [[nodiscard]] double squaredDistance(const Vec3& position) const {
    return measure(position).squared;
  }
  /// Returns the point of the triangle nearest to a position whose distance was measured.
  [[nodiscard]] Vec3 nearestPoint(const Vec3& position, const Distance& distance) const {
    if (distance.beyond == 0) return position - normal_ * glm::dot(position - origin_, normal_);
    return nearestPointOfTriangle(position, origin_, origin_ + ab_, origin_ + ac_);
  }

 private:
  /// Squared height / longest edge below which barycentric coordinates lose too many digits.
  static constexpr double kThinnest = 1e-8;

  /// Returns the squared length of `offset` minus its projection onto the segment from 0 to `edge`.
  static double squaredRest(const Vec3& offset, const Vec3& edge, double along,
                            double inverseSquare) {
    const Vec3 rest = offset - edge * std::clamp(along * inverseSquare, 0.0, 1.0);
    return glm::dot(rest, rest);
  }

  Vec3 origin_{0.0};  ///< first corner
  Vec3 ab_{0.0};
  Vec3 ac_{0.0};
  Vec3 normal_{0.0};  ///< unit normal
  double abab_ = 0.0;
  double abac_ = 0.0;
  double acac_ = 0.0;
  double inverse_ =
      0.0;  ///< 1 / squared length of the cross product; 0 if the triangle is too thin to be measured so
  double inverseAb_ = 0.0;  ///< 1 / squared length
  double inverseBc_ = 0.0;
  double inverseAc_ = 0.0;
};

inline TriangleFrame::TriangleFrame(const std::array<Vec3, 3>& corners)
    : origin_(corners[0]),
      ab_(corners[1] - corners[0]),
      ac_(corners[2] - corners[0]),
      abab_(glm::dot(ab_, ab_)),
      abac_(glm::dot(ab_, ac_)),
      acac_(glm::dot(ac_, ac_)) {
  const Vec3 bc = ac_ - ab_;
  const double bcbc = glm::dot(bc, bc);
  const Vec3 normal = glm::cross(ab_, ac_);
  const double square = glm::dot(normal, normal);
  const double longest = std::max({abab_, acac_, bcbc});
  if (!(square > kThinnest * longest * longest)) return;
  normal_ = normal / glm::length(normal);
  inverse_ = 1.0 / square;
  inverseAb_ = 1.0 / abab_;
  inverseBc_ = 1.0 / bcbc;
  inverseAc_ = 1.0 / acac_;
}

inline TriangleFrame::Distance TriangleFrame::measure(const Vec3& position) const {
  if (inverse_ == 0.0) {
    return {squaredDistanceToTriangle(position, origin_, origin_ + ab_, origin_ + ac_), 7U};
  }
  const Vec3 offset = position - origin_;
  const double alongAb = glm::dot(offset, ab_);
  const double alongAc = glm::dot(offset, ac_);
  // Barycentric coordinates of b and c.
  const double v = (acac_ * alongAb - abac_ * alongAc) * inverse_;
  const double w = (abab_ * alongAc - abac_ * alongAb) * inverse_;
  if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) {
    const double height = glm::dot(offset, normal_);
    return {height * height, 0};
  }
  Distance distance{std::numeric_limits<double>::infinity(), 0};
  if (w < 0.0) {
    distance.squared = squaredRest(offset, ab_, alongAb, inverseAb_);
    distance.beyond |= 1U;
  }
  if (v < 0.0) {
    distance.squared = std::min(distance.squared, squaredRest(offset, ac_, alongAc, inverseAc_));
    distance.beyond |= 4U;
  }
  if (v + w > 1.0) {
    const Vec3 fromB = offset - ab_;
    const Vec3 bc = ac_ - ab_;
    distance.squared =
        std::min(distance.squared, squaredRest(fromB, bc, glm::dot(fromB, bc), inverseBc_));
    distance.beyond |= 2U;
  }
  return distance;
}

}  // namespace tetrafront
