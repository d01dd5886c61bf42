#pragma once

/// @file The two sides of every triangle, and how they hang together around edges.
///
/// Around an edge the triangles are sorted by angle; between two neighbours in angle lies a wedge of
/// space, and the two sides that bound it are glued. That needs neither a turning nor an even number
/// of triangles: the connected sets of sides are the shells of the spaces that a surface divides.

#include <cstdint>
#include <vector>

#include "boundary/edge_table.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// The side from which the triangle is seen clockwise: inside, if it is turned outward.
constexpr std::uint32_t backOf(std::uint32_t triangle) { return 2 * triangle; }
/// The side from which it is seen counter-clockwise.
constexpr std::uint32_t frontOf(std::uint32_t triangle) { return 2 * triangle + 1; }
constexpr std::uint32_t oppositeOf(std::uint32_t side) { return side ^ 1U; }
constexpr std::uint32_t triangleOf(std::uint32_t side) { return side / 2; }

/// Sorts the half-edges of one edge by the angle of their triangles, counter-clockwise seen
/// against the direction from the edge's lower to its higher node. No two triangles may lie in
/// one half-plane. Exact.
void sortByAngle(const SurfaceMesh& mesh, std::vector<std::uint32_t>& halfEdges);

/// The shell of each side, 2 per triangle; shells count from 0 in order of their lowest sides. At an
/// edge with one triangle its two sides are one shell. Exact. O(n log k) for k triangles at an edge.
[[nodiscard]] std::vector<std::uint32_t> linkHalfFaces(const SurfaceMesh& mesh,
                                                       const EdgeTable& edges);

/// A number per triangle, equal for those connected over edges; numbers count from 0 in order of the
/// lowest triangle.
[[nodiscard]] std::vector<std::uint32_t> connectedComponents(const SurfaceMesh& mesh,
                                                             const EdgeTable& edges);

/// Turns triangles so that those with a common edge agree with the lowest of them, of a surface with at
/// most two triangles at an edge. False, and nothing turned, if it is one-sided.
[[nodiscard]] bool orientConsistently(SurfaceMesh& mesh, const EdgeTable& edges);

/// Exchanges two nodes, and with them front and back.
void flipTriangle(SurfaceMesh& mesh, std::uint32_t triangle);

}  // namespace tetrafront
