#include "volume/recovery.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/sort.h"

namespace tetrafront {
namespace {

constexpr std::uint32_t kMaxRings = 3;
/// What is tried, in this order, for each number of rings. The first two close nearly all.
constexpr std::array<RuleVariant, 6> kVariants{{
    {1.0, kNewNodeWeight, true, false},
    {0.8, kNewNodeWeight, true, true},
    {1.25, kNewNodeWeight, true, false},
    {0.65, 0.6, true, false},
    {1.0, 0.6, true, true},
    {1.1, 0.6, false, false},
}};
constexpr std::uint32_t kPasses = kMaxRings * kVariants.size();

/// Bounds of one attempt; costs are as FrontAdvance::step() counts them.
constexpr std::size_t kMaxRemovedElements = 4000;
constexpr std::uint64_t kCostPerRemovedElement = 30;
constexpr std::uint64_t kExtraCost = 2000;
/// And of all attempts together, per element of the mesh: where pockets are many, or triangles are
/// needles, the sizes asked for contradict the boundary, and trying everything everywhere would only
/// take its time. The exact fill comes after, and the optimizer makes as much of its elements.
constexpr std::uint64_t kTotalCostPerElement = 2;
constexpr std::uint64_t kExtraTotalCost = 40'000;

/// A place with at most so many rings around it may be filled in part only, so often in all; else it is
/// tried as a whole in a larger one.
constexpr std::uint32_t kMaxRingsInPart = 4;
constexpr std::uint32_t kMaxPartFills = 100;

/// Looking at this many active faces, or slots of faces, costs about as much as one step of the
/// front.
constexpr std::size_t kFacesPerStep = 4;
constexpr std::size_t kSlotsPerStep = 1000;

/// The element's sides as faces seen from inside it.
std::array<NodeTriple, 4> innerSides(const NodeQuad& n) {
  return {{{n[0], n[1], n[2]}, {n[1], n[0], n[3]}, {n[2], n[1], n[3]}, {n[0], n[2], n[3]}}};
}
NodeTriple reversed(const NodeTriple& t) { return {t[1], t[0], t[2]}; }

std::map<NodeTriple, FaceId> facesByNodes(const Front& front) {
  std::map<NodeTriple, FaceId> faces;
  for (const FaceId face : front.activeFaces()) {
    faces.emplace(leastFirst(front.face(face).nodes), face);
  }
  return faces;
}

}  // namespace

template <class Trace>
typename Recovery<Trace>::State Recovery<Trace>::advance(std::uint32_t budget) {
  while (budget > 0) {
    if (front_.activeCount() == 0 && stage_ != Stage::kRefront) stage_ = Stage::kFinished;
    if (stage_ == Stage::kFinished) {
      return front_.activeCount() == 0 ? State::kClosed : State::kStalled;
    }
    const std::size_t cost = std::max<std::size_t>(work(budget), 1);
    budget -= static_cast<std::uint32_t>(std::min<std::size_t>(cost, budget));
  }
  return State::kRunning;
}

template <class Trace>
bool Recovery<Trace>::anyIsLeft(const Range& made) const {
  const auto begin = elements_.removed.begin();
  const auto last = begin + static_cast<std::ptrdiff_t>(made.last);
  return std::find(begin + static_cast<std::ptrdiff_t>(made.first), last, 0) != last;
}

template <class Trace>
RecoverySummary Recovery<Trace>::summary() const {
  std::vector<std::uint8_t> used(front_.nodes().size(), 0);
  for (std::size_t element = 0; element < elements_.size(); ++element) {
    if (elements_.removed[element] != 0) continue;
    for (const NodeId node : elements_.nodes[element]) used[node.index()] = 1;
  }
  RecoverySummary left;
  for (const Range& made : starred_) left.starred += anyIsLeft(made) ? 1 : 0;
  for (const Range& made : reopened_) left.reopened += anyIsLeft(made) ? 1 : 0;
  for (const MadeByFill& made : filled_) {
    left.filled += anyIsLeft(made.elements) ? 1 : 0;
    for (std::size_t node = made.nodes.first; node < made.nodes.last; ++node) {
      left.steinerPoints += used[node];
    }
  }
  return left;
}

template <class Trace>
std::size_t Recovery<Trace>::work(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kFindPockets:
      findPocketsOfPass();
      beginPass();
      return lookCost();
    case Stage::kStar:
      return starNext();
    case Stage::kCount:
    case Stage::kIndex:
      return indexElements(budget);
    case Stage::kReopen:
      return reopenNext();
    case Stage::kRefront:
      return refront(budget);
    case Stage::kFindUnfilled:
      findPocketsOfPass();
      stage_ = Stage::kFill;
      return lookCost();
    case Stage::kFill:
      return fillNext(budget);
    case Stage::kFinished:
      break;
  }
  return 1;
}

