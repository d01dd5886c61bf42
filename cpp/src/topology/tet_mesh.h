#pragma once

/// @file The tetrahedral mesh that the stages of a run hand on: it moves from the front along a Morton curve to the
/// optimizer and the volume limiter. The flat arrays of tetrafront/mesh.h, the result, are made of it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct TetMesh {
  std::vector<Vec3> points;            ///< per node
  std::vector<NodeQuad> tetrahedra;    ///< in the orientation of VolumeMesh::tetrahedra
  std::vector<std::uint32_t> regions;  ///< per tetrahedron
  std::vector<NodeTriple> front;       ///< as VolumeMesh::front
  std::vector<std::uint8_t>
      isFixed;  ///< per node: 1 if it stays where it is, as those of the boundary do
};

/// Returns the mesh as flat arrays.
[[nodiscard]] VolumeMesh toVolumeMesh(TetMesh mesh);

/// Returns the marks of TetMesh::isFixed for a mesh of `nodes` nodes: the first `fixed` stay where they are.
[[nodiscard]] std::vector<std::uint8_t> firstFixed(std::size_t fixed, std::size_t nodes);

/// Returns the mesh of flat arrays, whose first `fixed` nodes stay where they are.
[[nodiscard]] TetMesh toTetMesh(const VolumeMesh& mesh, std::size_t fixed);

/// Leaves out the tetrahedra and the nodes for which the functions return false, and keeps the order of the others. Fixed
/// nodes stay in any case. O(n).
template <class IsNodeKept, class IsTetKept>
void compact(TetMesh& mesh, IsNodeKept isNodeKept, IsTetKept isTetKept) {
  std::vector<NodeId> newId(mesh.points.size());
  std::size_t nodeCount = 0;
  for (const NodeId node : IdRange<NodeId>(newId.size())) {
    if (mesh.isFixed[node.index()] == 0 && !isNodeKept(node)) continue;
    newId[node.index()] = NodeId(nodeCount);
    mesh.isFixed[nodeCount] = mesh.isFixed[node.index()];
    mesh.points[nodeCount++] = mesh.points[node.index()];
  }
  mesh.points.resize(nodeCount);
  mesh.isFixed.resize(nodeCount);
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
