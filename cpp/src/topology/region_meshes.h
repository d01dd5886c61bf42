#pragma once

/// @file The meshes of all regions of one boundary. Each has nodes of its own, so that it is made and optimized without the others;
/// together they are the mesh of the boundary.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/element_source.h"
#include "topology/mesh_view.h"
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

struct RegionMesh {
  TetMesh
      mesh;  ///< the nodes of the region's boundary come first, then those that it shares with the core
  /// Per node of the region's boundary: its index in the whole boundary, ascending; empty if there is one region.
  std::vector<std::uint32_t> nodeOf;
  std::size_t boundaryNodes = 0;  ///< number of nodes of the region's boundary
  /// Elements that nothing changes any more, so that no stage visits them; null without any. They share the nodes after those of
  /// the boundary.
  std::shared_ptr<const ElementSource> core;
  std::uint32_t coreRegion = 0;

  [[nodiscard]] std::size_t coreCount() const { return core ? core->elementCount() : 0; }
  [[nodiscard]] std::size_t innerNodeCount() const {
    return mesh.points.size() - boundaryNodes + (core ? core->nodeCount() : 0);
  }
  [[nodiscard]] std::size_t tetrahedronCount() const {
    return mesh.tetrahedra.size() + coreCount();
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

/// Joins the meshes: first the nodes of the boundary, then those inside each region, those of its core last. O(n), cores left out.
[[nodiscard]] PartedMesh joined(RegionMeshes meshes);

}  // namespace tetrafront