template <class Trace>
std::size_t Recovery<Trace>::lookCost() const {
  return 1 + front_.activeCount() / kFacesPerStep + front_.slotCount() / kSlotsPerStep;
}

template <class Trace>
void Recovery<Trace>::findPocketsOfPass() {
  pockets_ = findPockets(front_);
  queue_.clear();
  nextInQueue_ = 0;
  for (const Pocket& pocket : pockets_) {
    queue_.push_back(leastFirst(front_.face(pocket.faces.front()).nodes));
  }
}

template <class Trace>
std::size_t Recovery<Trace>::starNext() {
  if (nextInQueue_ == pockets_.size()) {
    pass_ = 1;
    stage_ = Stage::kFindPockets;
    return 1;
  }
  const Pocket& pocket = pockets_[nextInQueue_++];
  const std::size_t first = elements_.size();
  if (star(pocket)) starred_.push_back({first, elements_.size()});
  return 1 + pocket.faces.size();
}

template <class Trace>
bool Recovery<Trace>::star(const Pocket& pocket) {
  if (!pocket.single) return false;
  const std::optional<Vec3> place = findStarPoint(front_, pocket);
  if (!place) return false;
  std::uint16_t layer = 0;
  for (const FaceId face : pocket.faces) {
    for (const NodeId node : front_.face(face).nodes) layer = std::max(layer, front_.layer(node));
  }
  const NodeId apex = front_.addNode(*place, layer, front_.face(pocket.faces.front()).hint);
  for (const FaceId face : pocket.faces) {
    const FrontFace& f = front_.face(face);
    elements_.add({f.nodes[0], f.nodes[1], f.nodes[2], apex}, f.region);
    front_.removeFace(face);
  }
  return true;
}

template <class Trace>
void Recovery<Trace>::beginPass() {
  if (pass_ == 0) {
    stage_ = Stage::kStar;
  } else if (pass_ > kPasses) {
    stage_ = Stage::kFindUnfilled;
  } else if ((pass_ - 1) % kVariants.size() != 0) {
    stage_ = Stage::kReopen;
  } else {
    // Elements made later than this are found by a scan.
    indexedElements_ = elements_.size();
    elementsAtNode_ = Incidence(front_.nodes().size());
    nextToIndex_ = 0;
    stage_ = Stage::kCount;
  }
}

template <class Trace>
std::size_t Recovery<Trace>::indexElements(std::uint32_t budget) {
  constexpr std::size_t kElementsPerStep = 100;
  const std::size_t left = indexedElements_ - nextToIndex_;
  // Compared before it is multiplied: the product can exceed 32 bits.
  const std::size_t done = left / kElementsPerStep < budget ? left : kElementsPerStep * budget;
  const std::size_t last = nextToIndex_ + done;
  for (; nextToIndex_ < last; ++nextToIndex_) {
    for (const NodeId node : elements_.nodes[nextToIndex_]) {
      if (stage_ == Stage::kCount) {
        elementsAtNode_.count(node.value);
      } else {
        elementsAtNode_.add(node.value, static_cast<std::uint32_t>(nextToIndex_));
      }
    }
  }
  if (nextToIndex_ == indexedElements_) {
    nextToIndex_ = 0;
    if (stage_ == Stage::kCount) {
      elementsAtNode_.endCounting();
      stage_ = Stage::kIndex;
    } else {
      stage_ = Stage::kReopen;
    }
  }
  return 1 + done / kElementsPerStep;
}

