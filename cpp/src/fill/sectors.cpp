#include "fill/sectors.h"

#include <map>

namespace tetrafront {

std::vector<NodeId> separateSectors(FillMesh& mesh, std::span<const NodeId> boundaryPoints) {
  std::map<NodeId, std::vector<TetId>> tetsAt;
  for (const NodeId node : boundaryPoints) tetsAt[node];
  for (std::size_t i = 0; i < mesh.slotCount(); ++i) {
    if (!mesh.isLive(TetId(i))) continue;
    for (const NodeId node : mesh.tet(TetId(i)).nodes) {
      const auto found = tetsAt.find(node);
      if (found != tetsAt.end()) found->second.emplace_back(i);
    }
  }
  std::vector<NodeId> points;
  std::vector<TetId> sector;
  for (const auto& [node, tets] : tetsAt) {
    bool first = true;
    for (const TetId tet : tets) {
      // Already given away.
      if (!mesh.has(tet, node)) continue;
      mesh.starFrom(tet, node, sector);
      if (first && sector.size() == tets.size()) {
        points.push_back(node);
        break;
      }
      first = false;
      const NodeId own = mesh.points.copy(node);
      mesh.separate(sector, node, own);
      points.push_back(own);
    }
  }
  return points;
}

}  // namespace tetrafront
