#include "geom/measure.h"

#include <algorithm>

namespace tetrafront {

double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const Vec3 ap = p - a;
  const double square = glm::dot(ab, ab);
  const double t = square > 0.0 ? std::clamp(glm::dot(ap, ab) / square, 0.0, 1.0) : 0.0;
  const Vec3 rest = ap - ab * t;
  return glm::dot(rest, rest);
}

double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const bool above = square > 0.0 && glm::dot(glm::cross(b - a, p - a), normal) >= 0.0 &&
                     glm::dot(glm::cross(c - b, p - b), normal) >= 0.0 &&
                     glm::dot(glm::cross(a - c, p - c), normal) >= 0.0;
  if (above) {
    const double height = glm::dot(p - a, normal);
    return height * height / square;
  }
  return std::min(squaredDistanceToSegment(p, a, b),
                  std::min(squaredDistanceToSegment(p, b, c), squaredDistanceToSegment(p, c, a)));
}

}  // namespace tetrafront
