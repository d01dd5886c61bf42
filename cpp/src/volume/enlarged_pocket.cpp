#include "volume/enlarged_pocket.h"

#include <algorithm>
#include <map>
#include <utility>

#include "base/sort.h"

namespace tetrafront {

EnlargedPocket::EnlargedPocket(Front& front, Elements& elements, PocketSet& pockets,
                               PocketId pocket, std::vector<TetId> removed)
    : removed_(std::move(removed)), touched_{pocket} {
  // Sides that two of the elements share lie within.
  std::map<NodeTriple, std::uint32_t> sides;
  for (const TetId element : removed_) {
    elements.remove(element);
    for (const NodeTriple& side : innerFaces(elements.nodes[element.index()])) {
      if (sides.erase(smallestFirst(reversed(side))) > 0) continue;
      sides.emplace(smallestFirst(side), elements.regions[element.index()]);
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
  for (const PocketId number : touched_) {
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

void EnlargedPocket::close(Front& front, Elements& elements, PocketSet& pockets) const {
  for (const TetId element : removed_) elements.restore(element);
  for (const FaceId face : facesNow(front, pockets)) front.removeFace(face);
  std::map<PocketId, std::vector<FaceId>> faces;
  for (const Before& b : before_) {
    const FaceId face = front.addFace(b.nodes, b.region, b.hint, false);
    front.setAside(face, b.ruleClass);
    faces[b.pocket].push_back(face);
  }
  for (auto& [number, its] : faces) {
    stableSort(its);
    pockets.put(number, std::move(its));
  }
}

}  // namespace tetrafront
