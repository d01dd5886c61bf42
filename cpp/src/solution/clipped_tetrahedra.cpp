#include "solution/clipped_tetrahedra.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "topology/tetrahedron.h"

namespace tetrafront {
namespace {

/// Returns the point of an edge where a function that is linear on it vanishes; `a` and `b` are its values at the ends,
/// of different sign.
Vec3 crossing(const Vec3& from, const Vec3& to, double a, double b) {
  return from + (a / (a - b)) * (to - from);
}

}  // namespace

ClippingPlanes::ClippingPlanes(const Corners& corners, const std::array<std::uint32_t, 4>& nodes) {
  for (std::size_t f = 0; f < 4; ++f) {
    auto [a, b, c] = kFaceCorners[f];
    if (nodes[a] > nodes[b]) std::swap(a, b);
    if (nodes[b] > nodes[c]) std::swap(b, c);
    if (nodes[a] > nodes[b]) std::swap(a, b);
    const Vec3 normal = glm::cross(corners[b] - corners[a], corners[c] - corners[a]);
    const bool isInward = glm::dot(normal, corners[f] - corners[a]) > 0.0;
    planes[f] = {corners[a], isInward ? normal : -normal};
  }
}

const std::vector<Corners>& TetrahedronClipper::clip(const Corners& tetrahedron,
                                                     const ClippingPlanes& planes) {
  pieces_.assign(1, tetrahedron);
  for (const ClippingPlanes::Plane& plane : planes.planes) {
    next_.clear();
    for (const Corners& piece : pieces_) clipOne(piece, plane);
    std::swap(pieces_, next_);
    if (pieces_.empty()) break;
  }
  return pieces_;
}

void TetrahedronClipper::clipOne(const Corners& tetrahedron, const ClippingPlanes::Plane& plane) {
  // Corners inside come first.
  Corners p{};
  std::array<double, 4> d{};
  std::size_t inside = 0;
  std::size_t outside = 4;
  for (const Vec3& corner : tetrahedron) {
    const double distance = glm::dot(plane.normal, corner - plane.origin);
    const std::size_t slot = distance > 0.0 ? inside++ : --outside;
    p[slot] = corner;
    d[slot] = distance;
  }
  const auto cut = [&](std::size_t i, std::size_t j) { return crossing(p[i], p[j], d[i], d[j]); };
  const auto addPrism = [&](const std::array<Vec3, 3>& from, const std::array<Vec3, 3>& to) {
    next_.push_back({from[0], from[1], from[2], to[0]});
    next_.push_back({from[1], from[2], to[0], to[1]});
    next_.push_back({from[2], to[0], to[1], to[2]});
  };
  if (inside == 4) next_.push_back(tetrahedron);
  if (inside == 1) next_.push_back({p[0], cut(0, 1), cut(0, 2), cut(0, 3)});
  if (inside == 2) addPrism({p[0], cut(0, 2), cut(0, 3)}, {p[1], cut(1, 2), cut(1, 3)});
  if (inside == 3) addPrism({p[0], p[1], p[2]}, {cut(0, 3), cut(1, 3), cut(2, 3)});
}

double volumeWithin(const Corners& p) {
  return std::fabs(glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0])) / 6.0;
}

}  // namespace tetrafront
