#include "volume/recovery.h"

#include <algorithm>
#include <array>

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

/// Bounds of one attempt.
constexpr std::size_t kMaxRemovedElements = 4000;
constexpr std::uint64_t kPopsPerRemovedElement = 30;
constexpr std::uint64_t kExtraPops = 2000;

/// Layer of a star point: as deep as anything near it.
constexpr std::uint16_t kStarLayer = 8;

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
    if (stage_ == Stage::kFinished || front_.activeCount() == 0) {
      stage_ = Stage::kFinished;
      return front_.activeCount() == 0 ? State::kClosed : State::kStalled;
    }
    if (stage_ == Stage::kStar) {
      starAll();
      startPass();
    } else if (stage_ == Stage::kChoose) {
      chooseAndReopen();
    } else {
      refront(budget);
    }
    --budget;
  }
  return State::kRunning;
}

template <class Trace>
void Recovery<Trace>::starAll() {
  for (const Pocket& pocket : findPockets(front_)) starred_ += star(pocket) ? 1 : 0;
}

template <class Trace>
bool Recovery<Trace>::star(const Pocket& pocket) {
  if (!pocket.single) return false;
  const std::optional<Vec3> place = findStarPoint(front_, pocket);
  if (!place) return false;
  const NodeId apex = front_.addNode(*place, kStarLayer, front_.face(pocket.faces.front()).hint);
  for (const FaceId face : pocket.faces) {
    const FrontFace& f = front_.face(face);
    elements_.add({f.nodes[0], f.nodes[1], f.nodes[2], apex}, f.region);
    front_.removeFace(face);
  }
  return true;
}

template <class Trace>
void Recovery<Trace>::startPass() {
  stage_ = pass_ < kPasses ? Stage::kChoose : Stage::kFinished;
  queue_.clear();
  nextInQueue_ = 0;
  for (const Pocket& pocket : findPockets(front_)) {
    queue_.push_back(leastFirst(front_.face(pocket.faces.front()).nodes));
  }
  if (pass_ % kVariants.size() != 0 || queue_.empty()) return;
  // Elements made later than this are found by a scan.
  indexedElements_ = elements_.size();
  std::vector<std::uint32_t> corners;
  corners.reserve(4 * indexedElements_);
  for (const NodeQuad& quad : elements_.nodes) {
    for (const NodeId node : quad) corners.push_back(node.value);
  }
  elementsAtNode_ = Incidence(corners, 4, front_.nodes().size());
}

template <class Trace>
void Recovery<Trace>::chooseAndReopen() {
  while (nextInQueue_ < queue_.size()) {
    const NodeTriple sought = queue_[nextInQueue_++];
    for (const Pocket& pocket : findPockets(front_)) {
      for (const FaceId face : pocket.faces) {
        if (leastFirst(front_.face(face).nodes) == sought) return reopen(pocket);
      }
    }
  }
  ++pass_;
  startPass();
}

template <class Trace>
void Recovery<Trace>::reopen(const Pocket& pocket) {
  attempt_ = Attempt{};
  for (const auto& [nodes, face] : facesByNodes(front_)) {
    const FrontFace& f = front_.face(face);
    attempt_.facesBefore.emplace(nodes, FaceRecord{f.region, f.hint, f.ruleClass});
  }
  attempt_.elementsBefore = elements_.size();
  attempt_.nodesBefore = front_.nodes().size();
  const auto rings = static_cast<std::uint32_t>(pass_ / kVariants.size() + 1);
  attempt_.removedElements = elementsAround(pocket, rings);
  attempt_.popsLeft = kPopsPerRemovedElement * attempt_.removedElements.size() + kExtraPops;
  const std::vector<FaceId> rim = takeAway(attempt_.removedElements, pocket);
  const RuleVariant& variant = kVariants[pass_ % kVariants.size()];
  advance_.setVariant(variant);
  front_.setOrder(variant.smallestFirst ? FrontOrder::kSmallestFirst : order_);
  for (const FaceId face : rim) front_.requeue(face, 0);
  stage_ = Stage::kRefront;
}

