#pragma once

/// @file The meshes of all regions of one boundary. Each has nodes of its own, so that it is made and optimized without the others;
/// together they are the mesh of the boundary.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

/// Names of the nodes of one region in the mesh of all regions. By default, all nodes keep theirs.
struct NodeNames {
  std::span<const std::uint32_t> ofBoundary;  ///< per node of the region's boundary
  std::uint32_t firstNew = 0;                 ///< name of the first node inside the region

  [[nodiscard]] std::uint32_t of(NodeId node) const {
    if (ofBoundary.empty()) return node.value;
    if (node.index() < ofBoundary.size()) return ofBoundary[node.index()];
    return firstNew + static_cast<std::uint32_t>(node.index() - ofBoundary.size());
  }
};

/// Elements that nothing changes any more, and that no stage therefore visits.
struct MeshCore {
  std::vector<Vec3> points;          ///< nodes that only elements of the core have
  std::vector<NodeQuad> tetrahedra;  ///< of the nodes of `shared`, and then of `points`
  std::uint32_t shared =
      0;  ///< nodes common to the other elements, which have them after those of the boundary
  std::uint32_t region = 0;
};

struct RegionMesh {
  TetMesh
      mesh;  ///< the nodes of the region's boundary come first, then those that it shares with the core
  /// Per node of the region's boundary: its index in the whole boundary, ascending; empty if there is one region.
  std::vector<std::uint32_t> nodeOf;
  std::size_t boundaryNodes = 0;  ///< number of nodes of the region's boundary
  MeshCore core;

  [[nodiscard]] std::size_t innerNodeCount() const {
    return mesh.points.size() - boundaryNodes + core.points.size();
  }
  [[nodiscard]] std::size_t tetrahedronCount() const {
    return mesh.tetrahedra.size() + core.tetrahedra.size();
  }
};

struct RegionMeshes {
  std::vector<Vec3> boundary;  ///< positions of the nodes of the whole boundary
  std::vector<RegionMesh> regions;
  std::vector<NodeTriple>
      waiting;  ///< triangles of regions that have no mesh yet, as VolumeMesh::front

  [[nodiscard]] std::size_t nodeCount() const;
  [[nodiscard]] std::size_t tetrahedronCount() const;
  [[nodiscard]] std::size_t frontFaceCount() const;
};

/// Joins the meshes: first the nodes of the boundary, then those inside each region. O(n).
[[nodiscard]] VolumeMesh joined(RegionMeshes meshes);

}  // namespace tetrafront
