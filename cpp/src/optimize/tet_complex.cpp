#include "optimize/tet_complex.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"
#include "topology/face_table.h"

namespace tetrafront {
namespace {

/// Given elements per new one for which there is room from the start. Filled spheres need 10 to 15 % more slots, and growing
/// arrays would double.
constexpr std::size_t kGivenPerNew = 6;

}  // namespace

TetComplex::TetComplex(TetMesh mesh, bool isStretched)
    : isFixed_(std::move(mesh.isFixed)),
      fixedNodes_(static_cast<std::size_t>(std::ranges::count(isFixed_, 1))),
      positions_(std::move(mesh.points)),
      isStretched_(isStretched),
      regions_(std::move(mesh.regions)),
      faceSlots_(kFaceSlots) {
  const std::size_t count = mesh.tetrahedra.size();
  const std::size_t withNew = count + count / kGivenPerNew;
  elements_.reserve(withNew);
  regions_.reserve(withNew);
  elements_.resize(count);
  resizeNodes(positions_.size());
  for (std::size_t t = 0; t < elements_.size(); ++t) {
    elements_[t].nodes = mesh.tetrahedra[t];
    for (const NodeId node : elements_[t].nodes) elementAt_[node.index()] = TetId(t);
  }
}

Task<> TetComplex::findNeighbours(Work& work) {
  work.beginPart(0.6);
  auto faces = co_await listFaces<ElementFace>(
      work, positions_.size(), elements_.size(), [this](std::size_t t, const auto& use) {
        const Corners& nodes = elements_[t].nodes;
        for (std::size_t k = 0; k < 4; ++k) {
          const auto& [a, b, c] = kFaceCorners[k];
          use({nodes[a], nodes[b], nodes[c]}, ElementFace(TetId(t), k));
        }
      });
  work.beginPart(1.0);
  co_await work.forEachId<NodeId>(positions_.size(), [&](NodeId node) {
    faces.forEachGroup(node, [this](const auto& group) {
      if (group.size() == 2) join(group[0].owner, group[1].owner);
    });
  });
  // Not before: the lists of faces need the most memory.
  faces = FaceTable<ElementFace>(0);
  states_.reserve(elements_.capacity());
  states_.assign(elements_.size(), {.pass = pass_});
}

/// Makes the elements neighbours, except across an interface, which is a boundary of both regions.
void TetComplex::join(ElementFace one, ElementFace other) {
  if (regions_[one.tet().index()] != regions_[other.tet().index()]) return;
  elements_[one.tet().index()].across[one.corner()] = other;
  elements_[other.tet().index()].across[other.corner()] = one;
}

TetMesh TetComplex::meshOf(std::vector<Vec3> positions, std::vector<std::uint32_t> regions) const {
  TetMesh mesh{.points = std::move(positions),
               .tetrahedra = {},
               .regions = std::move(regions),
               .front = {},
               .isFixed = isFixed_};
  mesh.tetrahedra.reserve(elements_.size());
  for (const Element& element : elements_) mesh.tetrahedra.push_back(element.nodes);
  compact(
      mesh, [this](NodeId node) { return isUsed(node); },
      [this](TetId tet) { return isLive(tet); });
  return mesh;
}

std::size_t TetComplex::freeNodeCount() const {
  std::size_t count = 0;
  for (const NodeId node : IdRange<NodeId>(nodeCount())) {
    if (!isFixed(node) && isUsed(node)) ++count;
  }
  return count;
}

NodeId TetComplex::addNode(const Vec3& position) {
  positions_.push_back(position);
  resizeNodes(positions_.size());
  return NodeId(positions_.size() - 1);
}

void TetComplex::resizeNodes(std::size_t count) {
  positions_.resize(count);
  isFixed_.resize(count, 0);
  if (isStretched_) {
    tensors_.resize(count);
  } else {
    sizes_.resize(count, 0.0);
  }
  elementAt_.resize(count);
  starPass_.resize(count, pass_);
}

void TetComplex::move(NodeId node, const Vec3& position) {
  if (inTrial_) savedPositions_.push_back({node, positions_[node.index()]});
  positions_[node.index()] = position;
}

void TetComplex::setCost(TetId tet, double cost) {
  save(tet);
  states_[tet.index()].cost = cost;
}

template <class Space>
void TetComplex::recomputeCosts(const ElementCost<Space>& cost, std::size_t first,
                                std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    if (!isLive(TetId(t))) continue;
    states_[t].cost = std::min(costOf(cost, elements_[t].nodes), kEntryCost);
  }
}

