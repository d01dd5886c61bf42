#include "volume/enlarged_pocket.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

EnlargedPocket::EnlargedPocket(Front& front, Elements& elements, PocketSet& pockets,
                               PocketId pocket, std::vector<TetId> removed)
    : removed_(std::move(removed)), touched_{pocket} {
  // Faces that two of the elements share are interior.
  std::map<NodeTriple, std::uint32_t> regionOfOuterFace;
  for (const TetId element : removed_) {
    elements.remove(element);
    for (const NodeTriple& face : innerFaces(elements.nodes[element.index()])) {
      if (regionOfOuterFace.erase(smallestFirst(reversed(face))) > 0) continue;
      regionOfOuterFace.emplace(smallestFirst(face), elements.regions[element.index()]);
    }
  }
  // An active face with a removed element behind it vanishes: both of its sides are empty.
  std::vector<FaceId> vanishing;
  for (auto outer = regionOfOuterFace.begin(); outer != regionOfOuterFace.end();) {
    const FaceId active = pockets.find(reversed(outer->first));
    if (active.isNone()) {
      ++outer;
      continue;
    }
    vanishing.push_back(active);
    touched_.push_back(pockets.pocketOf(active));
    outer = regionOfOuterFace.erase(outer);
  }
  stableSort(vanishing);
  sortUnique(touched_);
  for (const PocketId pocketId : touched_) {
    const std::vector<FaceId> theirs = pockets.faces(pocketId);
    pockets.remove(pocketId);
    for (const FaceId face : theirs) {
      const FrontFace& f = front.face(face);
      formerFaces_.push_back({f.nodes, f.region, f.hint, f.ruleClass, pocketId});
      if (std::binary_search(vanishing.begin(), vanishing.end(), face)) {
        front.removeFace(face);
      } else {
        faces_.push_back(face);
      }
    }
  }
  for (const auto& [nodes, region] : regionOfOuterFace) {
    faces_.push_back(front.addFace(nodes, region, FieldHint{}, false));
  }
  stableSort(faces_);
  box_ = front.boxOf(faces_.front());
  for (const FaceId face : faces_) {
    for (const NodeId node : front.face(face).nodes) box_.include(front.node(node));
  }
}

/// Returns the active faces in the box that belong to no pocket of the set.
std::vector<FaceId> EnlargedPocket::facesNow(const Front& front, const PocketSet& pockets) const {
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

void EnlargedPocket::restore(Front& front, Elements& elements, PocketSet& pockets) const {
  for (const TetId element : removed_) elements.restore(element);
  for (const FaceId face : facesNow(front, pockets)) front.removeFace(face);
  std::map<PocketId, std::vector<FaceId>> faces;
  for (const FormerFace& b : formerFaces_) {
    const FaceId face = front.addFace(b.nodes, b.region, b.hint, false);
    front.setAside(face, b.ruleClass);
    faces[b.pocket].push_back(face);
  }
  for (auto& [pocketId, its] : faces) {
    stableSort(its);
    pockets.put(pocketId, std::move(its));
  }
}

}  // namespace tetrafront
