#pragma once

/// @file Parts of a triangle, for proofs that hold for every point of it.

#include <algorithm>
#include <array>
#include <cstddef>

#include "tetrafront/vec3.h"
#include "topology/surface_access.h"

namespace tetrafront {

using TriangleCorners = std::array<Vec3, 3>;

/// Returns the normal, twice as long as the area.
[[nodiscard]] inline Vec3 crossOf(const TriangleCorners& corners) {
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
}

/// Returns the cosine of the smallest angle, which is at most 60 degrees.
[[nodiscard]] inline double largestCosineOf(const TriangleCorners& corners) {
  double largest = 0.5;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 u = corners[(k + 1) % 3] - corners[k];
    const Vec3 v = corners[(k + 2) % 3] - corners[k];
    largest = std::max(largest, glm::dot(u, v) / (glm::length(u) * glm::length(v)));
  }
  return largest;
}

/// Divides a triangle at the middle of its longest edge.
[[nodiscard]] inline std::array<TriangleCorners, 2> halvesOf(const TriangleCorners& corners) {
  const std::size_t k = longestEdgeOf(corners);
  const Vec3& a = corners[k];
  const Vec3& b = corners[(k + 1) % 3];
  const Vec3& c = corners[(k + 2) % 3];
  const Vec3 middle = 0.5 * (a + b);
  return {{{a, middle, c}, {middle, b, c}}};
}

/// A plane through an edge.
struct Cut {
  Vec3 origin;
  Vec3 outward;  ///< unit normal

  [[nodiscard]] std::array<double, 3> depthsOf(const TriangleCorners& corners) const {
    return {glm::dot(corners[0] - origin, outward), glm::dot(corners[1] - origin, outward),
            glm::dot(corners[2] - origin, outward)};
  }
};

/// Divides a triangle by a plane that has corners on both sides. The first part is alone on its side.
[[nodiscard]] inline std::array<TriangleCorners, 3> divide(const TriangleCorners& corners,
                                                           const Cut& cut) {
  const std::array<double, 3> depth = cut.depthsOf(corners);
  std::size_t k = 0;
  while ((depth[k] > 0.0) == (depth[(k + 1) % 3] > 0.0) ||
         (depth[k] > 0.0) == (depth[(k + 2) % 3] > 0.0))
    ++k;
  const Vec3& a = corners[k];
  const Vec3& b = corners[(k + 1) % 3];
  const Vec3& c = corners[(k + 2) % 3];
  const Vec3 ab = a + (b - a) * (depth[k] / (depth[k] - depth[(k + 1) % 3]));
  const Vec3 ac = a + (c - a) * (depth[k] / (depth[k] - depth[(k + 2) % 3]));
  return {{{a, ab, ac}, {ab, b, c}, {ab, c, ac}}};
}

}  // namespace tetrafront