template void TetComplex::recomputeCosts(const ElementCost<PlainSpace>&, std::size_t, std::size_t);
template void TetComplex::recomputeCosts(const ElementCost<StretchedSpace>&, std::size_t,
                                         std::size_t);

void TetComplex::markStars(TetId tet) {
  for (const NodeId node : elements_[tet.index()].nodes) starPass_[node.index()] = pass_;
}

bool TetComplex::findStar(NodeId node, Star& star) {
  const std::uint32_t stamp = freshStamp();
  star.elements[0] = elementAt_[node.index()];
  states_[star.elements[0].index()].stamp = stamp;
  star.size = 1;
  for (std::size_t i = 0; i < star.size; ++i) {
    const Element& element = elements_[star.elements[i].index()];
    const std::size_t corner = cornerOf(element, node);
    star.corner[i] = static_cast<std::uint8_t>(corner);
    for (std::size_t other = 0; other < 3; ++other) {
      const std::size_t k = other + (other >= corner ? 1 : 0);
      if (element.across[k].isNone()) continue;
      const TetId next = element.across[k].tet();
      std::uint32_t& mark = states_[next.index()].stamp;
      // Without a branch, which would be unpredictable: half of the neighbours have been found before.
      star.elements[star.size] = next;
      star.size += mark == stamp ? 0 : 1;
      mark = stamp;
    }
    if (star.size > kMaxCavity) return false;
  }
  return true;
}

TetComplex::FaceKey TetComplex::keyOf(const Corners& nodes, std::size_t corner) const {
  const auto& side = kFaceCorners[corner];
  std::uint32_t a = nodes[side[0]].value;
  std::uint32_t b = nodes[side[1]].value;
  std::uint32_t c = nodes[side[2]].value;
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {{a, b, c}};
}

TetComplex::FaceSlot& TetComplex::slotFor(const FaceKey& key) {
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
  std::uint64_t hash = key.nodes[0];
  hash = hash * kGolden + key.nodes[1];
  hash = hash * kGolden + key.nodes[2];
  hash *= kGolden;
  std::size_t slot = static_cast<std::size_t>(hash >> 40) & (kFaceSlots - 1);
  while (faceSlots_[slot].stamp == faceStamp_ && !(faceSlots_[slot].key == key)) {
    slot = (slot + 1) & (kFaceSlots - 1);
  }
  return faceSlots_[slot];
}

TetId TetComplex::takeSlot() {
  if (!freeSlots_.empty()) {
    const TetId slot = freeSlots_.back();
    freeSlots_.pop_back();
    if (inTrial_ && freeSlots_.size() < freeSlotsKept_) {
      freeSlotsKept_ = freeSlots_.size();
      takenSlots_.push_back(slot);
    }
    return slot;
  }
  elements_.emplace_back();
  regions_.push_back(0);
  states_.emplace_back();
  return TetId(elements_.size() - 1);
}

void TetComplex::replace(std::span<const TetId> old, std::span<const NewElement> fresh) {
  const std::uint32_t region = regions_[old.front().index()];
  const std::uint32_t stamp = freshStamp();
  for (const TetId tet : old) states_[tet.index()].stamp = stamp;
  ++faceStamp_;
  for (const TetId tet : old) {
    const Element& element = elements_[tet.index()];
    for (std::size_t k = 0; k < 4; ++k) {
      const ElementFace across = element.across[k];
      if (!across.isNone() && states_[across.tet().index()].stamp == stamp) continue;
      const FaceKey key = keyOf(element.nodes, k);
      slotFor(key) = {key, across, faceStamp_};
    }
  }
  for (const TetId tet : old) save(tet);
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const TetId tet = i < old.size() ? old[i] : takeSlot();
    if (i >= old.size()) save(tet);
    elements_[tet.index()].nodes = fresh[i].nodes;
    regions_[tet.index()] = region;
    states_[tet.index()].cost = fresh[i].cost;
    states_[tet.index()].pass = pass_;
    for (const NodeId node : fresh[i].nodes) {
      elementAt_[node.index()] = tet;
      starPass_[node.index()] = pass_;
    }
    for (std::size_t k = 0; k < 4; ++k) link(tet, k);
  }
  for (std::size_t i = old.size(); i > fresh.size(); --i) {
    elements_[old[i - 1].index()].nodes[0] = NodeId();
    freeSlots_.push_back(old[i - 1]);
  }
}

