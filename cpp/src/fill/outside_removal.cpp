#include "fill/outside_removal.h"

#include <algorithm>

namespace tetrafront {

OutsideRemoval::OutsideRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles)
    : mesh_(mesh), triangles_(triangles), inside_(mesh.slotCount(), 0) {}

FillState OutsideRemoval::step() {
  if (nextToFind_ < inside_.size()) {
    classify(TetId(nextToFind_++));
    return FillState::kRunning;
  }
  if (nextToFlood_ < queue_.size()) {
    return flood(queue_[nextToFlood_++]) ? FillState::kRunning : FillState::kFailed;
  }
  const auto isInside = [&](TetId tet) { return inside_[tet.index()] != 0; };
  if (std::ranges::any_of(outside_, isInside)) return FillState::kFailed;
  mesh_.keep(inside_);
  return FillState::kDone;
}

void OutsideRemoval::classify(TetId tet) {
  if (!mesh_.isLive(tet)) return;
  const FillTet& t = mesh_.tet(tet);
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (t.facet[k].isNone()) continue;
    const auto& f = triangles_[t.facet[k].index()];
    if (mesh_.points.orient(f[0], f[1], f[2], t.nodes[k]) < 0) {
      outside_.push_back(tet);
    } else if (inside_[tet.index()] == 0) {
      inside_[tet.index()] = 1;
      queue_.push_back(tet);
    }
  }
}

/// Returns false if the flood leaves the mesh.
bool OutsideRemoval::flood(TetId tet) {
  const FillTet& t = mesh_.tet(tet);
  for (std::uint32_t k = 0; k < 4; ++k) {
    if (!t.facet[k].isNone()) continue;
    const TetId beyond = t.across[k].tet;
    if (beyond.isNone()) return false;
    if (inside_[beyond.index()] != 0) continue;
    inside_[beyond.index()] = 1;
    queue_.push_back(beyond);
  }
  return true;
}

}  // namespace tetrafront
