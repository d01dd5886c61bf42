#pragma once

/// @file The tetrahedral mesh that the stages of a run hand on: it moves from the front along a Morton curve to the
/// optimizer and the volume limiter. The flat arrays of tetrafront/mesh.h are made of it for whoever reads the result.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct TetMesh {
  std::vector<Vec3> points;            ///< per node; the nodes of the boundary come first
  std::vector<NodeQuad> tetrahedra;    ///< in the orientation of VolumeMesh::tetrahedra
  std::vector<std::uint32_t> regions;  ///< per tetrahedron
  std::vector<NodeTriple> front;       ///< as VolumeMesh::front
  std::size_t boundaryNodes = 0;       ///< number of nodes that stay where they are
};

/// Returns the mesh as flat arrays.
[[nodiscard]] VolumeMesh toVolumeMesh(TetMesh mesh);

/// Returns the mesh of flat arrays, whose first `boundaryNodes` nodes stay where they are.
[[nodiscard]] TetMesh toTetMesh(const VolumeMesh& mesh, std::size_t boundaryNodes);

/// Leaves out the tetrahedra and the nodes for which the functions return false, and keeps the order of the others. The
/// nodes of the boundary stay in any case. O(n).
template <class IsNodeKept, class IsTetKept>
void compact(TetMesh& mesh, IsNodeKept isNodeKept, IsTetKept isTetKept) {
  std::vector<NodeId> newId(mesh.points.size());
  std::size_t nodeCount = 0;
  for (const NodeId node : IdRange<NodeId>(newId.size())) {
    if (node.index() >= mesh.boundaryNodes && !isNodeKept(node)) continue;
    newId[node.index()] = NodeId(nodeCount);
    mesh.points[nodeCount++] = mesh.points[node.index()];
  }
  mesh.points.resize(nodeCount);
  std::size_t tetCount = 0;
  for (const TetId tet : IdRange<TetId>(mesh.tetrahedra.size())) {
    if (!isTetKept(tet)) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      mesh.tetrahedra[tetCount][k] = newId[mesh.tetrahedra[tet.index()][k].index()];
    }
    mesh.regions[tetCount++] = mesh.regions[tet.index()];
  }
  mesh.tetrahedra.resize(tetCount);
  mesh.regions.resize(tetCount);
  for (NodeTriple& face : mesh.front) {
    for (NodeId& node : face) node = newId[node.index()];
  }
}

}  // namespace tetrafront
