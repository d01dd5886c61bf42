#pragma once

/// @file The half-faces of a surface: every triangle has two, its back and its front.
///
/// The triangles at an edge are sorted by angle. Between two that follow each other lies a wedge of volume, and the
/// two half-faces that bound the wedge are linked. This needs neither consistent orientation nor an even number of
/// triangles. The connected sets of half-faces are the shells of the volumes that the surface separates.

#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "topology/edge_table.h"

namespace tetrafront {

using HalfFaceId = Id<struct HalfFaceTag>;
using ShellId = Id<struct ShellTag>;

/// Triangles that are connected over edges.
using ComponentId = Id<struct ComponentTag>;

/// The half-face from which the triangle is seen clockwise: inside, if the triangle is oriented outward.
constexpr HalfFaceId backOf(TriangleId triangle) { return HalfFaceId(2 * triangle.value); }
/// The half-face from which the triangle is seen counter-clockwise.
constexpr HalfFaceId frontOf(TriangleId triangle) { return HalfFaceId(2 * triangle.value + 1); }
constexpr HalfFaceId oppositeOf(HalfFaceId halfFace) { return HalfFaceId(halfFace.value ^ 1U); }
constexpr TriangleId triangleOf(HalfFaceId halfFace) { return TriangleId(halfFace.value / 2); }

/// Sorts the half-edges of one edge by the angle of their triangles, counter-clockwise as seen when looking from
/// the higher to the lower node of the edge. No two triangles may lie in one half-plane. Exact.
void sortByAngle(const SurfaceMesh& mesh, std::vector<HalfEdgeId>& halfEdges);

/// Returns the shell of each half-face. Shells are numbered from 0 by their lowest half-faces. If an edge has one
/// triangle, both half-faces of the triangle belong to one shell. Exact. O(n log k) for k triangles at an edge.
[[nodiscard]] std::vector<ShellId> linkHalfFaces(const SurfaceMesh& mesh, const EdgeTable& edges);

/// Returns the component of each triangle. Components are numbered from 0 by their lowest triangles.
[[nodiscard]] std::vector<ComponentId> connectedComponents(const SurfaceMesh& mesh,
                                                           const EdgeTable& edges);

/// Orients the triangles of each component as its lowest triangle. At most two triangles may meet at an edge.
/// Returns false and changes nothing if the surface is one-sided.
[[nodiscard]] bool orientConsistently(SurfaceMesh& mesh, const EdgeTable& edges);

/// Reverses the orientation: swaps the second and the third node.
void flipTriangle(SurfaceMesh& mesh, TriangleId triangle);

}  // namespace tetrafront
