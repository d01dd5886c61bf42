#pragma once

/// @file Exact tests of a position against the triangles of a surface: whether a ray from it crosses a triangle, and
/// whether it lies on one.

#include <array>

#include "geom/box.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// Returns the box of the ray from `start` along x.
[[nodiscard]] Box boxOfRay(const Vec3& start);

/// Returns whether the ray from `start` along x passes through the triangle. A symbolic perturbation, the same for
/// all triangles, keeps the ray off edges and nodes: the z of `start` counts as higher than any equal one, and its
/// y as lower. Exact; false if `start` lies on the triangle.
[[nodiscard]] bool isAheadOf(const std::array<Vec3, 3>& corners, const Vec3& start);
[[nodiscard]] inline bool isAheadOf(const SurfaceMesh& mesh, const Vec3& start,
                                    TriangleId triangle) {
  return isAheadOf(cornersOf(mesh, triangle), start);
}

/// Returns whether the position lies on the triangle, its edges included. Exact for triangles with area.
[[nodiscard]] bool liesOn(const SurfaceMesh& mesh, const Vec3& position, TriangleId triangle);

}  // namespace tetrafront
