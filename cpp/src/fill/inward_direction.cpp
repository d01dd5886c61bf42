#include "fill/inward_direction.h"

#include <cmath>

namespace tetrafront {
namespace {

/// Maximum number of digits, in units of 53 bits. One unit suffices unless the planes are nearly
/// folded onto each other.
constexpr int kMaxTruncations = 8;

Vec3 unitNormal(const ExactPoints& points, const NodeTriple& t) {
  const Vec3& a = points.position(t[0]);
  const Vec3 n = glm::cross(points.position(t[1]) - a, points.position(t[2]) - a);
  const double length = std::sqrt(glm::dot(n, n));
  return length > 0.0 ? n * (1.0 / length) : n;
}

DyadicVec3 exactNormal(const ExactPoints& points, const NodeTriple& t) {
  const DyadicVec3 a = points.exact(t[0]);
  return cross(points.exact(t[1]) - a, points.exact(t[2]) - a);
}

/// Returns the leading `steps` x 53 bits.
Dyadic truncated(const Dyadic& value, int steps) {
  Dyadic result;
  Dyadic rest = value;
  for (int i = 0; i < steps && rest.sign() != 0; ++i) {
    const Dyadic part(rest.toDouble());
    result = result + part;
    rest = rest - part;
  }
  return result;
}

}  // namespace

Vec3 inwardDirection(const ExactPoints& points, std::span<const NodeTriple> planes) {
  Vec3 sum(0.0);
  for (const auto& plane : planes) sum += unitNormal(points, plane);
  const double length = std::sqrt(glm::dot(sum, sum));
  return length > 0.0 ? sum * (1.0 / length) : sum;
}

std::optional<DyadicVec3> exactInwardDirection(const ExactPoints& points,
                                               std::span<const NodeTriple> planes) {
  const DyadicVec3 first = exactNormal(points, planes.front());
  const DyadicVec3 last = exactNormal(points, planes.back());
  const auto leadsIn = [&](const DyadicVec3& d) {
    return dot(first, d).sign() > 0 && dot(last, d).sign() > 0;
  };
  DyadicVec3 plain = toDyadic(inwardDirection(points, planes));
  if (leadsIn(plain)) return plain;
  // For normals n, m with n.m = -c < 0, the vector (m.m + c) n + (n.n + c) m has the product
  // (n.n)(m.m) - c^2 > 0 with each.
  const Dyadic c = dot(first, last).negated();
  const DyadicVec3 direction = first * (dot(last, last) + c) + last * (dot(first, first) + c);
  for (int steps = 1; steps <= kMaxTruncations; ++steps) {
    DyadicVec3 shorter{truncated(direction[0], steps), truncated(direction[1], steps),
                       truncated(direction[2], steps)};
    if (leadsIn(shorter)) return shorter;
  }
  return {};
}

}  // namespace tetrafront
