#include "fill/sectors.h"

#include "base/sort.h"
#include "search/incidence.h"

namespace tetrafront {

std::vector<NodeId> separateSectors(FillMesh& mesh, std::span<const NodeId> boundaryPoints) {
  std::vector<NodeId> nodes(boundaryPoints.begin(), boundaryPoints.end());
  stableSort(nodes);
  std::vector<std::uint8_t> isAsked(mesh.points.size(), 0);
  for (const NodeId node : nodes) isAsked[node.index()] = 1;
  NodeLists<TetId> tetsAt(mesh.points.size());
  const auto forEachCorner = [&](const auto& act) {
    for (std::size_t i = 0; i < mesh.slotCount(); ++i) {
      if (!mesh.isLive(TetId(i))) continue;
      for (const NodeId node : mesh.tet(TetId(i)).nodes) {
        if (isAsked[node.index()] != 0) act(node, TetId(i));
      }
    }
  };
  forEachCorner([&](NodeId node, TetId /*tet*/) { tetsAt.count(node.value); });
  tetsAt.endCounting();
  forEachCorner([&](NodeId node, TetId tet) { tetsAt.add(node.value, tet); });
  std::vector<NodeId> points;
  std::vector<TetId> sector;
  for (const NodeId node : nodes) {
    const std::span<const TetId> tets = tetsAt.at(node.value);
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