template <class Trace>
std::size_t Recovery<Trace>::reopenNext() {
  const FaceMap active = facesByNodes(front_);
  while (nextInQueue_ < queue_.size() && !active.contains(queue_[nextInQueue_])) ++nextInQueue_;
  if (cost_ > kTotalCostPerElement * elements_.size() + kExtraTotalCost) {
    stage_ = Stage::kFindUnfilled;
    return lookCost();
  }
  if (nextInQueue_ == queue_.size()) {
    ++pass_;
    stage_ = Stage::kFindPockets;
    return lookCost();
  }
  const FaceId sought = active.at(queue_[nextInQueue_++]);
  const std::vector<Pocket> pockets = findPockets(front_);
  for (std::size_t i = 0; i < pockets.size(); ++i) {
    if (std::binary_search(pockets[i].faces.begin(), pockets[i].faces.end(), sought)) {
      reopen(pockets, i, active);
      break;
    }
  }
  const std::size_t cost = 3 * lookCost() + attempt_.removedElements.size();
  cost_ += cost;
  return cost;
}

template <class Trace>
void Recovery<Trace>::reopen(const std::vector<Pocket>& pockets, std::size_t chosen,
                             const FaceMap& active) {
  attempt_ = Attempt{};
  const auto rings = static_cast<std::uint32_t>((pass_ - 1) / kVariants.size() + 1);
  std::vector<TetId> around = elementsAround(pockets[chosen], rings, kMaxRemovedElements);
  if (around.size() > kMaxRemovedElements) return;
  const std::vector<FaceId> rim = openPlace(pockets, chosen, active, std::move(around));
  const RuleVariant& variant = kVariants[(pass_ - 1) % kVariants.size()];
  advance_.setVariant(variant);
  front_.setOrder(variant.smallestFirst ? FrontOrder::kSmallestFirst : order_);
  for (const FaceId face : rim) front_.requeue(face, 0);
  stage_ = Stage::kRefront;
}

/// Removes elements around a pocket, so that they can be put back. Returns the faces that bound the
/// place then.
template <class Trace>
std::vector<FaceId> Recovery<Trace>::openPlace(const std::vector<Pocket>& pockets,
                                               std::size_t chosen, const FaceMap& active,
                                               std::vector<TetId> removed) {
  attempt_ = Attempt{};
  for (const auto& [nodes, face] : active) {
    const FrontFace& f = front_.face(face);
    attempt_.facesBefore.emplace(nodes, FaceRecord{f.region, f.hint, f.ruleClass});
  }
  attempt_.elementsBefore = elements_.size();
  attempt_.nodesBefore = front_.nodes().size();
  attempt_.removedElements = std::move(removed);
  attempt_.costLeft = kCostPerRemovedElement * attempt_.removedElements.size() + kExtraCost;
  return takeAway(pockets, chosen, active);
}

/// The elements within so many rings of nodes of the pocket, in rising order; no ring is begun once
/// there are `enough`.
template <class Trace>
std::vector<TetId> Recovery<Trace>::elementsAround(const Pocket& pocket, std::uint32_t rings,
                                                   std::size_t enough) const {
  std::set<NodeId> nodes;
  for (const FaceId face : pocket.faces) {
    for (const NodeId node : front_.face(face).nodes) nodes.insert(node);
  }
  std::set<TetId> elements;
  std::vector<NodeId> rim(nodes.begin(), nodes.end());
  for (std::uint32_t ring = 0; ring < rings && !rim.empty() && elements.size() < enough; ++ring) {
    std::vector<TetId> entering;
    const auto take = [&](TetId element) {
      if (elements_.removed[element.index()] != 0) return;
      if (elements.insert(element).second) entering.push_back(element);
    };
    for (const NodeId node : rim) {
      for (const std::uint32_t element : elementsAtNode_.at(node.value)) take(TetId(element));
    }
    for (std::size_t element = indexedElements_; element < elements_.size(); ++element) {
      const NodeQuad& quad = elements_.nodes[element];
      if (std::any_of(quad.begin(), quad.end(), [&](NodeId n) { return nodes.contains(n); })) {
        take(TetId(element));
      }
    }
    rim.clear();
    for (const TetId element : entering) {
      for (const NodeId node : elements_.nodes[element.index()]) {
        if (nodes.insert(node).second) rim.push_back(node);
      }
    }
  }
  return {elements.begin(), elements.end()};
}

