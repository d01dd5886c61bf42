#pragma once

/// @file Typed access to the flat arrays of a SurfaceMesh.

#include <array>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "geom/intersect.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

inline std::uint32_t countNodes(const SurfaceMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.points.size() / 3);
}

inline std::uint32_t countTriangles(const SurfaceMesh& mesh) {
  return static_cast<std::uint32_t>(mesh.triangles.size() / 3);
}

inline Vec3 pointOf(const SurfaceMesh& mesh, NodeId node) {
  const std::size_t i = 3 * node.index();
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

/// Returns the positions of all nodes.
inline std::vector<Vec3> pointsOf(const SurfaceMesh& mesh) {
  std::vector<Vec3> points(countNodes(mesh));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = pointOf(mesh, NodeId(i));
  return points;
}

inline NodeTriple nodesOf(const SurfaceMesh& mesh, TriangleId triangle) {
  const std::size_t i = 3 * triangle.index();
  return {NodeId(mesh.triangles[i]), NodeId(mesh.triangles[i + 1]), NodeId(mesh.triangles[i + 2])};
}

inline std::array<Vec3, 3> cornersOf(const SurfaceMesh& mesh, TriangleId triangle) {
  const auto [a, b, c] = nodesOf(mesh, triangle);
  return {pointOf(mesh, a), pointOf(mesh, b), pointOf(mesh, c)};
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

}  // namespace tetrafront