/// Links a new element's face with the outer face, or the face of another new element, that has the
/// same nodes.
void TetComplex::link(TetId tet, std::size_t corner) {
  Element& element = elements_[tet.index()];
  const FaceKey key = keyOf(element.nodes, corner);
  FaceSlot& slot = slotFor(key);
  if (slot.stamp != faceStamp_) {
    element.across[corner] = ElementFace();
    slot = {key, {tet, corner}, faceStamp_};
    return;
  }
  element.across[corner] = slot.facing;
  if (slot.facing.isNone()) return;
  save(slot.facing.tet());
  elements_[slot.facing.tet().index()].across[slot.facing.corner()] = {tet, corner};
}

void TetComplex::save(TetId tet) {
  if (!inTrial_) return;
  const std::size_t i = tet.index();
  savedElements_.push_back({tet, elements_[i], states_[i].cost, states_[i].pass});
}

bool TetComplex::hasRoomFor(std::size_t removed, std::size_t added) {
  if (inTrial_ || added <= removed || elementCount() + (added - removed) <= mostElements_) {
    return true;
  }
  hasRefusedGrowth_ = true;
  return false;
}

bool TetComplex::fitsTrial() {
  if (elementCount() <= std::max(elementsBeforeTrial_, mostElements_)) return true;
  hasRefusedGrowth_ = true;
  return false;
}

void TetComplex::beginTrial() {
  inTrial_ = true;
  elementsBeforeTrial_ = elementCount();
  savedElements_.clear();
  savedPositions_.clear();
  freeSlotsKept_ = freeSlots_.size();
  takenSlots_.clear();
  slotsBeforeTrial_ = elements_.size();
  nodesBeforeTrial_ = positions_.size();
}

void TetComplex::keepTrial() { inTrial_ = false; }

void TetComplex::takeBack() {
  inTrial_ = false;
  for (std::size_t i = savedPositions_.size(); i-- > 0;) {
    positions_[savedPositions_[i].node.index()] = savedPositions_[i].position;
  }
  for (std::size_t i = savedElements_.size(); i-- > 0;) {
    const SavedElement& saved = savedElements_[i];
    elements_[saved.id.index()] = saved.element;
    states_[saved.id.index()].cost = saved.cost;
    states_[saved.id.index()].pass = saved.pass;
  }
  elements_.resize(slotsBeforeTrial_);
  regions_.resize(slotsBeforeTrial_);
  states_.resize(slotsBeforeTrial_);
  for (const SavedElement& saved : savedElements_) {
    if (saved.id.index() >= slotsBeforeTrial_ || !isLive(saved.id)) continue;
    for (const NodeId node : elements_[saved.id.index()].nodes) {
      elementAt_[node.index()] = saved.id;
    }
  }
  resizeNodes(nodesBeforeTrial_);
  freeSlots_.resize(freeSlotsKept_);
  freeSlots_.insert(freeSlots_.end(), takenSlots_.rbegin(), takenSlots_.rend());
}

std::vector<TetId> TetComplex::touchedByTrial() {
  std::vector<TetId> touched;
  const std::uint32_t stamp = freshStamp();
  const auto add = [&](TetId tet) {
    if (states_[tet.index()].stamp == stamp || !isLive(tet)) return;
    states_[tet.index()].stamp = stamp;
    touched.push_back(tet);
  };
  for (const SavedElement& saved : savedElements_) add(saved.id);
  for (std::size_t t = slotsBeforeTrial_; t < elements_.size(); ++t) add(TetId(t));
  return touched;
}

}  // namespace tetrafront
