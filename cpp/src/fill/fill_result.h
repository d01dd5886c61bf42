#pragma once

/// @file What the exact fill takes and what it returns.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "fill/fill_mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// The volume to be filled. Triangles index `positions`. They are counter-clockwise seen from the empty
/// side, and may bound several pockets, also with islands in them.
struct FillTask {
  std::vector<Vec3> positions;
  std::vector<NodeTriple> triangles;
};

struct FillResult {
  std::vector<Vec3> newPositions;  ///< of the nodes that follow those of the task
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

/// Reads the result from a mesh without exterior tetrahedra and without points put on the boundary. The
/// first `givenNodes` points are those of the task; of the interior points, those that doubles cannot
/// hold stay out, and the tetrahedra around them are left open. O(tetrahedra).
[[nodiscard]] FillResult collectResult(const FillMesh& mesh, std::size_t givenNodes,
                                       std::span<const NodeId> interiorPoints);

}  // namespace tetrafront
