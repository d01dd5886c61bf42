#include "volume/opened_place.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

PocketSet::PocketSet(const Front& front, std::vector<Pocket> pockets) : front_(front) {
  for (Pocket& pocket : pockets) add(std::move(pocket.faces));
}

std::vector<NodeId> PocketSet::nodes(Number pocket) const {
  std::vector<NodeId> nodes;
  for (const FaceId face : faces_[pocket]) {
    const NodeTriple& n = front_.face(face).nodes;
    nodes.insert(nodes.end(), n.begin(), n.end());
  }
  sortUnique(nodes);
  return nodes;
}

PocketSet::Number PocketSet::add(std::vector<FaceId> faces) {
  const auto number = static_cast<Number>(faces_.size());
  faces_.emplace_back();
  put(number, std::move(faces));
  return number;
}

void PocketSet::put(Number pocket, std::vector<FaceId> faces) {
  pocketOf_.resize(front_.slotCount(), kNone);
  for (const FaceId face : faces) {
    pocketOf_[face.index()] = pocket;
    byNodes_.emplace(leastFirst(front_.face(face).nodes), face);
  }
  faces_[pocket] = std::move(faces);
}

void PocketSet::remove(Number pocket) {
  for (const FaceId face : faces_[pocket]) {
    pocketOf_[face.index()] = kNone;
    byNodes_.erase(leastFirst(front_.face(face).nodes));
  }
  faces_[pocket].clear();
}

FaceId PocketSet::find(const NodeTriple& nodes) const {
  const auto found = byNodes_.find(leastFirst(nodes));
  return found == byNodes_.end() ? FaceId() : found->second;
}

OpenedPlace::OpenedPlace(Front& front, Elements& elements, PocketSet& pockets,
                         PocketSet::Number pocket, std::vector<TetId> removed)
    : removed_(std::move(removed)), touched_{pocket} {
  // Sides that two of the elements share lie within.
  std::map<NodeTriple, std::uint32_t> sides;
  for (const TetId element : removed_) {
    elements.remove(element);
    for (const NodeTriple& side : innerSides(elements.nodes[element.index()])) {
      if (sides.erase(leastFirst(reversed(side))) > 0) continue;
      sides.emplace(leastFirst(side), elements.region[element.index()]);
    }
  }
  // A face with such an element behind it has nothing on either side.
  std::vector<FaceId> vanishing;
  for (auto side = sides.begin(); side != sides.end();) {
    const FaceId exposed = pockets.find(reversed(side->first));
    if (exposed.isNone()) {
      ++side;
      continue;
    }
    vanishing.push_back(exposed);
    touched_.push_back(pockets.pocketOf(exposed));
    side = sides.erase(side);
  }
  stableSort(vanishing);
  sortUnique(touched_);
  for (const PocketSet::Number number : touched_) {
    const std::vector<FaceId> theirs = pockets.faces(number);
    pockets.remove(number);
    for (const FaceId face : theirs) {
      const FrontFace& f = front.face(face);
      before_.push_back({f.nodes, f.region, f.hint, f.ruleClass, number});
      if (std::binary_search(vanishing.begin(), vanishing.end(), face)) {
        front.removeFace(face);
      } else {
        faces_.push_back(face);
      }
    }
  }
  for (const auto& [side, region] : sides) {
    faces_.push_back(front.addFace(side, region, FieldHint{}, false));
  }
  stableSort(faces_);
  box_ = front.boxOf(faces_.front());
  for (const FaceId face : faces_) {
    for (const NodeId node : front.face(face).nodes) box_.include(front.node(node));
  }
}

/// Whatever is near and in no pocket.
std::vector<FaceId> OpenedPlace::facesNow(const Front& front, const PocketSet& pockets) const {
  std::vector<std::uint32_t> near;
  const std::size_t count = front.facesNear(box_, near);
  std::vector<FaceId> faces;
  for (std::size_t i = 0; i < count; ++i) {
    const FaceId face(near[i]);
    if (pockets.find(front.face(face).nodes).isNone()) faces.push_back(face);
  }
  stableSort(faces);
  return faces;
}

void OpenedPlace::close(Front& front, Elements& elements, PocketSet& pockets) const {
  for (const TetId element : removed_) elements.restore(element);
  for (const FaceId face : facesNow(front, pockets)) front.removeFace(face);
  std::map<PocketSet::Number, std::vector<FaceId>> faces;
  for (const Before& b : before_) {
    const FaceId face = front.addFace(b.nodes, b.region, b.hint, false);
    front.park(face, b.ruleClass);
    faces[b.pocket].push_back(face);
  }
  for (auto& [number, its] : faces) {
    stableSort(its);
    pockets.put(number, std::move(its));
  }
}

}  // namespace tetrafront
