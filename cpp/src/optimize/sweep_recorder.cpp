#include "optimize/sweep_recorder.h"

#include <algorithm>
#include <optional>

#include "optimize/metric_space.h"
#include "quality/metrics.h"

namespace tetrafront {
namespace {

/// Kind of the events: the lowest three bits of their first byte; the other five are the detail.
constexpr std::uint32_t kSweepEvent = 7;
constexpr std::uint32_t kSweepKindBits = 3;

/// Details; those of sweeps follow the start.
constexpr std::uint32_t kStart = 0;
constexpr std::uint32_t kRestored = 8;
constexpr std::uint32_t kWithGeometry = 16;

/// Elements of the largest mesh whose changes are written: with them, a sweep has a few bytes per changed element.
constexpr std::size_t kMaxElements = 100'000;

constexpr double kCosine30 = 0.86602540378443865;
constexpr double kCosine135 = -0.70710678118654752;

/// Returns the detail of a sweep; none for those that only collect or measure.
std::optional<std::uint32_t> detailOf(Sweep sweep) {
  switch (sweep) {
    case Sweep::kSwap:
      return 1;
    case Sweep::kMove:
      return 2;
    case Sweep::kNewton:
      return 3;
    case Sweep::kSplit:
      return 4;
    case Sweep::kCollapse:
      return 5;
    case Sweep::kImprove:
      return 6;
    case Sweep::kLastResort:
      return 7;
    case Sweep::kCollectSplits:
    case Sweep::kCollectCollapses:
    case Sweep::kCollectPoor:
    case Sweep::kScore:
      return std::nullopt;
  }
  return std::nullopt;
}

/// Measures of a whole mesh, in the metric of the size field.
struct SweepMeasures {
  double largestCosine = -1.0;
  double smallestCosine = 1.0;
  double radiusRatios = 0.0;
  std::uint32_t outOfRange = 0;
};

template <class Space>
SweepMeasures measuresOf(const TetComplex& mesh) {
  SweepMeasures all;
  for (const TetId tet : IdRange<TetId>(mesh.slotCount())) {
    if (!mesh.isLive(tet)) continue;
    const Corners& nodes = mesh.element(tet).nodes;
    const auto frame = mesh.frameOf<Space>(nodes);
    const Vec3& origin = mesh.position(nodes[0]);
    const auto seen = [&](std::size_t k) {
      return Space::toUnit(frame, mesh.position(nodes[k]) - origin);
    };
    const TetrahedronMeasures one = measureTetrahedron(Vec3(0.0), seen(1), seen(2), seen(3));
    all.largestCosine = std::max(all.largestCosine, one.largestCosine);
    all.smallestCosine = std::min(all.smallestCosine, one.smallestCosine);
    all.radiusRatios += one.radiusRatio;
    if (one.largestCosine > kCosine30 || one.smallestCosine < kCosine135) ++all.outOfRange;
  }
  return all;
}

}  // namespace

void SweepRecorder::begun(const TetComplex& mesh) {
  hasGeometry_ = mesh.elementCount() <= kMaxElements;
  const std::uint32_t detail = kStart | (hasGeometry_ ? kWithGeometry : 0);
  bytes_.byte(kSweepEvent | detail << kSweepKindBits);
  writeMeasures(mesh);
  if (hasGeometry_) {
    bytes_.varint(mesh.nodeCount() - mesh.boundaryNodeCount());
    for (std::size_t node = mesh.boundaryNodeCount(); node < mesh.nodeCount(); ++node) {
      bytes_.position(mesh.position(NodeId(node)));
    }
    std::vector<std::uint32_t> slots(mesh.slotCount());
    for (std::size_t slot = 0; slot < slots.size(); ++slot) {
      slots[slot] = static_cast<std::uint32_t>(slot);
    }
    writeElements(mesh, slots);
  }
  copy(mesh);
}

void SweepRecorder::swept(Sweep sweep, const TetComplex& mesh) {
  const std::optional<std::uint32_t> kind = detailOf(sweep);
  if (!kind) return;
  ++sweeps_;
  const std::uint32_t detail = *kind | (hasGeometry_ ? kWithGeometry : 0);
  bytes_.byte(kSweepEvent | detail << kSweepKindBits);
  const Changes changes = changesIn(mesh);
  bytes_.varint(changes.movedNodes.size());
  bytes_.varint(changes.addedNodes);
  bytes_.varint(changes.droppedNodes);
  bytes_.varint(changes.made.size());
  writeMeasures(mesh);
  if (hasGeometry_) writeGeometry(mesh, changes);
  copy(mesh);
}

void SweepRecorder::restored() {
  bytes_.byte(kSweepEvent | kRestored << kSweepKindBits);
  bytes_.varint(kept_);
}

SweepRecorder::Changes SweepRecorder::changesIn(const TetComplex& mesh) const {
  Changes changes;
  for (const NodeId node : IdRange<NodeId>(mesh.nodeCount())) {
    const bool wasUsed = node.index() < isUsed_.size() && isUsed_[node.index()] != 0;
    const bool isUsed = mesh.isUsed(node);
    if (isUsed && !wasUsed) ++changes.addedNodes;
    if (!isUsed && wasUsed) ++changes.droppedNodes;
    if (isUsed && wasUsed && mesh.position(node) != positions_[node.index()]) {
      changes.movedNodes.push_back(node.value);
    }
  }
  for (const TetId tet : IdRange<TetId>(mesh.slotCount())) {
    const bool isKnown = tet.index() < elements_.size();
    if (isKnown && mesh.element(tet).nodes == elements_[tet.index()]) continue;
    if (mesh.isLive(tet)) {
      changes.made.push_back(tet.value);
    } else if (isKnown && !elements_[tet.index()][0].isNone()) {
      changes.removed.push_back(tet.value);
    }
  }
  return changes;
}

void SweepRecorder::copy(const TetComplex& mesh) {
  positions_.resize(mesh.nodeCount());
  isUsed_.resize(mesh.nodeCount());
  for (const NodeId node : IdRange<NodeId>(mesh.nodeCount())) {
    positions_[node.index()] = mesh.position(node);
    isUsed_[node.index()] = mesh.isUsed(node) ? 1 : 0;
  }
  elements_.resize(mesh.slotCount());
  for (const TetId tet : IdRange<TetId>(mesh.slotCount())) {
    elements_[tet.index()] = mesh.element(tet).nodes;
  }
}

void SweepRecorder::writeMeasures(const TetComplex& mesh) {
  const SweepMeasures measures =
      mesh.isStretched() ? measuresOf<StretchedSpace>(mesh) : measuresOf<PlainSpace>(mesh);
  const auto count = static_cast<double>(std::max<std::size_t>(mesh.elementCount(), 1));
  bytes_.varint(mesh.boundaryNodeCount() + mesh.freeNodeCount());
  bytes_.varint(mesh.elementCount());
  bytes_.shortNumber(measures.largestCosine);
  bytes_.shortNumber(measures.smallestCosine);
  bytes_.shortNumber(measures.radiusRatios / count);
  bytes_.varint(measures.outOfRange);
}

/// Numbers of nodes are never used again, so those of new nodes follow the ones of the last event.
void SweepRecorder::writeGeometry(const TetComplex& mesh, const Changes& changes) {
  bytes_.indices(changes.movedNodes);
  for (const std::uint32_t node : changes.movedNodes) {
    const Vec3 move = mesh.position(NodeId(node)) - positions_[node];
    for (int axis = 0; axis < 3; ++axis) bytes_.shorterNumber(move[axis]);
  }
  bytes_.varint(mesh.nodeCount() - positions_.size());
  for (std::size_t node = positions_.size(); node < mesh.nodeCount(); ++node) {
    bytes_.position(mesh.position(NodeId(node)));
  }
  bytes_.indices(changes.removed);
  writeElements(mesh, changes.made);
}

void SweepRecorder::writeElements(const TetComplex& mesh, const std::vector<std::uint32_t>& slots) {
  bytes_.indices(slots);
  std::uint32_t before = 0;
  for (const std::uint32_t slot : slots) {
    for (const NodeId node : mesh.element(TetId(slot)).nodes) {
      bytes_.difference(node.value, before);
      before = node.value;
    }
    bytes_.varint(mesh.regionOf(TetId(slot)));
  }
}

std::unique_ptr<SweepObserver> makeSweepRecorder(TraceBytes& bytes) {
  return std::make_unique<SweepRecorder>(bytes);
}

}  // namespace tetrafront
