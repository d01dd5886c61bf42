#pragma once

/// @file The boundary check before self-intersections: numbers, triangles, nodes and edges.

#include <cstdint>
#include <vector>

#include "boundary/boundary_report.h"
#include "topology/edge_table.h"

namespace tetrafront {

/// Reports incomplete nodes and triangles, an empty surface, coordinates that are not finite or out of the range of
/// exact arithmetic, and indices out of range. If this function reports anything, no other check may be called.
void checkNumbers(const SurfaceMesh& mesh, BoundaryReport& report);

/// One flag per triangle: set if later checks must ignore the triangle, because it is already reported.
struct InvalidTriangles {
  std::vector<std::uint8_t> inTopology;  ///< with a repeated node, or duplicates
  std::vector<std::uint8_t> inGeometry;  ///< those in `inTopology`, and other degenerate triangles
};

/// Reports degenerate triangles, and all but the first of duplicate triangles.
[[nodiscard]] InvalidTriangles checkTriangles(const SurfaceMesh& mesh, BoundaryReport& report);

/// Reports used nodes with equal positions.
void checkCoincidentNodes(const SurfaceMesh& mesh, BoundaryReport& report);

/// Reports open edges, which have one triangle.
void checkEdges(const SurfaceMesh& mesh, const EdgeTable& edges, BoundaryReport& report);

}  // namespace tetrafront
