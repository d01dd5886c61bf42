#pragma once

/// @file Regions beside the triangles that close the holes of a surface.

#include <cstdint>
#include <span>

#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Sets SurfaceMesh::triangleRegions. `origin`: per triangle, the given one whose regions it has, two in `given`; none if it
/// closes a hole: it then gets those of its neighbours across edges of two triangles. Returns false if neighbours contradict each
/// other, or if a triangle gets none. O(n) per layer of triangles between the rim of a hole and its middle.
bool assignRegions(SurfaceMesh& mesh, std::span<const TriangleId> origin,
                   std::span<const std::uint32_t> given);

}  // namespace tetrafront
