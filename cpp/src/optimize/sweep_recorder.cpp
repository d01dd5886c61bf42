#include "optimize/sweep_recorder.h"

#include <algorithm>
#include <array>
#include <numeric>
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

template <class Space>
void add(SweepMeasures& all, const typename Space::Frame& frame, const std::array<Vec3, 4>& p) {
  const TetrahedronMeasures one =
      measureTetrahedron(Vec3(0.0), Space::toUnit(frame, p[1] - p[0]),
                         Space::toUnit(frame, p[2] - p[0]), Space::toUnit(frame, p[3] - p[0]));
  ++all.elements;
  all.largestCosine = std::max(all.largestCosine, one.largestCosine);
  all.smallestCosine = std::min(all.smallestCosine, one.smallestCosine);
  all.radiusRatios += one.radiusRatio;
  if (one.largestCosine > kCosine30 || one.smallestCosine < kCosine135) ++all.outOfRange;
}

template <class Space>
SweepMeasures measuresOf(const TetComplex& mesh) {
  SweepMeasures all{.innerNodes = mesh.freeNodeCount()};
  for (const TetId tet : IdRange<TetId>(mesh.slotCount())) {
    if (!mesh.isLive(tet)) continue;
    const auto& [a, b, c, d] = mesh.element(tet).nodes;
    add<Space>(all, mesh.frameOf<Space>({a, b, c, d}),
               {mesh.position(a), mesh.position(b), mesh.position(c), mesh.position(d)});
  }
  return all;
}

/// Returns the measures of a mesh before its optimization.
template <class Space>
SweepMeasures measuresOf(const TetMesh& mesh, const SizeField& field) {
  TetComplex complex(mesh, Space::kIsStretched);
  FieldHint hint;
  for (const NodeId node : IdRange<NodeId>(mesh.points.size())) {
    complex.setTarget<Space>(node, Space::targetAt(field, complex.position(node), hint));
  }
  SweepMeasures all = measuresOf<Space>(complex);
  all.innerNodes = complex.nodeCount() - complex.fixedNodeCount();
  return all;
}

SweepMeasures sum(const SweepMeasures& a, const SweepMeasures& b) {
  return {.innerNodes = a.innerNodes + b.innerNodes,
          .elements = a.elements + b.elements,
          .largestCosine = std::max(a.largestCosine, b.largestCosine),
          .smallestCosine = std::min(a.smallestCosine, b.smallestCosine),
          .radiusRatios = a.radiusRatios + b.radiusRatios,
          .outOfRange = a.outOfRange + b.outOfRange};
}

/// Writes elements with four nodes and a region each.
class ElementWriter {
 public:
  explicit ElementWriter(TraceBytes& bytes) : bytes_(bytes) {}

  template <class NumberOf>
  void write(const Corners& nodes, std::uint32_t region, const NumberOf& numberOf) {
    for (const NodeId node : nodes) {
      const std::uint32_t number = numberOf(node);
      bytes_.difference(number, before_);
      before_ = number;
    }
    bytes_.varint(region);
  }

 private:
  TraceBytes& bytes_;
  std::uint32_t before_ = 0;
};

}  // namespace

void SweepRecorder::begun(const RegionMeshes& meshes, const SizeField& field) {
  regions_ = meshes.regions;
  boundaryNodes_ = meshes.boundary.size();
  given_ = {.nextNode = static_cast<std::uint32_t>(boundaryNodes_)};
  new_ = {.nextNode = static_cast<std::uint32_t>(meshes.nodeCount()),
          .nextElement = static_cast<std::uint32_t>(meshes.tetrahedronCount())};
  for (const RegionMesh& region : regions_) {
    measures_.push_back(field.isStretched() ? measuresOf<StretchedSpace>(region.mesh, field)
                                            : measuresOf<PlainSpace>(region.mesh, field));
  }
  hasGeometry_ = meshes.tetrahedronCount() <= kMaxElements;
  const std::uint32_t detail = kStart | (hasGeometry_ ? kWithGeometry : 0);
  bytes_.byte(kSweepEvent | detail << kSweepKindBits);
  writeMeasures();
  if (hasGeometry_) writeFirstMesh(meshes);
}

void SweepRecorder::begunRegion(const TetComplex& mesh) {
  const RegionMesh& region = regions_[begunRegions_++];
  nodeNumbers_.clear();
  elementNumbers_.clear();
  for (std::uint32_t node = 0; node < region.boundaryNodes; ++node) {
    nodeNumbers_.push_back(region.nodeOf.empty() ? node : region.nodeOf[node]);
  }
  number(mesh, given_);
  copy(mesh);
}

