#pragma once

/// @file Makes the triangles of a closed surface agree on which way out is, and tells its shells
/// apart.
///
/// Around an edge with more than two triangles these are sorted by angle; inside and outside
/// alternate from wedge to wedge, so neighbours in angle are related as the two triangles of a
/// plain edge are. For the turning it does not matter which wedges are inside; once that is known,
/// the triangles on either side of an inner wedge belong to one shell.

#include <cstdint>
#include <vector>

#include "surface/boundary_report.h"
#include "surface/edge_table.h"

namespace tetrafront {

/// Sorts the half-edges of one edge by the angle of their triangles, counter-clockwise seen
/// against the direction from the edge's lower to its higher node. No two triangles may lie in
/// one half-plane. Exact.
void sortByAngle(const SurfaceMesh& mesh, std::vector<std::uint32_t>& halfEdges);

/// Turns triangles so that those with a common edge agree with the lowest of them. Returns a
/// number per triangle, equal for those that are so connected; numbers count from 0 in order of
/// the lowest triangle. Reports kInconsistentOrientation for one-sided surfaces.
[[nodiscard]] std::vector<std::uint32_t> orientConsistently(SurfaceMesh& mesh,
                                                            const EdgeTable& edges,
                                                            BoundaryReport& report);

/// The shells of a surface oriented outward: triangles connected over edges, and over an edge of
/// many triangles only across the region inside. Numbered as above. `edges` belongs to the mesh
/// as it is now.
[[nodiscard]] std::vector<std::uint32_t> innerShells(const SurfaceMesh& mesh,
                                                     const EdgeTable& edges);

/// Exchanges two nodes.
void turnRound(SurfaceMesh& mesh, std::uint32_t triangle);

}  // namespace tetrafront
