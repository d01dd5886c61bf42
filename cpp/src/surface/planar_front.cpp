#include "surface/planar_front.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/ids.h"
#include "base/sort.h"

namespace tetrafront {

namespace {

/// New sides are as long as the field asks, but not wilder than this against the base side
/// (Peraire's rule): sizes then change gradually where boundary and field disagree.
constexpr double kShortestToBase = 0.55;
constexpr double kLongestToBase = 2.0;
/// A node this near to the ideal point, in new sides, is used in its stead. With this and the
/// clearance, edges come out as long as asked for on average; larger ones give longer edges.
constexpr double kCaptureRadius = 0.55;
/// A new node keeps this distance, in new sides, from every side of the front.
constexpr double kClearance = 0.55;
/// Candidates are sought this far around the ideal point, in new sides.
constexpr double kSearchRadius = 1.7;
/// How much farther in each pass; the last pass takes in the whole front.
constexpr double kSearchGrowth = 4.0;
constexpr std::uint8_t kLastPass = 2;
/// Triangles of less shape than this are put off to a later pass, when more of the front is known.
constexpr double kWorstFirstShape = 0.3;
/// Heights tried for a new node, as shares of the ideal one.
constexpr double kLowerHeight = 0.6;
/// Half the height of the ideal triangle's centre.
constexpr double kCentreHeight = 0.35;
/// The gathered box is wider than its content by this, so that rounding in the tree drops nothing.
constexpr double kBoxMargin = 1e-9;

}  // namespace

PlanarFront::PlanarFront(const PatchMetric& metric, PlanarMesh& mesh)
    : metric_(&metric), mesh_(&mesh), tree_(PlaneBox{}) {
  region_ = PlaneBox::of(mesh.plane.front(), mesh.plane.front());
  for (const Vec2& node : mesh.plane) region_.include(node);
  tree_ = Quadtree(region_);
  for (std::size_t i = 0; i + 1 < mesh.sides.size(); i += 2)
    addSide(mesh.sides[i], mesh.sides[i + 1], 0);
}

// ---- the front's book-keeping ------------------------------------------------------------------

std::uint64_t PlanarFront::keyOf(const Side& side, double size) {
  // Smallest first, in classes of a factor of sqrt(2) (the exponent of the squared size); inside
  // a class layer by layer, so that the front stays smooth; then first come, first served.
  const double squared = size * size;
  const std::uint64_t sizeClass = std::bit_cast<std::uint64_t>(squared) >> 52U;
  return (std::uint64_t{side.pass} << 62U) | (sizeClass << 48U) |
         (std::uint64_t{side.layer} << 32U) | sequence_++;
}

void PlanarFront::addSide(std::uint32_t from, std::uint32_t to, std::uint16_t layer) {
  std::uint32_t id = 0;
  if (freeSides_.empty()) {
    id = static_cast<std::uint32_t>(sides_.size());
    sides_.push_back({});
    heap_.reserveIds(sides_.size());
  } else {
    id = freeSides_.back();
    freeSides_.pop_back();
  }
  sides_[id] = {from, to, layer, 0};
  tree_.insert(id, PlaneBox::of(mesh_->plane[from], mesh_->plane[to]));
  heap_.push(id, keyOf(sides_[id], 0.5 * (mesh_->sizes[from] + mesh_->sizes[to])));
}

void PlanarFront::removeSide(std::uint32_t id) {
  tree_.remove(id);
  heap_.remove(id);
  freeSides_.push_back(id);
}

MeshStatus PlanarFront::advance(std::uint32_t budget) {
  for (std::uint32_t step = 0; step < budget && !heap_.empty(); ++step) {
    const std::uint32_t id = heap_.pop();
    if (completeSide(id)) continue;
    Side& side = sides_[id];
    if (side.pass == kLastPass) {
      stalled_ = true;
      tree_.remove(id);
      freeSides_.push_back(id);
      continue;
    }
    ++side.pass;
    heap_.push(id, keyOf(side, 0.5 * (mesh_->sizes[side.from] + mesh_->sizes[side.to])));
  }
  if (!heap_.empty()) return MeshStatus::kRunning;
  return stalled_ ? MeshStatus::kStalled : MeshStatus::kDone;
}

// ---- F5: completing the base side --------------------------------------------------------------

bool PlanarFront::completeSide(std::uint32_t id) {
  Base base = examine(id);
  gather(base);
  rankCandidates(base);
  return tryCandidates(base);
}

PlanarFront::Base PlanarFront::examine(std::uint32_t id) {
  Base base{};
  base.id = id;
  base.side = sides_[id];
  const Vec2 from = mesh_->plane[base.side.from];
  const Vec2 along = mesh_->plane[base.side.to] - from;
  base.middle = from + 0.5 * along;
  // The metric first in the middle of the side, then where the triangle will be.
  Vec2 at = base.middle;
  for (int round = 0; round < 2; ++round) {
    base.sample = metric_->sample(at, hint_);
    const Metric2& metric = base.sample.metric;
    const Vec2 image = metric.apply(along);
    base.length = std::sqrt(glm::dot(along, image));
    const Vec2 across(-image.y, image.x);
    base.inward = across / std::sqrt(metric.dot(across, across));
    at = base.middle +
         kCentreHeight *
             std::clamp(1.0, kShortestToBase * base.length, kLongestToBase * base.length) *
             base.inward;
    at = metric_->surface().clamped({std::clamp(at.x, region_.low.x, region_.high.x),
                                     std::clamp(at.y, region_.low.y, region_.high.y)});
  }
  base.wanted = std::clamp(1.0, kShortestToBase * base.length, kLongestToBase * base.length);
  placeIdealPoint(base, std::sqrt(base.wanted * base.wanted - 0.25 * base.length * base.length));
  return base;
}

void PlanarFront::placeIdealPoint(Base& base, double height) const {
  base.ideal = base.middle + height * base.inward;
}

void PlanarFront::gather(const Base& base) {
  PlaneBox box = PlaneBox::of(mesh_->plane[base.side.from], mesh_->plane[base.side.to]);
  if (base.side.pass == kLastPass) {
    box.include(region_.low);
    box.include(region_.high);
  } else {
    // The box of the disc around the ideal point in the metric: half widths from G's inverse.
    const double growth = base.side.pass == 0 ? 1.0 : kSearchGrowth;
    const double radius = growth * kSearchRadius * std::max(base.wanted, base.length);
    const Metric2& metric = base.sample.metric;
    const double determinant = metric.determinant();
    const Vec2 half(radius * std::sqrt(metric.yy / determinant),
                    radius * std::sqrt(metric.xx / determinant));
    box.include(base.ideal - half);
    box.include(base.ideal + half);
  }
  const Vec2 margin = kBoxMargin * (box.high - box.low);
  near_.clear();
  tree_.query({box.low - margin, box.high + margin}, near_);

  stamps_.resize(mesh_->plane.size(), 0);
  ++stamp_;
  nearNodes_.clear();
  stamps_[base.side.from] = stamp_;
  stamps_[base.side.to] = stamp_;
  for (const std::uint32_t id : near_) {
    for (const std::uint32_t node : {sides_[id].from, sides_[id].to}) {
      if (stamps_[node] == stamp_ || !box.holds(mesh_->plane[node])) continue;
      stamps_[node] = stamp_;
      nearNodes_.push_back(node);
    }
  }
}

double PlanarFront::distance(const Base& base, const Vec2& a, const Vec2& b) const {
  const Vec2 d = b - a;
  return std::sqrt(base.sample.metric.dot(d, d));
}

double PlanarFront::shape(const Base& base, const Vec2& apex) const {
  constexpr double kTwoRootThree = 3.4641016151377544;
  const Vec2 a = mesh_->plane[base.side.from];
  const Vec2 b = mesh_->plane[base.side.to];
  const Vec2 ab = b - a;
  const Vec2 ap = apex - a;
  const Vec2 bp = apex - b;
  const Metric2& metric = base.sample.metric;
  const double doubleArea = std::sqrt(metric.determinant()) * (ab.x * ap.y - ab.y * ap.x);
  return kTwoRootThree * doubleArea /
         (metric.dot(ab, ab) + metric.dot(ap, ap) + metric.dot(bp, bp));
}

void PlanarFront::rankCandidates(const Base& base) {
  candidates_.clear();
  for (const std::uint32_t node : nearNodes_) {
    const double away = distance(base, mesh_->plane[node], base.ideal) / base.wanted;
    const bool captured = away < kCaptureRadius;
    const double worth = shape(base, mesh_->plane[node]);
    if (!captured && base.side.pass == 0 && worth < kWorstFirstShape) continue;
    // First the nodes that stand in for the ideal point, nearest first; then the ideal point;
    // then whatever makes the best shape.
    candidates_.push_back({captured ? away : 2.0 - worth, node});
  }
  candidates_.push_back({kCaptureRadius, kNoIndex});
  sortFew(candidates_, [](const Candidate& a, const Candidate& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.node < b.node;
  });
}

bool PlanarFront::tryCandidates(const Base& base) {
  for (const Candidate& candidate : candidates_) {
    if (candidate.node == kNoIndex) {
      if (tryNewNode(base)) return true;
      continue;
    }
    if (mesh_->turn(base.side.from, base.side.to, candidate.node) <= 0) continue;
    if (mesh_->sameNode(candidate.node, base.side.from) ||
        mesh_->sameNode(candidate.node, base.side.to))
      continue;
    if (crossesFront(base, candidate.node)) continue;
    accept(base, candidate.node);
    return true;
  }
  return false;
}

bool PlanarFront::tryNewNode(const Base& base) {
  Base lowered = base;
  for (const double share : {1.0, kLowerHeight}) {
    lowered.ideal = base.middle + share * (base.ideal - base.middle);
    if (!region_.holds(lowered.ideal) || tooClose(lowered)) continue;
    const std::uint32_t node =
        mesh_->addNode(lowered.ideal, base.sample.position, base.sample.size);
    if (mesh_->turn(base.side.from, base.side.to, node) > 0 && !crossesFront(lowered, node)) {
      const PlaneSample sample = metric_->sample(lowered.ideal, hint_);
      mesh_->places[node] = sample.position;
      mesh_->sizes[node] = sample.size;
      accept(lowered, node);
      return true;
    }
    mesh_->dropLastNode();
  }
  return false;
}

bool PlanarFront::tooClose(const Base& base) const {
  const Metric2& metric = base.sample.metric;
  const double clearance = kClearance * base.wanted;
  for (const std::uint32_t id : near_) {
    if (id == base.id) continue;
    const Vec2 from = mesh_->plane[sides_[id].from];
    const Vec2 along = mesh_->plane[sides_[id].to] - from;
    const Vec2 offset = base.ideal - from;
    const double t = std::clamp(metric.dot(along, offset) / metric.dot(along, along), 0.0, 1.0);
    const Vec2 gap = offset - t * along;
    if (metric.dot(gap, gap) < clearance * clearance) return true;
  }
  return false;
}

// ---- F5.3: the crossing test -------------------------------------------------------------------

bool PlanarFront::crossesFront(const Base& base, std::uint32_t apex) const {
  const std::uint32_t a = base.side.from;
  const std::uint32_t b = base.side.to;
  PlaneBox box = PlaneBox::of(mesh_->plane[a], mesh_->plane[b]);
  box.include(mesh_->plane[apex]);
  return std::ranges::any_of(near_, [&](std::uint32_t id) {
    if (id == base.id) return false;
    const Side& side = sides_[id];
    return box.meets(PlaneBox::of(mesh_->plane[side.from], mesh_->plane[side.to])) &&
           sideBlocks(a, b, apex, side);
  });
}

bool PlanarFront::sideBlocks(std::uint32_t a, std::uint32_t b, std::uint32_t apex,
                             const Side& side) const {
  const PlanarMesh& mesh = *mesh_;
  const auto isCorner = [&](std::uint32_t node) { return node == a || node == b || node == apex; };
  const auto inTriangle = [&](std::uint32_t node) {
    return mesh.turn(a, b, node) >= 0 && mesh.turn(b, apex, node) >= 0 &&
           mesh.turn(apex, a, node) >= 0;
  };
  const bool fromShared = isCorner(side.from);
  const bool toShared = isCorner(side.to);
  if (fromShared && toShared) {
    // A side of the front that the triangle completes runs against its new side; one that runs
    // along it would be doubled.
    return (side.from == a && side.to == apex) || (side.from == apex && side.to == b);
  }
  if (!fromShared && inTriangle(side.from)) return true;
  if (!toShared && inTriangle(side.to)) return true;

  const auto blocksNewSide = [&](std::uint32_t from, std::uint32_t to) {
    const bool sharesFrom = side.from == from || side.from == to;
    const bool sharesTo = side.to == from || side.to == to;
    if (!sharesFrom && !sharesTo) return segmentsTouch(mesh, from, to, side.from, side.to);
    const std::uint32_t shared = sharesFrom ? side.from : side.to;
    const std::uint32_t sideEnd = sharesFrom ? side.to : side.from;
    return segmentsOverlap(mesh, shared, shared == from ? to : from, sideEnd);
  };
  return blocksNewSide(a, apex) || blocksNewSide(apex, b);
}

// ---- F6-F8 -------------------------------------------------------------------------------------

void PlanarFront::accept(const Base& base, std::uint32_t apex) {
  mesh_->triangles.insert(mesh_->triangles.end(), {base.side.from, base.side.to, apex});
  const auto layer =
      static_cast<std::uint16_t>(std::min<std::uint32_t>(base.side.layer + 1U, 0xffffU));
  removeSide(base.id);
  closeOrAdd(base.side.from, apex, layer);
  closeOrAdd(apex, base.side.to, layer);
}

void PlanarFront::closeOrAdd(std::uint32_t from, std::uint32_t to, std::uint16_t layer) {
  const auto opposite = std::ranges::find_if(
      near_, [&](std::uint32_t id) { return sides_[id].from == to && sides_[id].to == from; });
  if (opposite == near_.end()) {
    addSide(from, to, layer);
    return;
  }
  removeSide(*opposite);
}

}  // namespace tetrafront
