#include "volume/volume_mesher.h"

#include <algorithm>
#include <cmath>

#include "geom/predicates.h"
#include "volume/stall_diagnostic.h"

namespace tetrafront {
namespace {

/// Cost limits of the front and of its relaxed rules, as FrontAdvance::step() counts cost: per
/// element, per triangle of the boundary, and a constant for small models. Well shaped boundaries
/// take 1 to 2 per element. Among needles, each face has hundreds of others near it, and the exact
/// fill closes what the rules leave there at less cost. On a plate with a hundred ear-clipped
/// holes, a fifth, a tenth and a fortieth of kFrontCost moved time from the front to the exact fill
/// without reducing the total.
struct CostLimit {
  std::uint64_t perElement;
  std::uint64_t perTriangle;
  std::uint64_t extra;
  [[nodiscard]] std::uint64_t of(std::size_t elements, std::size_t triangles) const {
    return perElement * elements + perTriangle * triangles + extra;
  }
};
constexpr CostLimit kRelaxedCost{16, 0, 200'000};
constexpr CostLimit kFrontCost{200, 10, 100'000};

Vec3 boundaryNode(const SurfaceMesh& surface, NodeId node) {
  const double* p = surface.points.data() + 3 * node.index();
  return {p[0], p[1], p[2]};
}

NodeTriple boundaryTriangle(const SurfaceMesh& surface, std::size_t triangle) {
  const std::uint32_t* n = surface.triangles.data() + 3 * triangle;
  return {NodeId(n[0]), NodeId(n[1]), NodeId(n[2])};
}

double rootMeanSquareEdge(const SurfaceMesh& surface, std::size_t triangle) {
  const NodeTriple n = boundaryTriangle(surface, triangle);
  double squares = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = boundaryNode(surface, n[(k + 1) % 3]) - boundaryNode(surface, n[k]);
    squares += glm::dot(edge, edge);
  }
  return std::sqrt(squares / 3.0);
}

double medianSize(const SurfaceMesh& surface) {
  std::vector<double> sizes;
  sizes.reserve(surface.triangles.size() / 3);
  for (std::size_t t = 0; t < surface.triangles.size() / 3; ++t) {
    sizes.push_back(rootMeanSquareEdge(surface, t));
  }
  if (sizes.empty()) return 1.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle > 0.0 ? *middle : 1.0;
}

Vec3 lowestCorner(const SurfaceMesh& surface) {
  Vec3 low = surface.points.empty() ? Vec3(0.0) : boundaryNode(surface, NodeId(0U));
  for (std::size_t i = 0; i < surface.points.size() / 3; ++i) {
    low = glm::min(low, boundaryNode(surface, NodeId(i)));
  }
  return low;
}

double sixVolumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

}  // namespace

template <class Trace>
BasicVolumeMesher<Trace>::BasicVolumeMesher(const SurfaceMesh& boundary, const SizeField& field,
                                            const MeshOptions& options)
    : boundary_(boundary),
      field_(field),
      maxTetrahedra_(options.maxTetrahedra),
      front_(medianSize(boundary), lowestCorner(boundary), options.order),
      advance_(front_, elements_, field, options.filters),
      recovery_(front_, elements_, advance_, options.order, options.exactFillOnly),
      exactFillOnly_(options.exactFillOnly),
      boundaryNodes_(boundary.points.size() / 3) {
  for (std::size_t i = 0; i < boundaryNodes_; ++i) {
    front_.addNode(boundaryNode(boundary, NodeId(i)), 0);
  }
  checkedNodes_ = boundaryNodes_;
}

template <class Trace>
MeshStatus BasicVolumeMesher<Trace>::advance(std::uint32_t budget) {
  const std::uint64_t exactBefore = exactPredicateCount();
  switch (stage_) {
    case Stage::kSetUp:
      setUp(budget);
      break;
    case Stage::kAdvance:
      advanceFront(budget);
      break;
    case Stage::kRecover:
      recover(budget);
      break;
    case Stage::kFinished:
      break;
  }
  exactPredicates_ += exactPredicateCount() - exactBefore;
  return status_;
}

template <class Trace>
void BasicVolumeMesher<Trace>::setUp(std::uint32_t budget) {
  const std::size_t count = boundary_.triangles.size() / 3;
  const std::size_t end = nextTriangle_ + std::min<std::size_t>(budget, count - nextTriangle_);
  const Vec3 origin = count > 0 ? boundaryNode(boundary_, NodeId(0U)) : Vec3(0.0);
  for (; nextTriangle_ < end; ++nextTriangle_) {
    const NodeTriple n = boundaryTriangle(boundary_, nextTriangle_);
    enclosedVolume_ += glm::dot(front_.node(n[0]) - origin,
                                glm::cross(front_.node(n[1]) - origin, front_.node(n[2]) - origin));
    // Query the size field in the order of the list: consecutive triangles are close to each other,
    // so the walks are short.
    static_cast<void>(field_.covers(front_.node(n[0]), coverHint_));
    front_.addFace(frontFaceOf(boundary_, nextTriangle_),
                   boundary_.triangleRegions[2 * nextTriangle_], coverHint_, !exactFillOnly_);
  }
  if (nextTriangle_ < count) return;
  if constexpr (Trace::kOn) advance_.trace().recorder->beginPass(front_);
  stage_ = Stage::kAdvance;
}

template <class Trace>
void BasicVolumeMesher<Trace>::advanceFront(std::uint32_t budget) {
  const std::size_t triangles = boundary_.triangles.size() / 3;
  // Check the limits after every step, so that the stopping point does not depend on the slice
  // length.
  while (budget > 0 && stage_ == Stage::kAdvance && !front_.isQueueEmpty()) {
    const std::size_t elementsBefore = elements_.size();
    const std::uint64_t relaxed = advance_.counters().relaxedCost;
    const std::uint32_t cost =
        advance_.step(relaxed <= kRelaxedCost.of(elements_.size(), triangles));
    budget -= std::min(cost, budget);
    frontCost_ += cost;
    if (frontCost_ > kFrontCost.of(elements_.size(), triangles)) front_.clearQueue();
    measureNewElements();
    progress_.recordStep(elements_.size() > elementsBefore, front_.activeCount());
    checkNewNodes();
    if (stage_ == Stage::kAdvance && elements_.size() > maxTetrahedra_) stopAtLimit();
    if (stage_ == Stage::kAdvance &&
        progress_.isStuck(filledVolume_, enclosedVolume_, front_.extent())) {
      stall();
    }
  }
  if (stage_ == Stage::kAdvance && front_.isQueueEmpty()) beginRecovery();
}

template <class Trace>
void BasicVolumeMesher<Trace>::beginRecovery() {
  stage_ = Stage::kRecover;
  const std::size_t triangles = boundary_.triangles.size() / 3;
  if (triangles == 0) return;
  openShare_ = static_cast<double>(front_.activeCount()) / static_cast<double>(triangles);
}

template <class Trace>
void BasicVolumeMesher<Trace>::recover(std::uint32_t budget) {
  using State = typename Recovery<Trace>::State;
  const State state = recovery_.advance(budget);
  if (state == State::kRunning) return;
  checkNewNodes();
  if (stage_ == Stage::kFinished) return;
  if (state == State::kClosed) return finish(MeshStatus::kDone);
  stall();
}

template <class Trace>
void BasicVolumeMesher<Trace>::stall() {
  diagnostics_.push_back(describeStall(front_, boundary_));
  finish(MeshStatus::kStalled);
}

template <class Trace>
void BasicVolumeMesher<Trace>::measureNewElements() {
  for (; measuredElements_ < elements_.size(); ++measuredElements_) {
    const NodeQuad& n = elements_.nodes[measuredElements_];
    filledVolume_ +=
        sixVolumes(front_.node(n[0]), front_.node(n[1]), front_.node(n[2]), front_.node(n[3]));
  }
}

template <class Trace>
void BasicVolumeMesher<Trace>::stopAtLimit() {
  Diagnostic tooMany;
  tooMany.code = DiagnosticCode::kTooManyElements;
  // Share of the volume: at the limit the elements may fill almost nothing, and the estimate divides by the share.
  constexpr double kMinFraction = 1e-9;
  const double expected =
      static_cast<double>(elements_.size()) / std::max(filledFraction(), kMinFraction);
  tooMany.values = {expected, static_cast<double>(maxTetrahedra_)};
  tooMany.hasPosition = true;
  for (const NodeId node : elements_.nodes.back()) tooMany.position += front_.node(node) * 0.25;
  diagnostics_.push_back(std::move(tooMany));
  finish(MeshStatus::kStalled);
}

/// Checks that the background grid covers each new node (step F1).
template <class Trace>
void BasicVolumeMesher<Trace>::checkNewNodes() {
  for (; checkedNodes_ < front_.nodes().size(); ++checkedNodes_) {
    const Vec3& position = front_.node(NodeId(checkedNodes_));
    FieldHint hint = front_.hint(NodeId(checkedNodes_));
    if (field_.covers(position, hint)) continue;
    Diagnostic outside;
    outside.code = DiagnosticCode::kOutsideBackgroundGrid;
    outside.hasPosition = true;
    outside.position = position;
    diagnostics_.push_back(std::move(outside));
    return finish(MeshStatus::kInvalidInput);
  }
}

template <class Trace>
void BasicVolumeMesher<Trace>::finish(MeshStatus status) {
  status_ = status;
  stage_ = Stage::kFinished;
  if constexpr (Trace::kOn) advance_.trace().recorder->endPass();
}

/// Among needles, little volume is filled when the front reaches its cost limit, so the cost counts
/// too.
template <class Trace>
double BasicVolumeMesher<Trace>::frontFraction() const {
  const std::uint64_t limit = kFrontCost.of(elements_.size(), boundary_.triangles.size() / 3);
  const double spent = static_cast<double>(frontCost_) / static_cast<double>(limit);
  return std::max(filledFraction(), std::min(spent, 1.0));
}

template <class Trace>
double BasicVolumeMesher<Trace>::filledFraction() const {
  if (!(enclosedVolume_ > 0.0)) return 0.0;
  return std::clamp(filledVolume_ / enclosedVolume_, 0.0, 1.0);
}

template <class Trace>
VolumeMesh BasicVolumeMesher<Trace>::mesh() const {
  const std::span<const Vec3> nodes = front_.nodes();
  std::vector<NodeId> newId(nodes.size());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_.removed[e] != 0) continue;
    for (const NodeId node : elements_.nodes[e]) newId[node.index()] = NodeId(0U);
  }
  VolumeMesh mesh;
  mesh.points.reserve(3 * nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i >= boundaryNodes_ && newId[i].isNone()) continue;
    newId[i] = NodeId(mesh.points.size() / 3);
    mesh.points.insert(mesh.points.end(), {nodes[i].x, nodes[i].y, nodes[i].z});
  }
  mesh.tetrahedra.reserve(4 * elements_.liveCount());
  mesh.regions.reserve(elements_.liveCount());
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    if (elements_.removed[e] != 0) continue;
    for (const NodeId node : elements_.nodes[e])
      mesh.tetrahedra.push_back(newId[node.index()].value);
    mesh.regions.push_back(elements_.regions[e]);
  }
  for (const FaceId face : front_.activeFaces()) {
    for (const NodeId node : front_.face(face).nodes)
      mesh.front.push_back(newId[node.index()].value);
  }
  for (std::size_t t = nextTriangle_; t < boundary_.triangles.size() / 3; ++t) {
    for (const NodeId node : frontFaceOf(boundary_, t)) mesh.front.push_back(node.value);
  }
  return mesh;
}