/// Removes the elements and updates the front. Returns the faces that bound the empty place: the
/// pocket's, those of other pockets that it has grown into, and the new rim. The rest is foreign.
template <class Trace>
std::vector<FaceId> Recovery<Trace>::takeAway(const std::vector<Pocket>& pockets,
                                              std::size_t chosen, FaceMap active) {
  std::map<FaceId, std::size_t> pocketOfFace;
  for (std::size_t i = 0; i < pockets.size(); ++i) {
    for (const FaceId face : pockets[i].faces) pocketOfFace.emplace(face, i);
  }
  std::set<std::size_t> touchedPockets{chosen};
  std::set<NodeTriple> rim;
  for (const TetId element : attempt_.removedElements) {
    elements_.remove(element);
    for (const NodeTriple& side : innerSides(elements_.nodes[element.index()])) {
      const auto exposed = active.find(leastFirst(reversed(side)));
      if (exposed == active.end()) {
        const FaceId face =
            front_.addFace(side, elements_.region[element.index()], FieldHint{}, false);
        active.emplace(leastFirst(side), face);
        rim.insert(leastFirst(side));
        continue;
      }
      const NodeTriple key = exposed->first;
      if (rim.erase(key) == 0) touchedPockets.insert(pocketOfFace.at(exposed->second));
      front_.removeFace(exposed->second);
      active.erase(exposed);
    }
  }
  std::vector<FaceId> bounding;
  for (const auto& [key, face] : active) {
    if (rim.contains(key) || touchedPockets.contains(pocketOfFace.at(face))) {
      bounding.push_back(face);
    } else {
      attempt_.foreignFaces.insert(key);
    }
  }
  return bounding;
}

template <class Trace>
std::size_t Recovery<Trace>::refront(std::uint32_t budget) {
  std::uint64_t cost = 0;
  while (cost < budget && cost < attempt_.costLeft && !front_.nothingQueued()) {
    cost += advance_.step();
  }
  attempt_.costLeft -= std::min(cost, attempt_.costLeft);
  cost_ += cost;
  if (!front_.nothingQueued() && attempt_.costLeft > 0) return cost;
  finishAttempt();
  return cost + 2 * lookCost();
}

template <class Trace>
void Recovery<Trace>::finishAttempt() {
  front_.unqueueAll();
  advance_.setVariant(RuleVariant{});
  front_.setOrder(order_);
  stage_ = Stage::kReopen;
  if (!onlyForeignLeft(facesByNodes(front_))) {
    for (const Pocket& pocket : findPockets(front_)) {
      const bool foreign = std::all_of(pocket.faces.begin(), pocket.faces.end(), [&](FaceId face) {
        return attempt_.foreignFaces.contains(leastFirst(front_.face(face).nodes));
      });
      if (!foreign) star(pocket);
    }
  }
  if (onlyForeignLeft(facesByNodes(front_))) {
    reopened_.push_back({attempt_.elementsBefore, elements_.size()});
  } else {
    putBack();
  }
}

template <class Trace>
bool Recovery<Trace>::onlyForeignLeft(const FaceMap& active) const {
  return std::all_of(active.begin(), active.end(), [&](const auto& entry) {
    return attempt_.foreignFaces.contains(entry.first);
  });
}

/// Every face, element and node as it was before the attempt.
template <class Trace>
void Recovery<Trace>::putBack() {
  std::map<NodeTriple, FaceRecord> missing = attempt_.facesBefore;
  for (const auto& [nodes, face] : facesByNodes(front_)) {
    const auto known = missing.find(nodes);
    if (known == missing.end()) {
      front_.removeFace(face);
      continue;
    }
    front_.park(face, known->second.ruleClass);
    front_.setHint(face, known->second.hint);
    missing.erase(known);
  }
  elements_.dropFrom(attempt_.elementsBefore);
  for (const TetId element : attempt_.removedElements) elements_.restore(element);
  for (const auto& [nodes, record] : missing) {
    front_.park(front_.addFace(nodes, record.region, record.hint, false), record.ruleClass);
  }
  front_.dropNodesFrom(attempt_.nodesBefore);
}

