#include "fill/boundary_point_removal.h"

#include <algorithm>
#include <cmath>

#include "fill/inward_direction.h"
#include "fill/star_kernel.h"

namespace tetrafront {
namespace {

/// Halvings of the step inwards, first in doubles, then exactly.
constexpr int kMaxHalvings = 50;
constexpr int kMaxExactHalvings = 400;

}  // namespace

BoundaryPointRemoval::BoundaryPointRemoval(FillMesh& mesh, const std::vector<NodeTriple>& triangles,
                                           std::span<const NodeId> points)
    : mesh_(mesh), cone_(mesh, none_), slivers_(mesh), fans_(mesh, triangles) {
  for (const NodeId node : points) wait(node);
  initialCount_ = remaining_ = waiting_.size();
}

/// Most points soon find a neighbour that replaces them. The few that need a new point take about
/// as long in total: hence the square root.
double BoundaryPointRemoval::fraction() const {
  if (initialCount_ == 0) return 1.0;
  return 1.0 - std::sqrt(static_cast<double>(remaining_) / static_cast<double>(initialCount_));
}

void BoundaryPointRemoval::wait(NodeId node) {
  queueOf_.resize(mesh_.points.size(), Queue::kNone);
  queueOf_[node.index()] = Queue::kWaiting;
  waiting_.push_back(node);
}

void BoundaryPointRemoval::postpone(NodeId node) {
  queueOf_[node.index()] = Queue::kPostponed;
  postponed_.push_back(node);
}

/// Returns the point that has been postponed longest, or none.
NodeId BoundaryPointRemoval::nextToLift() {
  while (nextPostponed_ < postponed_.size()) {
    const NodeId node = postponed_[nextPostponed_++];
    if (queueOf_[node.index()] == Queue::kPostponed) return node;
  }
  return {};
}

/// Tries existing points first, as long as any may succeed. Only then is one point replaced by a
/// new one, which may make it possible to replace its neighbours.
FillState BoundaryPointRemoval::step() {
  const bool lifting = nextWaiting_ == waiting_.size();
  const NodeId node = lifting ? nextToLift() : waiting_[nextWaiting_++];
  if (node.isNone()) return FillState::kDone;
  mesh_.star(node, star_);
  if (!fans_.describe(node, star_)) return FillState::kFailed;
  if (lifting ? replaceByExistingWithGrowth(node) || replaceByNew(node) : replaceByExisting(node)) {
    queueOf_[node.index()] = Queue::kNone;
    --remaining_;
    queueTouched(mesh_.lastCreated());
    for (const NodeId point : sliverPoints_) {
      mesh_.star(point, star_);
      queueTouched(star_);
    }
    sliverPoints_.clear();
    return FillState::kRunning;
  }
  if (lifting) return FillState::kFailed;
  postpone(node);
  return FillState::kRunning;
}

/// A point that failed fails again while the tetrahedra around it stay the same. Retry those whose
/// tetrahedra have changed.
void BoundaryPointRemoval::queueTouched(std::span<const TetId> changed) {
  queueOf_.resize(mesh_.points.size(), Queue::kNone);
  const auto touch = [&](NodeId node) {
    if (queueOf_[node.index()] == Queue::kPostponed) wait(node);
  };
  for (const TetId id : changed) {
    const FillTet& t = mesh_.tet(id);
    for (std::uint32_t k = 0; k < 4; ++k) {
      touch(t.nodes[k]);
      const TetFace beyond = t.across[k];
      if (!beyond.isNone()) touch(mesh_.tet(beyond.tet).nodes[beyond.corner]);
    }
  }
}

// ---- replacement by an existing point
// ------------------------------------------------------------

std::vector<NodeId> BoundaryPointRemoval::candidates(NodeId node) const {
  std::vector<NodeId> nodes = mesh_.neighboursIn(star_, node);
  std::erase_if(nodes, [&](NodeId apex) { return !fans_.areVisibleFrom(apex); });
  return nodes;
}

/// Uses the neighbour whose worst tetrahedron has the best shape.
bool BoundaryPointRemoval::replaceByExisting(NodeId node) {
  NodeId best;
  double bestShape = 0.0;
  ConeRules rules;
  rules.lost = node;
  for (const NodeId apex : candidates(node)) {
    const std::vector<BoundaryFace> boundary = fans_.facesFor(apex);
    rules.boundary = boundary;
    if (!cone_.plan(apex, star_, rules)) continue;
    const double shape = cone_.minShape();
    if (!best.isNone() && shape <= bestShape) continue;
    best = apex;
    bestShape = shape;
  }
  if (best.isNone()) return false;
  const std::vector<BoundaryFace> boundary = fans_.facesFor(best);
  rules.boundary = boundary;
  return cone_.make(best, star_, rules);
}

/// Uses the first neighbour that succeeds if tetrahedra around the star may join the cavity.
bool BoundaryPointRemoval::replaceByExistingWithGrowth(NodeId node) {
  ConeRules rules;
  rules.lost = node;
  rules.maxCavity = star_.size() + kMaxCavityGrowth;
  const std::vector<NodeId> nodes = candidates(node);
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId apex) {
    const std::vector<BoundaryFace> boundary = fans_.facesFor(apex);
    rules.boundary = boundary;
    return cone_.make(apex, star_, rules);
  });
}

