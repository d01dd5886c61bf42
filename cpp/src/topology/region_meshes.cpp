#include "topology/region_meshes.h"

#include <utility>

namespace tetrafront {
namespace {

template <class Nodes>
Nodes named(Nodes nodes, const NodeNames& names) {
  for (NodeId& node : nodes) node = NodeId(names.of(node));
  return nodes;
}

/// Returns the mesh of a region with its core.
TetMesh whole(RegionMesh part) {
  const MeshCore& core = part.core;
  TetMesh mesh = std::move(part.mesh);
  const auto firstOwn = static_cast<std::uint32_t>(mesh.points.size());
  const auto firstShared = static_cast<std::uint32_t>(part.boundaryNodes);
  mesh.points.insert(mesh.points.end(), core.points.begin(), core.points.end());
  mesh.regions.resize(mesh.regions.size() + core.tetrahedra.size(), core.region);
  mesh.tetrahedra.reserve(mesh.regions.size());
  for (NodeQuad nodes : core.tetrahedra) {
    for (NodeId& node : nodes) {
      node = NodeId(node.value < core.shared ? firstShared + node.value
                                             : firstOwn + (node.value - core.shared));
    }
    mesh.tetrahedra.push_back(nodes);
  }
  return mesh;
}

void append(TetMesh& mesh, RegionMesh part) {
  const std::vector<std::uint32_t> nodeOf = std::move(part.nodeOf);
  const NodeNames names{nodeOf, static_cast<std::uint32_t>(mesh.points.size())};
  const std::size_t boundaryNodes = part.boundaryNodes;
  const TetMesh own = whole(std::move(part));
  mesh.points.insert(mesh.points.end(),
                     own.points.begin() + static_cast<std::ptrdiff_t>(boundaryNodes),
                     own.points.end());
  mesh.regions.insert(mesh.regions.end(), own.regions.begin(), own.regions.end());
  for (const NodeQuad& nodes : own.tetrahedra) mesh.tetrahedra.push_back(named(nodes, names));
  for (const NodeTriple& nodes : own.front) mesh.front.push_back(named(nodes, names));
}

}  // namespace

std::size_t RegionMeshes::nodeCount() const {
  std::size_t count = boundary.size();
  for (const RegionMesh& region : regions) count += region.innerNodeCount();
  return count;
}

std::size_t RegionMeshes::tetrahedronCount() const {
  std::size_t count = 0;
  for (const RegionMesh& region : regions) count += region.tetrahedronCount();
  return count;
}

std::size_t RegionMeshes::frontFaceCount() const {
  std::size_t count = waiting.size();
  for (const RegionMesh& region : regions) count += region.mesh.front.size();
  return count;
}

VolumeMesh joined(RegionMeshes meshes) {
  TetMesh mesh;
  if (meshes.regions.size() == 1 && meshes.regions.front().nodeOf.empty()) {
    mesh = whole(std::move(meshes.regions.front()));
  } else if (!meshes.regions.empty()) {
    mesh.points = std::move(meshes.boundary);
    for (RegionMesh& region : meshes.regions) append(mesh, std::exchange(region, {}));
  }
  mesh.front.insert(mesh.front.end(), meshes.waiting.begin(), meshes.waiting.end());
  return toVolumeMesh(std::move(mesh));
}

}  // namespace tetrafront
