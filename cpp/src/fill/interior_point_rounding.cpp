#include "fill/interior_point_rounding.h"

#include <algorithm>

#include "fill/star_kernel.h"

namespace tetrafront {
namespace {

/// Maximum number of sweeps over all points; they end earlier if nothing changes.
constexpr int kMaxSweeps = 12;

}  // namespace

InteriorPointRounding::InteriorPointRounding(FillMesh& mesh, std::span<const NodeId> interiorPoints)
    : mesh_(mesh), cone_(mesh, none_), slivers_(mesh) {
  for (const NodeId node : interiorPoints) {
    if (!mesh.at(node).isNone()) points_.push_back(node);
  }
}

bool InteriorPointRounding::allAreDoubles() const {
  return std::all_of(points_.begin(), points_.end(),
                     [&](NodeId node) { return mesh_.points.isDouble(node); });
}

FillState InteriorPointRounding::step() {
  if (next_ == points_.size()) {
    if (sweep_ > 0 && (!changed_ || sweep_ == kMaxSweeps)) {
      return allAreDoubles() ? FillState::kDone : FillState::kFailed;
    }
    if (points_.empty()) return FillState::kDone;
    ++sweep_;
    changed_ = false;
    next_ = 0;
  }
  const NodeId node = points_[next_];
  mesh_.star(node, star_);
  if (removePoint(node)) {
    points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(next_));
    changed_ = true;
    return FillState::kRunning;
  }
  const NodeId moved = movePoint(node);
  if (moved != node) changed_ = true;
  if (!mesh_.points.isDouble(moved) && slivers_.removeAt(moved, points_) > 0) changed_ = true;
  points_[next_++] = moved;
  return FillState::kRunning;
}

double InteriorPointRounding::fraction() const {
  if (points_.empty()) return 1.0;
  const double part = static_cast<double>(next_) / static_cast<double>(points_.size());
  return (std::max(sweep_ - 1, 0) + part) / kMaxSweeps;
}

double InteriorPointRounding::minShapeAround() const {
  double smallest = 1.0;
  for (const TetId id : star_) {
    smallest = std::min(smallest, shapeOf(mesh_.points, mesh_.tet(id).nodes));
  }
  return smallest;
}

/// Collapses the point onto the neighbour that gives the best shapes. A point that already is a
/// double stays unless shapes improve.
bool InteriorPointRounding::removePoint(NodeId node) {
  const std::vector<NodeId> candidates = mesh_.neighboursIn(star_, node);
  const double needed = mesh_.points.isDouble(node) ? minShapeAround() : -1.0;
  for (const std::size_t growth : {std::size_t{0}, kMaxCavityGrowth}) {
    ConeRules rules;
    rules.lost = node;
    rules.maxCavity = growth;
    NodeId best;
    double bestShape = needed;
    for (const NodeId apex : candidates) {
      if (!cone_.plan(apex, star_, rules)) continue;
      const double shape = cone_.minShape();
      if (shape <= bestShape) continue;
      best = apex;
      bestShape = shape;
    }
    if (!best.isNone() && cone_.make(best, star_, rules)) return true;
  }
  return false;
}

/// Moves the point to the best double found in the kernel of its star. If the kernel contains none,
/// tetrahedra around the star, mostly slivers, may join the cavity.
NodeId InteriorPointRounding::movePoint(NodeId node) {
  const NodeId moved = moveWithin(node, 0);
  if (mesh_.points.isDouble(moved)) return moved;
  return moveWithin(node, kMaxCavityGrowth);
}

NodeId InteriorPointRounding::moveWithin(NodeId node, std::size_t growth) {
  StarKernel kernel;
  for (const TetId id : star_) {
    kernel.add(mesh_.points, mesh_.innerFace(id, mesh_.cornerOf(id, node)));
  }
  const Vec3 here = mesh_.points.position(node);
  const Vec3 middle = kernel.middle();
  const bool isDouble = mesh_.points.isDouble(node);
  double bestShape = isDouble ? minShapeAround() : -1.0;
  bool found = false;
  Vec3 best = here;
  ConeRules rules;
  rules.lost = node;
  rules.maxCavity = growth;
  for (const Vec3& position :
       {kernel.deepest(here), kernel.deepest(middle), middle, here + (middle - here) * 0.5,
        here + (middle - here) * 0.125, here}) {
    const NodeId trial = mesh_.points.add(position);
    if (cone_.plan(trial, star_, rules) && cone_.minShape() > bestShape) {
      found = true;
      best = position;
      bestShape = cone_.minShape();
    }
    mesh_.points.dropLast();
  }
  if (!found || (isDouble && best == here)) return node;
  const NodeId moved = mesh_.points.add(best);
  if (cone_.make(moved, star_, rules)) return moved;
  mesh_.points.dropLast();
  return node;
}

}  // namespace tetrafront