template <class Trace>
std::size_t Recovery<Trace>::fillNext(std::uint32_t budget) {
  if (!fill_) {
    if (nextInQueue_ == queue_.size()) {
      stage_ = Stage::kFinished;
      return 1;
    }
    beginFill();
    return 3 * lookCost() + attempt_.removedElements.size();
  }
  const ExactFill::State state = fill_->advance(budget);
  if (state == ExactFill::State::kRunning) return budget;
  if (state == ExactFill::State::kDone) {
    takeFilled();
    nextToFill();
  } else {
    // A place inside without a double mostly has one when the place is larger.
    if (state == ExactFill::State::kPartial && fillRings_ <= kMaxRingsInPart &&
        partFills_ < kMaxPartFills) {
      ++partFills_;
      queueOpenPlaces(takeFilled());
    } else if (fillRings_ > 0) {
      putBack();
    }
    fillRings_ = std::max(1U, 2 * fillRings_);
  }
  fill_.reset();
  return budget;
}

/// Returns the faces around what is left open.
template <class Trace>
std::vector<FaceId> Recovery<Trace>::takeFilled() {
  MadeByFill made;
  made.elements.first = elements_.size();
  made.nodes.first = front_.nodes().size();
  std::vector<FaceId> open = fill_->apply(front_, elements_);
  made.elements.last = elements_.size();
  made.nodes.last = front_.nodes().size();
  filled_.push_back(made);
  return open;
}

/// What is around points without a place in doubles: mostly little, so a ring of elements with it is
/// little too.
template <class Trace>
void Recovery<Trace>::queueOpenPlaces(std::vector<FaceId> open) {
  stableSort(open);
  std::vector<NodeTriple> keys;
  for (const Pocket& pocket : findPockets(front_)) {
    for (const FaceId face : pocket.faces) {
      if (!std::binary_search(open.begin(), open.end(), face)) continue;
      keys.push_back(leastFirst(front_.face(face).nodes));
      break;
    }
  }
  const auto head = queue_.begin() + static_cast<std::ptrdiff_t>(nextInQueue_);
  queue_.insert(queue_.erase(head), keys.begin(), keys.end());
  removedToFill_ = 0;
}

template <class Trace>
void Recovery<Trace>::nextToFill() {
  beginOrder(0);
  ++nextInQueue_;
}

template <class Trace>
void Recovery<Trace>::beginOrder(unsigned order) {
  fillOrder_ = order;
  fillRings_ = 0;
  removedToFill_ = 0;
}

/// The largest place did not close: all sizes of it once more after inserting its nodes in another
/// order. To enlarge comes first, because what fails in one order often fails in all of them.
template <class Trace>
void Recovery<Trace>::tryNextOrder() {
  if (fillOrder_ + 1 == ExactFill::kOrders) return nextToFill();
  beginOrder(fillOrder_ + 1);
}

/// Gives the pocket at the head of the queue to the exact fill, with rings of elements around it.
template <class Trace>
void Recovery<Trace>::beginFill() {
  attempt_ = Attempt{};
  const FaceMap active = facesByNodes(front_);
  const auto sought = active.find(queue_[nextInQueue_]);
  if (sought == active.end()) return nextToFill();
  const std::vector<Pocket> pockets = findPockets(front_);
  for (std::size_t i = 0; i < pockets.size(); ++i) {
    Pocket pocket = pockets[i];
    if (!std::binary_search(pocket.faces.begin(), pocket.faces.end(), sought->second)) continue;
    if (fillRings_ > 0) {
      std::vector<TetId> around =
          elementsAround(pocket, fillRings_, std::numeric_limits<std::size_t>::max());
      // There is nothing more to take away.
      if (around.size() == removedToFill_) return tryNextOrder();
      removedToFill_ = around.size();
      pocket.faces = openPlace(pockets, i, active, std::move(around));
    }
    fill_.emplace(front_, std::move(pocket), fillOrder_);
    return;
  }
}

template class Recovery<NullTrace>;
template class Recovery<ClockTrace>;
template class Recovery<StepTrace>;

}  // namespace tetrafront
