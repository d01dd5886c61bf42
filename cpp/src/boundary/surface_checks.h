#pragma once

/// @file The parts of the boundary check that look at numbers and nodes before any geometry.

#include <cstdint>
#include <vector>

#include "boundary/boundary_report.h"
#include "boundary/edge_table.h"

namespace tetrafront {

/// Whole points and triangles, finite coordinates of a magnitude that exact arithmetic can bear, and
/// indices in range. Nothing else may be asked of the mesh if this reports anything.
void checkNumbers(const SurfaceMesh& mesh, BoundaryReport& report);

/// One flag per triangle: set where other checks would stumble over what is reported already.
struct InvalidTriangles {
  std::vector<std::uint8_t> inTopology;  ///< a repeated node, or the nodes of an earlier triangle
  std::vector<std::uint8_t> inGeometry;  ///< those, and triangles without area
};

/// Triangles with a repeated node or without area, and all but the first of those with the same
/// nodes.
[[nodiscard]] InvalidTriangles checkTriangles(const SurfaceMesh& mesh, BoundaryReport& report);

/// Two used nodes at one place.
void checkCoincidentNodes(const SurfaceMesh& mesh, BoundaryReport& report);

/// Edges with one triangle.
void checkEdges(const SurfaceMesh& mesh, const EdgeTable& edges, BoundaryReport& report);

}  // namespace tetrafront
