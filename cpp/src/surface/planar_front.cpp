#include "surface/planar_front.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/scrambled.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "surface/rules.h"

namespace tetrafront {

namespace {

/// Bits of a key below the number of failed attempts.
constexpr int kPassShift = 62;

}  // namespace

template <class Trace>
BasicPlanarFront<Trace>::BasicPlanarFront(const PatchMetric& metric, PlanarMesh& mesh, Trace trace)
    : metric_(&metric), mesh_(&mesh), tree_(PlaneBox{}), trace_(trace) {
  region_ = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
  for (const Vec2& node : mesh.plane) region_.include(node);
  tree_ = Quadtree(region_);
  for (const PlanarMesh::Side& side : mesh.sides) addEdge(side.from, side.to, 0);
}

// ---- bookkeeping of the front ------------------------------------------------------------------

/// Fewer failed attempts come first. In the layered order of every run, smallest size first, in classes of a factor of
/// sqrt(2) (the exponent of the squared size); within a class layer by layer, so that the front stays smooth; then in
/// order of creation.
template <class Trace>
std::uint64_t BasicPlanarFront<Trace>::keyOf(const Edge& edge) {
  const PlanarRules& rules = trace_.rules();
  const std::uint64_t pass = std::uint64_t{edge.pass} << kPassShift;
  const std::uint64_t sequence = sequence_++;
  switch (rules.order) {
    case FrontOrder::kLayered:
      return pass | (sizeClassOf(edge) << 48U) | (std::uint64_t{edge.layer} << 32U) | sequence;
    case FrontOrder::kSmallestFirst: {
      // The bits of a positive float, read as an integer, grow with it; there are 31 of them.
      const auto length = static_cast<float>(
          glm::length(mesh_->positionOf(edge.to) - mesh_->positionOf(edge.from)));
      return pass | (std::uint64_t{std::bit_cast<std::uint32_t>(length)} << 31U) | sequence;
    }
    case FrontOrder::kFirstIn:
      return pass | sequence;
    case FrontOrder::kRandom:
      return pass | (scrambled((std::uint64_t{rules.seed} << 32U) + sequence) &
                     ((std::uint64_t{1} << kPassShift) - 1));
  }
  return pass | sequence;
}

template <class Trace>
std::uint64_t BasicPlanarFront<Trace>::sizeClassOf(const Edge& edge) const {
  const double size = 0.5 * (mesh_->sizeOf(edge.from) + mesh_->sizeOf(edge.to));
  const double squared = size * size;
  return std::bit_cast<std::uint64_t>(squared) >> 52U;
}

template <class Trace>
std::uint32_t BasicPlanarFront<Trace>::addEdge(PlanarNodeId from, PlanarNodeId to,
                                               std::uint16_t layer) {
  std::uint32_t id = 0;
  if (freeEdges_.empty()) {
    id = static_cast<std::uint32_t>(edges_.size());
    edges_.emplace_back();
    heap_.reserveIds(edges_.size());
  } else {
    id = freeEdges_.back();
    freeEdges_.pop_back();
  }
  edges_[id] = {from, to, layer, 0};
  tree_.insert(id, PlaneBox::of(mesh_->planeOf(from), mesh_->planeOf(to)));
  heap_.push(id, keyOf(edges_[id]));
  return id;
}

template <class Trace>
void BasicPlanarFront<Trace>::removeEdge(std::uint32_t id) {
  tree_.remove(id);
  heap_.remove(id);
  freeEdges_.push_back(id);
}

template <class Trace>
bool BasicPlanarFront<Trace>::advance(std::uint32_t budget) {
  for (std::uint32_t step = 0; step < budget && !heap_.empty(); ++step) {
    const std::uint32_t id = heap_.pop();
    if (completeEdge(id)) continue;
    Edge& edge = edges_[id];
    const bool comesAgain = edge.pass < kLastPass && trace_.rules().experiment.relaxation;
    trace_->postponed(comesAgain ? edge.pass + 1U : SurfaceRecorder::kNoNextPass);
    // It stays an obstacle, without which the front would run over what is filled; a later triangle may still close it.
    if (!comesAgain) continue;
    ++edge.pass;
    heap_.push(id, keyOf(edge));
  }
  return heap_.empty();
}

// ---- F5: complete the base edge ----------------------------------------------------------------

template <class Trace>
bool BasicPlanarFront<Trace>::completeEdge(std::uint32_t id) {
  const Base base = makeBase(id);
  gather(base);
  rankCandidates(base);
  recordBase(base);
  return tryCandidates(base);
}

template <class Trace>
typename BasicPlanarFront<Trace>::Base BasicPlanarFront<Trace>::makeBase(std::uint32_t id) {
  Base base{};
  base.id = id;
  base.edge = edges_[id];
  const Vec2 from = mesh_->planeOf(base.edge.from);
  const Vec2 along = mesh_->planeOf(base.edge.to) - from;
  base.middle = from + 0.5 * along;
  // Sample the metric at the middle of the edge, then near the centre of the target triangle.
  Vec2 at = base.middle;
  for (int round = 0; round < 2; ++round) {
    base.sample = metric_->sample(at, hint_);
    const Metric2& metric = base.sample.metric;
    const Vec2 image = metric.apply(along);
    base.length = std::sqrt(glm::dot(along, image));
    const Vec2 normal(-image.y, image.x);
    base.inward = normal / std::sqrt(metric.dot(normal, normal));
    base.targetLength =
        std::clamp(1.0, kMinLengthRatio * base.length, kMaxLengthRatio * base.length);
    at = base.middle + kCentreHeight * base.targetLength * base.inward;
    at = metric_->surface().clamped({std::clamp(at.x, region_.low.x, region_.high.x),
                                     std::clamp(at.y, region_.low.y, region_.high.y)});
  }
  const double height =
      std::sqrt(base.targetLength * base.targetLength - 0.25 * base.length * base.length);
  base.ideal = base.middle + trace_.rules().height * height * base.inward;
  return base;
}

template <class Trace>
void BasicPlanarFront<Trace>::gather(const Base& base) {
  PlaneBox box = PlaneBox::of(mesh_->planeOf(base.edge.from), mesh_->planeOf(base.edge.to));
  if (base.edge.pass == kLastPass) {
    box.include(region_.low);
    box.include(region_.high);
  } else {
    // The box of a disc in the metric: its half widths follow from the inverse of G.
    const double growth = base.edge.pass == 0 ? 1.0 : kSearchGrowth;
    const double radius = growth * kSearchRadius * std::max(base.targetLength, base.length);
    const Metric2& metric = base.sample.metric;
    const double determinant = metric.determinant();
    const Vec2 half(radius * std::sqrt(metric.yy / determinant),
                    radius * std::sqrt(metric.xx / determinant));
    box.include(base.ideal - half);
    box.include(base.ideal + half);
  }
  const Vec2 margin = kSearchBoxMargin * (box.high - box.low);
  nearEdges_.clear();
  tree_.query({box.low - margin, box.high + margin}, nearEdges_);

  stamps_.resize(mesh_->plane.size(), 0);
  ++stamp_;
  nearNodes_.clear();
  stamps_[base.edge.from.index()] = stamp_;
  stamps_[base.edge.to.index()] = stamp_;
  for (const std::uint32_t id : nearEdges_) {
    for (const PlanarNodeId node : {edges_[id].from, edges_[id].to}) {
      if (stamps_[node.index()] == stamp_ || !box.holds(mesh_->planeOf(node))) continue;
      stamps_[node.index()] = stamp_;
      nearNodes_.push_back(node);
    }
  }
}

template <class Trace>
double BasicPlanarFront<Trace>::distance(const Base& base, const Vec2& a, const Vec2& b) const {
  const Vec2 d = b - a;
  return std::sqrt(base.sample.metric.dot(d, d));
}

template <class Trace>
double BasicPlanarFront<Trace>::shape(const Base& base, const Vec2& apex) const {
  constexpr double kTwoRootThree = 3.4641016151377544;
  const Vec2 a = mesh_->planeOf(base.edge.from);
  const Vec2 b = mesh_->planeOf(base.edge.to);
  const Vec2 ab = b - a;
  const Vec2 ap = apex - a;
  const Vec2 bp = apex - b;
  const Metric2& metric = base.sample.metric;
  const double doubleArea = std::sqrt(metric.determinant()) * (ab.x * ap.y - ab.y * ap.x);
  return kTwoRootThree * doubleArea /
         (metric.dot(ab, ab) + metric.dot(ap, ap) + metric.dot(bp, bp));
}

/// Nodes that replace the ideal point come first, the nearest one leading; then the ideal point; then the
/// other nodes, best shape first.
template <class Trace>
void BasicPlanarFront<Trace>::rankCandidates(const Base& base) {
  candidates_.clear();
  for (const PlanarNodeId node : nearNodes_) {
    const double away = distance(base, mesh_->planeOf(node), base.ideal) / base.targetLength;
    const bool isCaptured = away < kCaptureRadius;
    const double quality = shape(base, mesh_->planeOf(node));
    if (!isCaptured && base.edge.pass == 0 && quality < kMinFirstPassShape) continue;
    candidates_.push_back({isCaptured ? away : 2.0 - quality, node});
  }
  candidates_.push_back({kCaptureRadius, PlanarNodeId{}});
  sortFew(candidates_, [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.node < b.node;
  });
}

template <class Trace>
bool BasicPlanarFront<Trace>::tryCandidates(const Base& base) {
  for (const Candidate& candidate : candidates_) {
    if (candidate.node.isNone()) {
      if (tryNewNode(base)) return true;
      continue;
    }
    const PlanarNodeId node = candidate.node;
    if (mesh_->orientation(base.edge.from, base.edge.to, node) <= 0) {
      trace_->refused(node, PlanarRefusal::kBehind, kNoIndex);
    } else if (mesh_->isSameNode(node, base.edge.from) || mesh_->isSameNode(node, base.edge.to)) {
      trace_->refused(node, PlanarRefusal::kSameNode, kNoIndex);
    } else if (const std::uint32_t crossed = firstCrossed(base, node); crossed != kNoIndex) {
      trace_->refused(node, PlanarRefusal::kCrosses, crossed);
    } else {
      accept(base, node, false);
      return true;
    }
  }
  return false;
}

template <class Trace>
bool BasicPlanarFront<Trace>::tryNewNode(const Base& base) {
  Base lowered = base;
  for (const double height : {1.0, kLowerHeight}) {
    lowered.ideal = base.middle + height * (base.ideal - base.middle);
    if (!region_.holds(lowered.ideal)) {
      trace_->refused({}, PlanarRefusal::kOutside, kNoIndex);
      continue;
    }
    if (const std::uint32_t near = firstTooClose(lowered); near != kNoIndex) {
      trace_->refused({}, PlanarRefusal::kTooClose, near);
      continue;
    }
    const PlanarNodeId node = mesh_->addNode(lowered.ideal, base.sample.position, base.sample.size);
    if (mesh_->orientation(base.edge.from, base.edge.to, node) <= 0) {
      trace_->refused({}, PlanarRefusal::kBehind, kNoIndex);
    } else if (const std::uint32_t crossed = firstCrossed(lowered, node); crossed != kNoIndex) {
      trace_->refused({}, PlanarRefusal::kCrosses, crossed);
    } else {
      const PlaneSample sample = metric_->sample(lowered.ideal, hint_);
      mesh_->positions[node.index()] = sample.position;
      mesh_->sizes[node.index()] = sample.size;
      accept(lowered, node, true);
      return true;
    }
    mesh_->removeLastNode();
  }
  return false;
}

/// Returns an edge of the front that is too close to the ideal point, or kNoIndex.
template <class Trace>
std::uint32_t BasicPlanarFront<Trace>::firstTooClose(const Base& base) const {
  const Metric2& metric = base.sample.metric;
  const double clearance = trace_.rules().experiment.tolerance * kClearance * base.targetLength;
  for (const std::uint32_t id : nearEdges_) {
    if (id == base.id) continue;
    const Vec2 from = mesh_->planeOf(edges_[id].from);
    const Vec2 along = mesh_->planeOf(edges_[id].to) - from;
    const Vec2 offset = base.ideal - from;
    const double t = std::clamp(metric.dot(along, offset) / metric.dot(along, along), 0.0, 1.0);
    const Vec2 gap = offset - t * along;
    if (metric.dot(gap, gap) < clearance * clearance) return id;
  }
  return kNoIndex;
}

// ---- what is recorded --------------------------------------------------------------------------

template <class Trace>
void BasicPlanarFront<Trace>::recordBase(const Base& base) {
  const Edge& edge = base.edge;
  trace_->base({base.id, edge.from, mesh_->planeOf(edge.from), edge.pass,
                static_cast<std::uint32_t>(sizeClassOf(edge)), edge.layer, base.ideal,
                nearEdges_.size(), candidates_.size()},
               base.sample);
}

// ---- F5.3: the crossing test -------------------------------------------------------------------

/// Returns an edge of the front that the triangle of the base edge and the apex would cross, or kNoIndex.
template <class Trace>
std::uint32_t BasicPlanarFront<Trace>::firstCrossed(const Base& base, PlanarNodeId apex) const {
  const PlanarNodeId a = base.edge.from;
  const PlanarNodeId b = base.edge.to;
  PlaneBox box = PlaneBox::of(mesh_->planeOf(a), mesh_->planeOf(b));
  box.include(mesh_->planeOf(apex));
  const auto crossed = std::ranges::find_if(nearEdges_, [&](std::uint32_t id) {
    if (id == base.id) return false;
    const Edge& edge = edges_[id];
    return box.overlaps(PlaneBox::of(mesh_->planeOf(edge.from), mesh_->planeOf(edge.to))) &&
           isBlockedBy(edge, a, b, apex);
  });
  return crossed == nearEdges_.end() ? kNoIndex : *crossed;
}

/// Returns true if the triangle a b apex intersects the edge, except at common nodes.
template <class Trace>
bool BasicPlanarFront<Trace>::isBlockedBy(const Edge& edge, PlanarNodeId a, PlanarNodeId b,
                                          PlanarNodeId apex) const {
  const PlanarMesh& mesh = *mesh_;
  const auto isCorner = [&](PlanarNodeId node) { return node == a || node == b || node == apex; };
  const auto isInTriangle = [&](PlanarNodeId node) {
    return mesh.orientation(a, b, node) >= 0 && mesh.orientation(b, apex, node) >= 0 &&
           mesh.orientation(apex, a, node) >= 0;
  };
  const bool isFromShared = isCorner(edge.from);
  const bool isToShared = isCorner(edge.to);
  if (isFromShared && isToShared) {
    // The triangle closes an edge of the opposite direction, but must not duplicate one of the same direction.
    return (edge.from == a && edge.to == apex) || (edge.from == apex && edge.to == b);
  }
  if (!isFromShared && isInTriangle(edge.from)) return true;
  if (!isToShared && isInTriangle(edge.to)) return true;

  const auto blocksNewEdge = [&](PlanarNodeId from, PlanarNodeId to) {
    const bool sharesFrom = edge.from == from || edge.from == to;
    const bool sharesTo = edge.to == from || edge.to == to;
    if (!sharesFrom && !sharesTo) return segmentsIntersect(mesh, from, to, edge.from, edge.to);
    const PlanarNodeId shared = sharesFrom ? edge.from : edge.to;
    const PlanarNodeId edgeEnd = sharesFrom ? edge.to : edge.from;
    return segmentsOverlap(mesh, shared, shared == from ? to : from, edgeEnd);
  };
  return blocksNewEdge(a, apex) || blocksNewEdge(apex, b);
}

// ---- F6-F8: update the front -------------------------------------------------------------------

template <class Trace>
void BasicPlanarFront<Trace>::accept(const Base& base, PlanarNodeId apex, bool isNew) {
  mesh_->triangles.push_back({base.edge.from, base.edge.to, apex});
  const auto layer =
      static_cast<std::uint16_t>(std::min<std::uint32_t>(base.edge.layer + 1U, 0xffffU));
  removeEdge(base.id);
  const auto change = [&](PlanarNodeId from, PlanarNodeId to) {
    const std::uint32_t id = closeOrAdd(from, to, layer);
    return SurfaceRecorder::EdgeChange{id, edges_[id].from != from};
  };
  const SurfaceRecorder::EdgeChange first = change(base.edge.from, apex);
  const SurfaceRecorder::EdgeChange second = change(apex, base.edge.to);
  trace_->accepted(*mesh_, apex, isNew, {first, second});
}

/// Closes the edge with the opposite direction if it is in the front, else adds the edge. Returns which it was.
template <class Trace>
std::uint32_t BasicPlanarFront<Trace>::closeOrAdd(PlanarNodeId from, PlanarNodeId to,
                                                  std::uint16_t layer) {
  const auto opposite = std::ranges::find_if(
      nearEdges_, [&](std::uint32_t id) { return edges_[id].from == to && edges_[id].to == from; });
  if (opposite == nearEdges_.end()) return addEdge(from, to, layer);
  removeEdge(*opposite);
  return *opposite;
}

template class BasicPlanarFront<NullSurfaceTrace>;
template class BasicPlanarFront<RecordingSurfaceTrace>;

}  // namespace tetrafront
