#pragma once

/// @file Regions beside the triangles that close the holes of a surface.

#include <cstdint>
#include <span>

#include "topology/tracked_surface.h"

namespace tetrafront {

/// Sets SurfaceMesh::triangleRegions. `given`: two per given triangle. Triangles that close a hole get the regions of their
/// neighbours across edges of two triangles. Returns false if neighbours contradict each other, or if a triangle gets none.
/// O(n) per layer of triangles between the rim of a hole and its middle.
bool assignRegions(TrackedSurface& surface, std::span<const std::uint32_t> given);

}  // namespace tetrafront
