#include "volume/front_advance.h"

#include <algorithm>

#include "geom/measure.h"
#include "geom/predicates.h"

namespace tetrafront {
namespace {

/// Returns the next deeper layer; the type limits it.
std::uint16_t nextLayer(std::uint16_t layer) {
  constexpr std::uint16_t kDeepest = 0xffff;
  return layer == kDeepest ? layer : static_cast<std::uint16_t>(layer + 1);
}

/// Faces per unit of cost, gathered or tested against a candidate: about what one step visits if
/// triangles are well shaped.
constexpr std::uint64_t kFacesPerUnit = 64;

}  // namespace

template <class Trace>
std::uint64_t TracedFrontAdvance<Trace>::advance(std::uint64_t budget, FrontWatch& watch) {
  const std::uint64_t exactBefore = exactPredicateCount();
  variant_ = {};
  std::uint64_t spent = 0;
  // The watch looks after every step, so that the end does not depend on the budget.
  while (spent < budget && !front_.isQueueEmpty() && watch.isRunning()) {
    const std::uint32_t cost = step(watch.allowsRelaxation(elements_, counters_.relaxedCost));
    watch.look(front_, elements_, cost);
    spent += cost;
  }
  counters_.exactPredicates += exactPredicateCount() - exactBefore;
  return spent;
}

template <class Trace>
std::uint64_t TracedFrontAdvance<Trace>::refill(std::uint64_t budget, const RuleVariant& variant) {
  const std::uint64_t exactBefore = exactPredicateCount();
  variant_ = variant;
  std::uint64_t spent = 0;
  while (spent < budget && !front_.isQueueEmpty()) spent += step();
  counters_.exactPredicates += exactPredicateCount() - exactBefore;
  return spent;
}

template <class Trace>
FrontAdvance::Counters TracedFrontAdvance<Trace>::counters() const {
  Counters counters = counters_;
  counters.facesTested = crossing_.counters().facesTested;
  counters.facesAnalysed = crossing_.counters().facesAnalysed;
  return counters;
}

template <class Trace>
std::uint32_t TracedFrontAdvance<Trace>::step(bool mayRelax) {
  mayRelax = trace_.allowsRelaxation(mayRelax);
  const std::uint64_t before = facesVisited();
  const FaceId face = front_.popBase();
  const bool isRelaxed = front_.face(face).ruleClass > 0;
  ++counters_.pops;
  if ((isRelaxed && !mayRelax) || !complete(face)) postpone(face, mayRelax);
  const std::uint64_t cost = 1 + (facesVisited() - before) / kFacesPerUnit;
  if (isRelaxed) counters_.relaxedCost += cost;
  return static_cast<std::uint32_t>(cost);
}

template <class Trace>
void TracedFrontAdvance<Trace>::postpone(FaceId face, bool mayRelax) {
  const auto next = static_cast<std::uint8_t>(front_.face(face).ruleClass + 1);
  const bool comesAgain = mayRelax && next < kRuleClasses.size();
  trace_.postponed(comesAgain, next);
  if (comesAgain) {
    front_.requeue(face, next);
  } else {
    front_.setAside(face, next);
  }
}

template <class Trace>
bool TracedFrontAdvance<Trace>::complete(FaceId face) {
  const FrontFace& faceData = front_.face(face);
  const NodeTriple nodes = faceData.nodes;
  const RuleClass& rules = kRuleClasses[faceData.ruleClass];
  FieldHint hint = faceData.hint;
  const UnitSpace space = unitSpaceOf(front_, nodes, field_, hint, variant_.sizeFactor);
  front_.setHint(face, hint);
  const BaseFace base = describeBase(front_, nodes, space);
  const IdealPoint ideal = placeIdealPoint(base, space.targetEdge());
  gatherAround(nodes, space, base, ideal, rules);
  candidates_.rank(around_, crossing_, base, ideal, neighbours_, rules, variant_);
  trace_.base(front_, face, space, ideal, around_.faceCount(), candidates_.size());
  const double minFaceDistance = trace_.faceDistance(rules.faceDistance * ideal.size);
  for (std::uint32_t tries = 0; tries < rules.maxTries; ++tries) {
    const Candidate* candidate = candidates_.next();
    if (candidate == nullptr) return false;
    if (tryCandidate(face, *candidate, space, minFaceDistance)) {
      counters_.relaxed += &rules == kRuleClasses.data() ? 0 : 1;
      return true;
    }
  }
  return false;
}

template <class Trace>
void TracedFrontAdvance<Trace>::gatherAround(const NodeTriple& nodes, const UnitSpace& space,
                                             const BaseFace& base, const IdealPoint& ideal,
                                             const RuleClass& rules) {
  const Vec3 idealPosition = space.toSpace(ideal.position);
  SearchRegion region(space, {front_.node(nodes[0]), front_.node(nodes[1]), front_.node(nodes[2])},
                      ideal.position, rules.searchRadius * ideal.size, front_.extent());
  // A wedge apex may lie outside the region. Grow the region until it contains every wedge apex:
  // the crossing test needs all faces that an element could cross. The region never shrinks, so the
  // loop ends.
  do {
    counters_.comparedFaces += trace_.searchLinearly(front_, region.box());
    around_.gather(front_, nodes, region, idealPosition);
    around_.mapTo(space);
    {
      [[maybe_unused]] const CrossingScope scope(trace_);
      crossing_.setBase();
    }
    counters_.gatheredFaces += around_.faceCount();
  } while (neighbours_.find(around_, base, region));
}

template <class Trace>
bool TracedFrontAdvance<Trace>::tryCandidate(FaceId face, const Candidate& candidate,
                                             const UnitSpace& space, double minFaceDistance) {
  const bool isNew = candidate.node == Candidate::kNewNode;
  const NodeId known = isNew ? NodeId() : around_.nodeId(candidate.node);
  FaceId culprit;
  const auto refuse = [&](Refusal why) {
    trace_.refused(front_, known, space, candidate, why, culprit);
    return false;
  };
  if (isNew && isTooCloseToFace(candidate.unitPosition, minFaceDistance, culprit)) {
    return refuse(Refusal::kTooCloseToFace);
  }
  const Vec3 position = space.toSpace(candidate.unitPosition);
  const LocalNode apex = isNew ? around_.setNewNode(position) : candidate.node;
  if (crossing_.volumeSign(apex) <= 0) return refuse(Refusal::kBehind);
  ++counters_.candidatesTried;
  culprit = firstCrossedFace(apex);
  if (!culprit.isNone()) return refuse(Refusal::kCrosses);

  const ExistingFaces existing = findExistingFaces(apex);
  const FrontFace base = front_.face(face);
  const NodeId node = isNew ? addNode(base, position) : known;
  const std::array<FaceId, 3> added = accept(base, face, node, existing);
  trace_.accepted(front_, base, node, candidate, existing, added);
  return true;
}

/// Adds the new node one layer deeper than the base.
template <class Trace>
NodeId TracedFrontAdvance<Trace>::addNode(const FrontFace& base, const Vec3& position) {
  const NodeTriple& n = base.nodes;
  const std::uint16_t layer =
      std::min(front_.layer(n[0]), std::min(front_.layer(n[1]), front_.layer(n[2])));
  return front_.addNode(position, nextLayer(layer), base.hint);
}

template <class Trace>
FaceId TracedFrontAdvance<Trace>::firstCrossedFace(LocalNode apex) {
  [[maybe_unused]] const CrossingScope scope(trace_);
  crossing_.setApex(apex);
  facesMasked_ += around_.faceCount();
  return crossing_.firstCrossedFace();
}

template <class Trace>
bool TracedFrontAdvance<Trace>::isTooCloseToFace(const Vec3& position, double distance,
                                                 FaceId& culprit) {
  if (!(distance > 0.0)) return false;
  for (std::size_t i = 0; i < around_.faceCount(); ++i) {
    const LocalTriple& f = around_.face(i);
    if (f[0] < 3 || f[1] < 3 || f[2] < 3) continue;
    if (squaredDistanceToTriangle(position, around_.unitPosition(f[0]), around_.unitPosition(f[1]),
                                  around_.unitPosition(f[2])) < distance * distance) {
      culprit = around_.faceId(i);
      return true;
    }
  }
  return false;
}

/// Returns the faces of the front that are faces of the element. Besides the base, the element's faces
/// are (1 2 p), (2 0 p) and (0 1 p) seen from outside, opposite corners 0, 1 and 2. The front's faces
/// there have the opposite orientation, because they look into the element.
///
/// A face with the same orientation cannot occur. Around an edge of an embedded closed front, both
/// orientations alternate. So a third face lies between the base and such a face, within the element,
/// and the crossing test has already refused the candidate.
template <class Trace>
typename TracedFrontAdvance<Trace>::ExistingFaces TracedFrontAdvance<Trace>::findExistingFaces(
    LocalNode apex) const {
  ExistingFaces existing{};
  for (const AdjacentFace& adjacent : around_.adjacentFaces()) {
    if (adjacent.apex == apex) existing[adjacent.third()] = around_.faceId(adjacent.face);
  }
  return existing;
}

/// Adds the element and updates the front. Returns the faces that join the front, each where there was no existing one.
template <class Trace>
std::array<FaceId, 3> TracedFrontAdvance<Trace>::accept(const FrontFace& base, FaceId face,
                                                        NodeId apex,
                                                        const ExistingFaces& existing) {
  const NodeTriple& n = base.nodes;
  elements_.add({n[0], n[1], n[2], apex}, base.region);
  front_.removeFace(face);
  for (const FaceId known : existing) {
    if (!known.isNone()) front_.removeFace(known);
  }
  std::array<FaceId, 3> added{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!existing[i].isNone()) continue;
    added[i] = front_.addFace({n[(i + 1) % 3], n[(i + 2) % 3], apex}, base.region, base.hint, true);
  }
  return added;
}

template class TracedFrontAdvance<NullTrace>;
template class TracedFrontAdvance<ClockTrace>;
template class TracedFrontAdvance<RecordingTrace>;

std::unique_ptr<FrontAdvance> PlainFrontMaker::make(Front& front, Elements& elements,
                                                    const SizeField& field, bool filters) const {
  return std::make_unique<TracedFrontAdvance<NullTrace>>(front, elements, field, filters);
}

}  // namespace tetrafront
