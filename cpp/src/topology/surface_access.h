#pragma once

/// @file Positions and triangles of a SurfaceMesh, beyond base/mesh_access.h.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/intersect.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/mesh_access.h"

namespace tetrafront {

/// Returns the positions of all nodes.
inline std::vector<Vec3> pointsOf(const SurfaceMesh& mesh) {
  std::vector<Vec3> points(countNodes(mesh));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = pointOf(mesh, NodeId(i));
  return points;
}

/// An axis-parallel box.
struct Bounds {
  Vec3 low{0.0};
  Vec3 high{0.0};
};

/// Returns the box around the triangles, of which there must be one.
inline Bounds boundsOf(const SurfaceMesh& mesh) {
  const Vec3 first = pointOf(mesh, NodeId(mesh.triangles[0]));
  Bounds bounds{first, first};
  for (const std::uint32_t node : mesh.triangles) {
    bounds.low = glm::min(bounds.low, pointOf(mesh, NodeId(node)));
    bounds.high = glm::max(bounds.high, pointOf(mesh, NodeId(node)));
  }
  return bounds;
}

/// Returns the triangle as the intersection tests take it.
inline NumberedTriangle numberedTriangle(const SurfaceMesh& mesh, TriangleId triangle) {
  const auto [a, b, c] = nodesOf(mesh, triangle);
  return {{a.value, b.value, c.value}, {pointOf(mesh, a), pointOf(mesh, b), pointOf(mesh, c)}};
}

inline Vec3 centroidOf(const std::array<Vec3, 3>& corners) {
  return (corners[0] + corners[1] + corners[2]) / 3.0;
}

inline double areaOf(const std::array<Vec3, 3>& corners) {
  return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

/// Returns the corner k at the beginning of the longest edge.
inline std::uint32_t longestEdgeOf(const std::array<Vec3, 3>& corners) {
  std::uint32_t longest = 0;
  double most = -1.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    const double square = glm::dot(edge, edge);
    if (square > most) {
      most = square;
      longest = k;
    }
  }
  return longest;
}

}  // namespace tetrafront
