#include "fill/sector_separation.h"

#include <cstdint>

#include "base/sort.h"

namespace tetrafront {

SectorSeparation::SectorSeparation(FillMesh& mesh, std::span<const NodeId> boundaryPoints)
    : mesh_(mesh),
      nodes_(boundaryPoints.begin(), boundaryPoints.end()),
      tetsAt_(mesh.points.size()) {
  stableSort(nodes_);
  std::vector<std::uint8_t> isListed(mesh.points.size(), 0);
  for (const NodeId node : nodes_) isListed[node.index()] = 1;
  const auto forEachCorner = [&](const auto& act) {
    for (std::size_t i = 0; i < mesh.slotCount(); ++i) {
      if (!mesh.isLive(TetId(i))) continue;
      for (const NodeId node : mesh.tet(TetId(i)).nodes) {
        if (isListed[node.index()] != 0) act(node, TetId(i));
      }
    }
  };
  forEachCorner([&](NodeId node, TetId /*tet*/) { tetsAt_.count(node); });
  tetsAt_.endCounting();
  forEachCorner([&](NodeId node, TetId tet) { tetsAt_.add(node, tet); });
}

std::size_t SectorSeparation::step() {
  const NodeId node = nodes_[next_++];
  const std::span<const TetId> tets = tetsAt_.at(node);
  bool first = true;
  for (const TetId tet : tets) {
    // The tetrahedron already has its own copy of the point.
    if (!mesh_.has(tet, node)) continue;
    mesh_.starFrom(tet, node, sector_);
    if (first && sector_.size() == tets.size()) {
      points_.push_back(node);
      break;
    }
    first = false;
    const NodeId own = mesh_.points.copy(node);
    mesh_.separate(sector_, node, own);
    points_.push_back(own);
  }
  return tets.size();
}

}  // namespace tetrafront