template <class Trace>
void BasicVolumeMesher<Trace>::appendFront(std::vector<double>& corners) const {
  const auto append = [&](const NodeTriple& face) {
    for (const NodeId id : face) {
      const Vec3& position = front_.node(id);
      corners.insert(corners.end(), {position.x, position.y, position.z});
    }
  };
  for (const FaceId face : front_.activeFaces()) append(front_.face(face).nodes);
  for (std::size_t t = nextTriangle_; t < boundary_.triangles.size() / 3; ++t) {
    append(frontFaceOf(boundary_, t));
  }
}

template <class Trace>
RecoverySummary BasicVolumeMesher<Trace>::recovery() const {
  RecoverySummary summary = recovery_.summary();
  summary.relaxed = static_cast<std::uint32_t>(advance_.counters().relaxed);
  return summary;
}

template <class Trace>
FrontCounters BasicVolumeMesher<Trace>::counters() const {
  FrontCounters counters;
  counters.pops = advance_.counters().pops;
  counters.gatheredFaces = advance_.counters().gatheredFaces;
  counters.candidatesTried = advance_.counters().candidatesTried;
  counters.facesTested = advance_.crossingCounters().facesTested;
  counters.facesAnalysed = advance_.crossingCounters().facesAnalysed;
  counters.exactPredicates = exactPredicates_;
  return counters;
}

template class BasicVolumeMesher<NullTrace>;
template class BasicVolumeMesher<ClockTrace>;
template class BasicVolumeMesher<RecordingTrace>;

}  // namespace tetrafront
