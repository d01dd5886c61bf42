#pragma once

/// @file Regions beside the triangles that close the holes of a surface.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

/// Gives triangles without known regions those of their neighbours across edges of two triangles. `isKnown`: per triangle,
/// whether SurfaceMesh::triangleRegions has its regions. Returns false if neighbours contradict each other, or if a triangle
/// has none. O(n), and O(rounds) for n triangles from a rim to the middle of its hole.
bool spreadRegions(SurfaceMesh& mesh, std::vector<std::uint8_t> isKnown);

}  // namespace tetrafront
