#include "fill/boundary_clearing.h"

#include <algorithm>
#include <cmath>

#include "fill/inward_direction.h"
#include "fill/star_kernel.h"

namespace tetrafront {
namespace {

/// Tetrahedra around a star may give way to an existing point, up to so many in all.
constexpr std::size_t kLargestGrowth = 200;
/// Halvings of the step inwards, in doubles and then exactly.
constexpr int kMaxHalvings = 50;
constexpr int kMaxExactHalvings = 400;

}  // namespace

BoundaryClearing::BoundaryClearing(FillMesh& mesh,
                                   const std::vector<std::array<NodeId, 3>>& triangles,
                                   std::span<const NodeId> points)
    : mesh_(mesh), cone_(mesh, none_), thickening_(mesh), fans_(mesh, triangles) {
  for (const NodeId node : points) wait(node);
  count_ = left_ = waiting_.size();
}

/// Most points soon find one that replaces them, and the few that must be lifted take as long: hence the root.
double BoundaryClearing::fraction() const {
  if (count_ == 0) return 1.0;
  return 1.0 - std::sqrt(static_cast<double>(left_) / static_cast<double>(count_));
}

void BoundaryClearing::wait(NodeId node) {
  turns_.resize(mesh_.points.size(), Turn::kNone);
  turns_[node.index()] = Turn::kWaiting;
  waiting_.push_back(node);
}

void BoundaryClearing::postpone(NodeId node) {
  turns_[node.index()] = Turn::kPostponed;
  postponed_.push_back(node);
}

/// The one that has been postponed longest; none if none is.
NodeId BoundaryClearing::nextToLift() {
  while (nextPostponed_ < postponed_.size()) {
    const NodeId node = postponed_[nextPostponed_++];
    if (turns_[node.index()] == Turn::kPostponed) return node;
  }
  return {};
}

/// Points wait for an existing point as long as there is hope; only then one is lifted to a new one,
/// which may make room for those around it.
BoundaryClearing::State BoundaryClearing::step() {
  const bool lifting = nextWaiting_ == waiting_.size();
  const NodeId node = lifting ? nextToLift() : waiting_[nextWaiting_++];
  if (node.isNone()) return State::kDone;
  mesh_.star(node, star_);
  if (!fans_.describe(node, star_)) return State::kFailed;
  if (lifting ? replaceByExistingInRoom(node) || replaceByNew(node) : replaceByExisting(node)) {
    turns_[node.index()] = Turn::kNone;
    --left_;
    queueTouched(mesh_.lastMade());
    for (const NodeId point : madeRoom_) {
      mesh_.star(point, star_);
      queueTouched(star_);
    }
    madeRoom_.clear();
    return State::kRunning;
  }
  if (lifting) return State::kFailed;
  postpone(node);
  return State::kRunning;
}

/// What did not go with the same tetrahedra around does not go now; what has others now may.
void BoundaryClearing::queueTouched(std::span<const TetId> changed) {
  turns_.resize(mesh_.points.size(), Turn::kNone);
  const auto touch = [&](NodeId node) {
    if (turns_[node.index()] == Turn::kPostponed) wait(node);
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

// ---- by an existing point ------------------------------------------------------------------------

std::vector<NodeId> BoundaryClearing::candidates(NodeId node) const {
  std::vector<NodeId> nodes = mesh_.neighboursIn(star_, node);
  std::erase_if(nodes, [&](NodeId apex) { return !fans_.areSeenFrom(apex); });
  return nodes;
}

/// By the neighbour that makes the best tetrahedra.
bool BoundaryClearing::replaceByExisting(NodeId node) {
  NodeId best;
  double bestShape = 0.0;
  ConeRules rules;
  rules.lost = node;
  for (const NodeId apex : candidates(node)) {
    const std::vector<BoundaryFace> boundary = fans_.facesFor(apex);
    rules.boundary = boundary;
    if (!cone_.plan(apex, star_, rules)) continue;
    const double shape = cone_.leastShape();
    if (!best.isNone() && shape <= bestShape) continue;
    best = apex;
    bestShape = shape;
  }
  if (best.isNone()) return false;
  const std::vector<BoundaryFace> boundary = fans_.facesFor(best);
  rules.boundary = boundary;
  return cone_.make(best, star_, rules);
}

/// By the first neighbour that can, if tetrahedra around the star may give way too.
bool BoundaryClearing::replaceByExistingInRoom(NodeId node) {
  ConeRules rules;
  rules.lost = node;
  rules.largestCavity = star_.size() + kLargestGrowth;
  const std::vector<NodeId> nodes = candidates(node);
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId apex) {
    const std::vector<BoundaryFace> boundary = fans_.facesFor(apex);
    rules.boundary = boundary;
    return cone_.make(apex, star_, rules);
  });
}

// ---- by a new point ------------------------------------------------------------------------------

bool BoundaryClearing::tryLast(NodeId node, std::size_t growth) {
  const std::vector<BoundaryFace> boundary = fans_.faces();
  ConeRules rules;
  rules.lost = node;
  rules.largestCavity = growth;
  rules.boundary = boundary;
  const NodeId last(mesh_.points.size() - 1);
  if (cone_.make(last, star_, rules)) {
    interiorPoints_.push_back(last);
    return true;
  }
  mesh_.points.dropLast();
  return false;
}

bool BoundaryClearing::tryPlace(NodeId node, const Vec3& place, std::size_t growth) {
  mesh_.points.add(place);
  return tryLast(node, growth);
}

bool BoundaryClearing::tryPlace(NodeId node, const DyadicVec3& place) {
  mesh_.points.add(place);
  return tryLast(node, 0);
}

/// How far the farthest node around is.
double BoundaryClearing::reach(NodeId node) const {
  double farthest = 0.0;
  for (const TetId id : star_) {
    for (const NodeId other : mesh_.tet(id).nodes) {
      const Vec3 way = mesh_.points.place(other) - mesh_.points.place(node);
      farthest = std::max(farthest, glm::length(way));
    }
  }
  return farthest;
}

bool BoundaryClearing::replaceByNew(NodeId node) {
  if (replaceByDouble(node)) return true;
  madeRoom_.clear();
  if (thickening_.makeRoomAt(node, madeRoom_) > 0) {
    interiorPoints_.insert(interiorPoints_.end(), madeRoom_.begin(), madeRoom_.end());
    mesh_.star(node, star_);
    if (!fans_.describe(node, star_)) return false;
    if (replaceByDouble(node)) return true;
  }
  return replaceByExact(node);
}

bool BoundaryClearing::replaceByDouble(NodeId node) {
  StarKernel kernel;
  const Vec3 place = mesh_.points.place(node);
  for (const TetId id : star_) {
    kernel.add(mesh_.points, mesh_.innerFace(id, mesh_.cornerOf(id, node)));
  }
  for (const BoundaryFace& face : fans_.faces()) kernel.add(mesh_.points, face.nodes);
  const Vec3 middle = kernel.middle();
  const Vec3 direction = inwards(mesh_.points, fans_.planes());
  std::vector<Vec3> tried;
  const auto tryNext = [&](const Vec3& there) {
    tried.push_back(there);
    return tryPlace(node, there, 0);
  };
  if (tryNext(kernel.deepest(middle))) return true;
  double step = 0.5 * reach(node);
  for (int i = 0; i < kMaxHalvings; ++i, step *= 0.5) {
    const Vec3 there = place + direction * step;
    if (tryNext(kernel.deepest(there)) || tryNext(there)) return true;
  }
  return std::ranges::any_of(
      tried, [&](const Vec3& there) { return tryPlace(node, there, kLargestGrowth); });
}

/// A little way inwards, however little. Such a way exists, but for doubles it may be too little.
bool BoundaryClearing::replaceByExact(NodeId node) {
  const std::optional<DyadicVec3> exact = exactInwards(mesh_.points, fans_.planes());
  if (!exact) return false;
  const double length = std::fabs((*exact)[0].toDouble()) + std::fabs((*exact)[1].toDouble()) +
                        std::fabs((*exact)[2].toDouble());
  int exponent = 0;
  std::frexp(reach(node) / length, &exponent);
  const DyadicVec3 start = mesh_.points.exact(node);
  for (int i = 0; i < kMaxExactHalvings; ++i) {
    const Dyadic factor(std::ldexp(1.0, exponent - i));
    if (tryPlace(node, start + *exact * factor)) return true;
  }
  return false;
}

}  // namespace tetrafront
