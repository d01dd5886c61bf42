#include "volume/step_recorder.h"

#include <algorithm>

namespace tetrafront {
namespace {

/// Kinds of events: the lowest three bits of their first byte; the other five are the detail.
enum class TraceEvent : std::uint8_t {
  kPass = 0,
  kBase = 1,
  kRefused = 2,
  kAccepted = 3,
  kPostponed = 4,
  kChange = 5,
  kEnd = 6,
};
constexpr std::uint32_t kKindBits = 3;

// Bits of details.
constexpr std::uint32_t kStretchedBase = 8;
constexpr std::uint32_t kRemeshedBase = 16;
constexpr std::uint32_t kRefusedNewNode = 4;
constexpr std::uint32_t kAcceptedNewNode = 8;
// Bits of the terms of a score.
constexpr std::uint32_t kWedge = 4;
constexpr std::uint32_t kLowWeight = 8;

std::uint32_t head(TraceEvent event, std::uint32_t detail) {
  return static_cast<std::uint32_t>(event) | detail << kKindBits;
}

}  // namespace

template <class Nodes>
void StepRecorder::writeCorners(const Nodes& nodes, std::uint32_t& before) {
  for (const NodeId node : nodes) {
    const std::uint32_t name = names_.of(node);
    bytes_.difference(name, before);
    before = name;
  }
}

void StepRecorder::beginPass(const Front& front, const NodeNames& names) {
  names_ = names;
  nodes_.assign(front.nodes().begin(), front.nodes().end());
  faces_.clear();
  elements_.clear();
  removed_.clear();
  baseBefore_ = FaceId(0U);
  isInPass_ = true;
  isRemeshing_ = false;
  bytes_.byte(head(TraceEvent::kPass, 0));
  bytes_.number(front.typicalSize());
  bytes_.varint(front.slotCount());
  std::uint32_t before = 0;
  for (const FaceId slot : IdRange<FaceId>(front.slotCount())) {
    const FrontFace& face = front.face(slot);
    setFace(slot, face.nodes, face.region);
    writeCorners(face.nodes, before);
    bytes_.varint(face.region);
  }
}

void StepRecorder::base(const Front& front, FaceId face, const UnitSpace& space, const Vec3& ideal,
                        std::size_t facesNear, std::size_t candidates) {
  const FrontFace& data = front.face(face);
  ++counts_.steps;
  const std::uint32_t detail = data.ruleClass + (space.isStretched() ? kStretchedBase : 0) +
                               (isRemeshing_ ? kRemeshedBase : 0);
  bytes_.byte(head(TraceEvent::kBase, detail));
  bytes_.difference(face.value, baseBefore_.value);
  const FrontRank rank = front.rankOf(data);
  bytes_.byte(rank.bucket);
  bytes_.varint(rank.layers);
  if (space.isStretched()) {
    const SymmetricTensor& size = space.sizeTensor();
    for (const double term : {size.xx, size.yy, size.zz, size.xy, size.xz, size.yz}) {
      bytes_.shortNumber(term);
    }
  } else {
    bytes_.shortNumber(space.targetEdge());
  }
  base_ = face;
  baseBefore_ = face;
  firstNode_ = data.nodes[0];
  bytes_.offset(front.node(firstNode_), ideal);
  bytes_.varint(facesNear);
  bytes_.varint(candidates);
}

void StepRecorder::writeScore(const Candidate& candidate) {
  const ScoreTerms& terms = candidate.terms;
  bytes_.shorterNumber(candidate.score);
  bytes_.byte(candidate.node == Candidate::kNewNode
                  ? terms.height + (terms.hasLowWeight ? kLowWeight : 0)
                  : terms.closed + (terms.isWedge ? kWedge : 0));
}

void StepRecorder::refused(const Front& front, NodeId node, const Vec3& position,
                           const Candidate& candidate, Refusal why, FaceId culprit) {
  ++counts_.refused[static_cast<std::size_t>(why)];
  const std::uint32_t isNew = node.isNone() ? kRefusedNewNode : 0;
  bytes_.byte(head(TraceEvent::kRefused, static_cast<std::uint32_t>(why) + isNew));
  writeScore(candidate);
  if (node.isNone()) {
    bytes_.offset(front.node(firstNode_), position);
  } else {
    bytes_.difference(names_.of(node), names_.of(firstNode_));
  }
  if (why != Refusal::kBehind) bytes_.difference(culprit.value, base_.value);
}

void StepRecorder::accepted(const Front& front, const NodeTriple& nodes, NodeId apex,
                            const Candidate& candidate, const std::array<FaceId, 3>& existing,
                            const std::array<FaceId, 3>& added, std::uint32_t region) {
  ++counts_.accepted;
  const bool isNew = candidate.node == Candidate::kNewNode;
  std::uint32_t detail = isNew ? kAcceptedNewNode : 0;
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    if (!existing[corner].isNone()) detail |= 1U << corner;
  }
  bytes_.byte(head(TraceEvent::kAccepted, detail));
  writeScore(candidate);
  if (isNew) {
    bytes_.position(front.node(apex));
    nodes_.push_back(front.node(apex));
  } else {
    bytes_.difference(names_.of(apex), names_.of(firstNode_));
  }
  removeFace(base_);
  for (const FaceId slot : existing) {
    if (slot.isNone()) continue;
    bytes_.difference(slot.value, base_.value);
    removeFace(slot);
  }
  for (std::size_t corner = 0; corner < 3; ++corner) {
    if (!existing[corner].isNone()) continue;
    bytes_.difference(added[corner].value, base_.value);
    setFace(added[corner], {nodes[(corner + 1) % 3], nodes[(corner + 2) % 3], apex}, region);
  }
  elements_.push_back({nodes[0], nodes[1], nodes[2], apex});
  removed_.push_back(0);
}

