#pragma once

/// @file Fills small holes of a surface without new nodes.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// The new triangles of a filled hole.
struct FilledHole {
  TriangleId firstTriangle;
  std::uint32_t triangleCount = 0;
};

/// Fills the holes with at most `maxEdges` edges and returns them. Appends the new triangles to `mesh`, which must
/// outlive the task. They are oriented as a triangle at the hole's rim.
///
/// Of all triangulations of a hole without new nodes, one of least area is chosen (rim_triangulation.h). It has no
/// degenerate triangles, no edges that the surface already has, and no triangles that intersect the given surface or
/// each other: such triangles are excluded, and the next one of least area is tried. A hole stays open if it has no
/// such triangulation, or if none is found after 300 attempts. New triangles of different holes may intersect; the
/// boundary check of the result reports this. Triangles with a repeated node should be removed first: their edges
/// count as open. O(n log n), and O(edges^3) for each attempt.
Task<std::vector<FilledHole>> fillHoles(Work& work, SurfaceMesh& mesh, std::uint32_t maxEdges);

}  // namespace tetrafront
