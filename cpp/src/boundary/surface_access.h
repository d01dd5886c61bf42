#pragma once

/// @file Reading the flat arrays of a SurfaceMesh.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

inline Vec3 pointOf(const SurfaceMesh& mesh, std::uint32_t node) {
  const std::size_t i = 3 * std::size_t{node};
  return {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]};
}

inline std::vector<Vec3> pointsOf(const SurfaceMesh& mesh) {
  std::vector<Vec3> points(mesh.points.size() / 3);
  for (std::uint32_t i = 0; i < points.size(); ++i) points[i] = pointOf(mesh, i);
  return points;
}

inline std::array<Vec3, 3> cornersOf(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::size_t i = 3 * std::size_t{triangle};
  return {pointOf(mesh, mesh.triangles[i]), pointOf(mesh, mesh.triangles[i + 1]),
          pointOf(mesh, mesh.triangles[i + 2])};
}

}  // namespace tetrafront