void StepRecorder::postponed(std::uint32_t next) {
  ++counts_.postponed;
  bytes_.byte(head(TraceEvent::kPostponed, next));
}

void StepRecorder::changed(const Front& front, const Elements& elements, FrontChange what) {
  ++counts_.steps;
  isRemeshing_ = what == FrontChange::kReopened;
  bytes_.byte(head(TraceEvent::kChange, static_cast<std::uint32_t>(what)));
  writeNodes(front);
  writeLeavingFaces(front);
  writeElements(elements);
  writeJoiningFaces(front);
}

void StepRecorder::endPass() {
  if (isInPass_) bytes_.byte(head(TraceEvent::kEnd, 0));
  isInPass_ = false;
}

void StepRecorder::setFace(FaceId slot, const NodeTriple& nodes, std::uint32_t region) {
  if (slot.index() >= faces_.size()) faces_.resize(slot.index() + 1);
  faces_[slot.index()] = {nodes, region, true};
}

bool StepRecorder::isSame(const Front& front, std::size_t slot) const {
  const FrontFace& now = front.face(FaceId(slot));
  const Face& before = faces_[slot];
  return now.active == before.isActive && now.nodes == before.nodes && now.region == before.region;
}

/// Writes how many nodes stay and the new ones.
void StepRecorder::writeNodes(const Front& front) {
  const std::span<const Vec3> now = front.nodes();
  const auto kept =
      static_cast<std::size_t>(std::ranges::mismatch(nodes_, now).in1 - nodes_.begin());
  // The nodes of the boundary always stay.
  bytes_.varint(names_.of(NodeId(kept)));
  bytes_.varint(now.size() - kept);
  for (std::size_t node = kept; node < now.size(); ++node) bytes_.position(now[node]);
  nodes_.assign(now.begin(), now.end());
}

void StepRecorder::writeLeavingFaces(const Front& front) {
  std::vector<std::uint32_t> leaving;
  for (const FaceId slot : IdRange<FaceId>(faces_.size())) {
    if (faces_[slot.index()].isActive && !isSame(front, slot.index()))
      leaving.push_back(slot.value);
  }
  bytes_.indices(leaving);
  for (const std::uint32_t slot : leaving) removeFace(FaceId(slot));
}

void StepRecorder::writeElements(const Elements& elements) {
  const auto kept = static_cast<std::size_t>(std::ranges::mismatch(elements_, elements.nodes).in1 -
                                             elements_.begin());
  elements_.resize(kept);
  removed_.resize(kept);
  std::vector<std::uint32_t> gone;
  std::vector<std::uint32_t> restored;
  for (const TetId element : IdRange<TetId>(kept)) {
    const std::uint8_t now = elements.removed[element.index()];
    if (now == removed_[element.index()]) continue;
    (now != 0 ? gone : restored).push_back(element.value);
    removed_[element.index()] = now;
  }
  bytes_.varint(kept);
  bytes_.indices(gone);
  bytes_.indices(restored);
  bytes_.varint(elements.size() - kept);
  std::uint32_t before = 0;
  for (std::size_t element = kept; element < elements.size(); ++element) {
    writeCorners(elements.nodes[element], before);
    bytes_.varint(elements.regions[element]);
    elements_.push_back(elements.nodes[element]);
    // Elements are recorded as soon as they are made, so none of them has been removed yet.
    removed_.push_back(0);
  }
}

void StepRecorder::writeJoiningFaces(const Front& front) {
  std::vector<FaceId> joining;
  faces_.resize(front.slotCount());
  for (const FaceId slot : IdRange<FaceId>(front.slotCount())) {
    if (front.face(slot).active && !isSame(front, slot.index())) joining.push_back(slot);
  }
  bytes_.varint(joining.size());
  std::uint32_t slotBefore = 0;
  std::uint32_t before = 0;
  for (const FaceId slot : joining) {
    const FrontFace& face = front.face(slot);
    bytes_.difference(slot.value, slotBefore);
    slotBefore = slot.value;
    writeCorners(face.nodes, before);
    bytes_.varint(face.region);
    setFace(slot, face.nodes, face.region);
  }
}

}  // namespace tetrafront
