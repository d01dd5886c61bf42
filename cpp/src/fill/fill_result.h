#pragma once

/// @file Input and output of the exact fill.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/fill_mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// The volume to be filled. Triangles index `positions` and are counter-clockwise seen from the
/// empty side. They may bound several pockets, with islands inside them.
struct FillTask {
  std::vector<Vec3> positions;
  std::vector<NodeTriple> triangles;
};

struct FillResult {
  std::vector<Vec3> newPositions;  ///< positions of the nodes that follow those of the task
  std::vector<NodeQuad> tetrahedra;
  /// Per tetrahedron: the lowest triangle of the task that bounds its pocket.
  std::vector<FacetId> facetOfTetrahedron;
  /// Triangles of the task that no tetrahedron uses. Empty if everything is filled.
  std::vector<FacetId> openTriangles;
  /// The other faces that bound what is left open, counter-clockwise seen from there.
  std::vector<NodeTriple> openFaces;
  /// Per open face: the lowest triangle of the task that bounds its pocket.
  std::vector<FacetId> facetOfOpenFace;

  [[nodiscard]] bool isPartial() const { return !openFaces.empty() || !openTriangles.empty(); }
};

/// Reads the result from a mesh without exterior tetrahedra and without added boundary points. The
/// first `givenNodes` points are those of the task. Interior points that doubles cannot hold are
/// left out, and the tetrahedra at them left open. O(tetrahedra).
[[nodiscard]] FillResult collectResult(const FillMesh& mesh, std::size_t givenNodes,
                                       std::span<const NodeId> interiorPoints);

}  // namespace tetrafront
