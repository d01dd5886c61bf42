#include "topology/region_meshes.h"

#include <utility>

namespace tetrafront {
namespace {

template <class Nodes>
Nodes named(Nodes nodes, const NodeNames& names) {
  for (NodeId& node : nodes) node = NodeId(names.of(node));
  return nodes;
}

/// The meshes joined so far.
struct Joined {
  TetMesh mesh;  ///< without cores, with the node ids of the whole
  std::vector<MeshPart> cores;
  std::uint32_t nodes = 0;     ///< cores included
  std::uint32_t elements = 0;  ///< the same
};

/// Adds the core of a region, whose mesh was the last one added. `firstShared`: where its shared nodes are.
void addCore(Joined& all, const RegionMesh& part, std::uint32_t firstShared) {
  if (part.coreCount() == 0) return;
  all.cores.push_back({part.core, firstShared, all.nodes, all.elements, part.coreRegion});
  all.nodes += part.core->nodeCount();
  all.elements += part.core->elementCount();
}

void append(Joined& all, const RegionMesh& part) {
  const TetMesh& own = part.mesh;
  TetMesh& mesh = all.mesh;
  const NodeNames names{part.nodeOf, all.nodes};
  mesh.points.insert(mesh.points.end(),
                     own.points.begin() + static_cast<std::ptrdiff_t>(part.boundaryNodes),
                     own.points.end());
  mesh.regions.insert(mesh.regions.end(), own.regions.begin(), own.regions.end());
  for (const NodeQuad& nodes : own.tetrahedra) mesh.tetrahedra.push_back(named(nodes, names));
  for (const NodeTriple& nodes : own.front) mesh.front.push_back(named(nodes, names));
  const std::uint32_t firstShared = all.nodes;
  all.nodes += static_cast<std::uint32_t>(own.points.size() - part.boundaryNodes);
  all.elements += static_cast<std::uint32_t>(own.tetrahedra.size());
  addCore(all, part, firstShared);
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

PartedMesh joined(RegionMeshes meshes) {
  Joined all;
  if (meshes.regions.size() == 1 && meshes.regions.front().nodeOf.empty()) {
    RegionMesh& only = meshes.regions.front();
    all.mesh = std::move(only.mesh);
    all.nodes = static_cast<std::uint32_t>(all.mesh.points.size());
    all.elements = static_cast<std::uint32_t>(all.mesh.tetrahedra.size());
    addCore(all, only, static_cast<std::uint32_t>(only.boundaryNodes));
  } else if (!meshes.regions.empty()) {
    all.mesh.points = std::move(meshes.boundary);
    all.nodes = static_cast<std::uint32_t>(all.mesh.points.size());
    for (RegionMesh& region : meshes.regions) append(all, std::exchange(region, {}));
  }
  std::vector<NodeTriple>& front = all.mesh.front;
  front.insert(front.end(), meshes.waiting.begin(), meshes.waiting.end());
  return {toVolumeMesh(std::move(all.mesh)), std::move(all.cores)};
}

}  // namespace tetrafront