/// Numbers the nodes and elements that have no number yet.
void SweepRecorder::number(const TetComplex& mesh, Numbers& numbers) {
  while (nodeNumbers_.size() < mesh.nodeCount()) nodeNumbers_.push_back(numbers.nextNode++);
  while (elementNumbers_.size() < mesh.slotCount()) {
    elementNumbers_.push_back(numbers.nextElement++);
  }
}

void SweepRecorder::swept(Sweep sweep, const TetComplex& mesh) {
  const std::optional<std::uint32_t> kind = detailOf(sweep);
  if (!kind) return;
  ++sweeps_;
  number(mesh, new_);
  measures_[begunRegions_ - 1] =
      mesh.isStretched() ? measuresOf<StretchedSpace>(mesh) : measuresOf<PlainSpace>(mesh);
  const std::uint32_t detail = *kind | (hasGeometry_ ? kWithGeometry : 0);
  bytes_.byte(kSweepEvent | detail << kSweepKindBits);
  const Changes changes = changesIn(mesh);
  bytes_.varint(changes.movedNodes.size());
  bytes_.varint(changes.addedNodes);
  bytes_.varint(changes.droppedNodes);
  bytes_.varint(changes.made.size());
  writeMeasures();
  if (hasGeometry_) writeGeometry(mesh, changes);
  copy(mesh);
}

void SweepRecorder::kept() {
  kept_ = sweeps_;
  newWhenKept_ = new_;
  measuresWhenKept_ = measures_[begunRegions_ - 1];
}

void SweepRecorder::restored() {
  new_ = newWhenKept_;
  measures_[begunRegions_ - 1] = measuresWhenKept_;
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

void SweepRecorder::writeMeasures() {
  SweepMeasures all;
  for (const SweepMeasures& region : measures_) all = sum(all, region);
  bytes_.varint(boundaryNodes_ + all.innerNodes);
  bytes_.varint(all.elements);
  bytes_.shortNumber(all.largestCosine);
  bytes_.shortNumber(all.smallestCosine);
  bytes_.shortNumber(all.radiusRatios /
                     static_cast<double>(std::max<std::size_t>(all.elements, 1)));
  bytes_.varint(all.outOfRange);
}

void SweepRecorder::writeFirstMesh(const RegionMeshes& meshes) {
  bytes_.varint(meshes.nodeCount() - boundaryNodes_);
  for (const RegionMesh& region : regions_) {
    const TetMesh& mesh = region.mesh;
    for (std::size_t i = region.boundaryNodes; i < mesh.points.size(); ++i) {
      bytes_.position(mesh.points[i]);
    }
  }
  std::vector<std::uint32_t> elements(meshes.tetrahedronCount());
  std::iota(elements.begin(), elements.end(), 0U);
  bytes_.indices(elements);
  ElementWriter writer(bytes_);
  std::size_t firstNode = boundaryNodes_;
  for (const RegionMesh& region : regions_) {
    const NodeNames names{region.nodeOf, static_cast<std::uint32_t>(firstNode)};
    for (std::size_t t = 0; t < region.mesh.tetrahedra.size(); ++t) {
      writer.write(region.mesh.tetrahedra[t], region.mesh.regions[t],
                   [&](NodeId node) { return names.of(node); });
    }
    firstNode += region.innerNodeCount();
  }
}

/// Numbers ascend with the indices in the region.
void SweepRecorder::writeIndices(const std::vector<std::uint32_t>& own,
                                 const std::vector<std::uint32_t>& numbers) {
  std::vector<std::uint32_t> named;
  named.reserve(own.size());
  for (const std::uint32_t index : own) named.push_back(numbers[index]);
  bytes_.indices(named);
}

void SweepRecorder::writeGeometry(const TetComplex& mesh, const Changes& changes) {
  writeIndices(changes.movedNodes, nodeNumbers_);
  for (const std::uint32_t node : changes.movedNodes) {
    const Vec3 move = mesh.position(NodeId(node)) - positions_[node];
    for (int axis = 0; axis < 3; ++axis) bytes_.shorterNumber(move[axis]);
  }
  bytes_.varint(mesh.nodeCount() - positions_.size());
  for (std::size_t node = positions_.size(); node < mesh.nodeCount(); ++node) {
    bytes_.position(mesh.position(NodeId(node)));
  }
  writeIndices(changes.removed, elementNumbers_);
  writeIndices(changes.made, elementNumbers_);
  ElementWriter writer(bytes_);
  for (const std::uint32_t slot : changes.made) {
    const TetId tet(slot);
    writer.write(mesh.element(tet).nodes, mesh.regionOf(tet),
                 [&](NodeId node) { return nodeNumbers_[node.index()]; });
  }
}

std::unique_ptr<SweepObserver> makeSweepRecorder(TraceBytes& bytes) {
  return std::make_unique<SweepRecorder>(bytes);
}

}  // namespace tetrafront