/// The elements within so many rings of nodes of the pocket, in rising order.
template <class Trace>
std::vector<TetId> Recovery<Trace>::elementsAround(const Pocket& pocket,
                                                   std::uint32_t rings) const {
  std::set<NodeId> nodes;
  for (const FaceId face : pocket.faces) {
    for (const NodeId node : front_.face(face).nodes) nodes.insert(node);
  }
  std::set<TetId> elements;
  for (std::uint32_t ring = 0; ring < rings && elements.size() < kMaxRemovedElements; ++ring) {
    const auto take = [&](TetId element) {
      if (elements_.removed[element.index()] == 0) elements.insert(element);
    };
    for (const NodeId node : nodes) {
      for (const std::uint32_t element : elementsAtNode_.at(node.value)) take(TetId(element));
    }
    for (std::size_t element = indexedElements_; element < elements_.size(); ++element) {
      const NodeQuad& quad = elements_.nodes[element];
      if (std::any_of(quad.begin(), quad.end(), [&](NodeId n) { return nodes.contains(n); })) {
        take(TetId(element));
      }
    }
    for (const TetId element : elements) {
      const NodeQuad& quad = elements_.nodes[element.index()];
      nodes.insert(quad.begin(), quad.end());
    }
  }
  return {elements.begin(), elements.end()};
}

/// Removes the elements and updates the front. Returns the faces that bound the empty place: the
/// pocket's, those of other pockets that it has grown into, and the new rim. The rest is foreign.
template <class Trace>
std::vector<FaceId> Recovery<Trace>::takeAway(const std::vector<TetId>& elements,
                                              const Pocket& pocket) {
  std::map<FaceId, std::uint32_t> pocketOfFace;
  const std::vector<Pocket> pockets = findPockets(front_);
  for (std::uint32_t i = 0; i < pockets.size(); ++i) {
    for (const FaceId face : pockets[i].faces) pocketOfFace.emplace(face, i);
  }
  std::set<std::uint32_t> touchedPockets{pocketOfFace.at(pocket.faces.front())};
  std::map<NodeTriple, FaceId> active = facesByNodes(front_);
  std::set<NodeTriple> rim;
  for (const TetId element : elements) {
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
void Recovery<Trace>::refront(std::uint32_t& budget) {
  while (budget > 1 && attempt_.popsLeft > 0 && !front_.nothingQueued()) {
    advance_.step();
    --attempt_.popsLeft;
    --budget;
  }
  if (front_.nothingQueued() || attempt_.popsLeft == 0) finishAttempt();
}

template <class Trace>
void Recovery<Trace>::finishAttempt() {
  front_.unqueueAll();
  advance_.setVariant(RuleVariant{});
  front_.setOrder(order_);
  stage_ = Stage::kChoose;
  if (front_.activeCount() > attempt_.foreignFaces.size()) {
    for (const Pocket& pocket : findPockets(front_)) {
      const bool foreign =
          attempt_.foreignFaces.contains(leastFirst(front_.face(pocket.faces.front()).nodes));
      if (!foreign) star(pocket);
    }
  }
  if (front_.activeCount() == attempt_.foreignFaces.size()) {
    ++reopened_;
  } else {
    putBack();
  }
}

/// Every face, element and node as it was before the attempt.
template <class Trace>
void Recovery<Trace>::putBack() {
  std::map<NodeTriple, FaceRecord> missing = attempt_.facesBefore;
  for (const auto& [nodes, face] : facesByNodes(front_)) {
    if (missing.erase(nodes) == 0) front_.removeFace(face);
  }
  elements_.dropFrom(attempt_.elementsBefore);
  for (const TetId element : attempt_.removedElements) elements_.restore(element);
  for (const auto& [nodes, record] : missing) {
    front_.park(front_.addFace(nodes, record.region, record.hint, false), record.ruleClass);
  }
  front_.dropNodesFrom(attempt_.nodesBefore);
}

template class Recovery<NullTrace>;
template class Recovery<StepTrace>;

}  // namespace tetrafront