// ---- replacement by a new point
// ------------------------------------------------------------------

bool BoundaryPointRemoval::tryLast(NodeId node, std::size_t growth) {
  const std::vector<BoundaryFace> boundary = fans_.faces();
  ConeRules rules;
  rules.lost = node;
  rules.maxCavity = growth;
  rules.boundary = boundary;
  const NodeId last(mesh_.points.size() - 1);
  if (cone_.make(last, star_, rules)) {
    interiorPoints_.push_back(last);
    return true;
  }
  mesh_.points.dropLast();
  return false;
}

bool BoundaryPointRemoval::tryPosition(NodeId node, const Vec3& position, std::size_t growth) {
  mesh_.points.add(position);
  return tryLast(node, growth);
}

bool BoundaryPointRemoval::tryPosition(NodeId node, const DyadicVec3& position) {
  mesh_.points.add(position);
  return tryLast(node, 0);
}

/// Returns the distance to the farthest node of the star.
double BoundaryPointRemoval::reach(NodeId node) const {
  double farthest = 0.0;
  for (const TetId id : star_) {
    for (const NodeId other : mesh_.tet(id).nodes) {
      const Vec3 way = mesh_.points.position(other) - mesh_.points.position(node);
      farthest = std::max(farthest, glm::length(way));
    }
  }
  return farthest;
}

bool BoundaryPointRemoval::replaceByNew(NodeId node) {
  if (replaceByDouble(node)) return true;
  sliverPoints_.clear();
  if (slivers_.removeAt(node, sliverPoints_) > 0) {
    interiorPoints_.insert(interiorPoints_.end(), sliverPoints_.begin(), sliverPoints_.end());
    mesh_.star(node, star_);
    if (!fans_.describe(node, star_)) return false;
    if (replaceByDouble(node)) return true;
  }
  return replaceByExact(node);
}

bool BoundaryPointRemoval::replaceByDouble(NodeId node) {
  StarKernel kernel;
  const Vec3 position = mesh_.points.position(node);
  for (const TetId id : star_) {
    kernel.add(mesh_.points, mesh_.innerFace(id, mesh_.cornerOf(id, node)));
  }
  for (const BoundaryFace& face : fans_.faces()) kernel.add(mesh_.points, face.nodes);
  const Vec3 middle = kernel.middle();
  const Vec3 direction = inwardDirection(mesh_.points, fans_.planes());
  std::vector<Vec3> tried;
  const auto tryNext = [&](const Vec3& there) {
    tried.push_back(there);
    return tryPosition(node, there, 0);
  };
  if (tryNext(kernel.deepest(middle))) return true;
  double step = 0.5 * reach(node);
  for (int i = 0; i < kMaxHalvings; ++i, step *= 0.5) {
    const Vec3 there = position + direction * step;
    if (tryNext(kernel.deepest(there)) || tryNext(there)) return true;
  }
  return std::ranges::any_of(
      tried, [&](const Vec3& there) { return tryPosition(node, there, kMaxCavityGrowth); });
}

/// Moves the point inwards by an exact vector, shorter and shorter. Such a move always exists, but
/// may be too short for doubles.
bool BoundaryPointRemoval::replaceByExact(NodeId node) {
  const std::optional<DyadicVec3> exact = exactInwardDirection(mesh_.points, fans_.planes());
  if (!exact) return false;
  const double length = std::fabs((*exact)[0].toDouble()) + std::fabs((*exact)[1].toDouble()) +
                        std::fabs((*exact)[2].toDouble());
  int exponent = 0;
  std::frexp(reach(node) / length, &exponent);
  const DyadicVec3 start = mesh_.points.exact(node);
  for (int i = 0; i < kMaxExactHalvings; ++i) {
    const Dyadic factor(std::ldexp(1.0, exponent - i));
    if (tryPosition(node, start + *exact * factor)) return true;
  }
  return false;
}

}  // namespace tetrafront
