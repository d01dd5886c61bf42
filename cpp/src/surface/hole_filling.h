#pragma once

/// @file Closes small holes of a surface without new nodes.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

struct FilledHole {
  std::uint32_t firstTriangle = 0;  ///< position in `triangles` of the mesh
  std::uint32_t triangles = 0;
};

/// Appends triangles that close the holes of at most `mostEdges` edges: of all triangulations of a
/// hole without new nodes, without triangles of no area and without edges that exist elsewhere, the
/// one of least area (Barequet & Sharir 1995); where there is none the hole stays. They are turned as
/// a triangle at the hole's edge is. O(n log n), and O(edges^3) for each hole. Triangles with a
/// repeated node should be gone: what they have for edges counts as open.
std::vector<FilledHole> fillHoles(SurfaceMesh& mesh, std::uint32_t mostEdges);

}  // namespace tetrafront
