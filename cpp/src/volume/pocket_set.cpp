#include "volume/pocket_set.h"

#include <utility>

#include "base/sort.h"

namespace tetrafront {

PocketSet::PocketSet(const Front& front, std::vector<Pocket> pockets) : front_(front) {
  for (Pocket& pocket : pockets) add(std::move(pocket.faces));
}

std::vector<NodeId> PocketSet::nodes(PocketId pocket) const {
  std::vector<NodeId> nodes;
  for (const FaceId face : faces_[pocket.index()]) {
    const NodeTriple& n = front_.face(face).nodes;
    nodes.insert(nodes.end(), n.begin(), n.end());
  }
  sortUnique(nodes);
  return nodes;
}

PocketId PocketSet::add(std::vector<FaceId> faces) {
  const PocketId pocket(faces_.size());
  faces_.emplace_back();
  put(pocket, std::move(faces));
  return pocket;
}

void PocketSet::put(PocketId pocket, std::vector<FaceId> faces) {
  pocketOf_.resize(front_.slotCount());
  for (const FaceId face : faces) {
    pocketOf_[face.index()] = pocket;
    byNodes_.emplace(smallestFirst(front_.face(face).nodes), face);
  }
  faces_[pocket.index()] = std::move(faces);
}

void PocketSet::remove(PocketId pocket) {
  for (const FaceId face : faces_[pocket.index()]) {
    pocketOf_[face.index()] = PocketId();
    byNodes_.erase(smallestFirst(front_.face(face).nodes));
  }
  faces_[pocket.index()].clear();
}

FaceId PocketSet::find(const NodeTriple& nodes) const {
  const auto found = byNodes_.find(smallestFirst(nodes));
  return found == byNodes_.end() ? FaceId() : found->second;
}

}  // namespace tetrafront
