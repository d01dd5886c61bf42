#include "adapt/node_mover.h"

#include <array>
#include <cmath>
#include <limits>

#include "adapt/rules.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"

namespace tetrafront {
namespace {

/// Least fall of the badness that counts: of one attempt, and of the whole move.
constexpr double kAttemptGain = 1e-9;
constexpr double kMoveGain = 1e-6;

/// Height of the regular tetrahedron with edge 1.
constexpr double kRegularHeight = 0.81649658092772603;

}  // namespace

void NodeMover::collect(NodeId node) {
  node_ = node;
  const AdaptMesh& mesh = context_.mesh;
  context_.mesh.findBall(node, ball_);
  neighbours_.clear();
  seen_.clear(mesh.nodes.size());
  seen_.mark(node.index());
  for (const TetId id : ball_) {
    for (const NodeId other : mesh.element(id).nodes) {
      if (seen_.mark(other.index())) neighbours_.push_back(other);
    }
  }
}

/// Returns the badness of the elements and edges around the node as it is; more than `limit` if it exceeds that.
double NodeMover::badnessAround(NodeId node, double limit) {
  const AdaptMesh& mesh = context_.mesh;
  const Badness& badness = context_.badness;
  double sum = 0.0;
  qualities_.clear();
  for (const TetId id : ball_) {
    const double quality = mesh.qualityOf(mesh.element(id).nodes);
    qualities_.push_back(quality);
    sum += quality < kFlatQuality ? kForbidden
                                  : badness.ofQuality(quality) + Badness::pullOfElement(quality);
    if (sum > limit) return sum;
  }
  for (const NodeId other : neighbours_) {
    const double length = mesh.lengthOf(node, other);
    sum += badness.ofEdge(length) + badness.pullOfEdge(length);
    if (sum > limit) return sum;
  }
  return sum;
}

/// Returns the cost of the tilt of the triangles of the boundary around the node against their patches.
double NodeMover::tiltCost() const {
  const AdaptMesh& mesh = context_.mesh;
  if (!given_.place.isOnBoundary()) return 0.0;
  double sum = 0.0;
  for (const TetId id : ball_) {
    const AdaptElement& element = mesh.element(id);
    for (std::size_t k = 0; k < 4; ++k) {
      if (element.nodes[k] == node_ || !element.beyond[k].isPatch()) continue;
      const auto& [a, b, c] = kFaceCorners[k];
      const double cosine =
          context_.guide.cosineToPatch({mesh.point(element.nodes[a]), mesh.point(element.nodes[b]),
                                        mesh.point(element.nodes[c])},
                                       element.beyond[k].patch(), mesh.node(node_).place.near);
      if (cosine < kFacingCosine) return kForbidden;
      sum += Badness::pullOfTilt(cosine);
    }
  }
  return sum;
}

/// Tries a position; keeps it as the best if the badness falls.
bool NodeMover::attempt(const Vec3& position) {
  AdaptNode& node = context_.mesh.node(node_);
  node.point = position;
  node.place = best_.place;
  if (!context_.guide.follow(node.place, node.point)) return false;
  context_.measure(node);
  double sum = badnessAround(node_, least_);
  if (sum >= least_ - kAttemptGain) return false;
  const double tilt = tiltCost();
  sum += tilt;
  if (tilt >= kForbidden || sum >= least_ - kAttemptGain) return false;
  least_ = sum;
  best_ = node;
  bestQualities_.swap(qualities_);
  return true;
}

void NodeMover::approach(const Vec3& target) {
  const Vec3 from = best_.point;
  for (const double part : {1.0, 0.5, 0.25}) {
    if (attempt(from + part * (target - from))) return;
  }
}

/// Returns the mean of the positions at unit distance from the neighbours; edges that are far from it count more.
Vec3 NodeMover::unitEdgeTarget() const {
  const AdaptMesh& mesh = context_.mesh;
  Vec3 sum(0.0);
  double weights = 0.0;
  for (const NodeId other : neighbours_) {
    const double length = mesh.lengthOf(node_, other);
    const double weight = std::fabs(length - 1.0) / (0.5 * (length + 1.0)) + 0.05;
    const Vec3& at = mesh.point(other);
    sum += weight * (at + (best_.point - at) * (1.0 / length));
    weights += weight;
  }
  return sum * (1.0 / weights);
}

/// Returns the mean of the apices of regular elements over the opposite faces; poor elements count more.
Vec3 NodeMover::regularTarget() const {
  const AdaptMesh& mesh = context_.mesh;
  const SymmetricTensor inverse = best_.metric.inverse();
  Vec3 sum(0.0);
  double weights = 0.0;
  for (std::size_t i = 0; i < ball_.size(); ++i) {
    const AdaptElement& element = mesh.element(ball_[i]);
    const auto& [j, l, k] = kFaceCorners[element.cornerOf(node_)];
    const Vec3& a = mesh.point(element.nodes[j]);
    const Vec3& b = mesh.point(element.nodes[k]);
    const Vec3& c = mesh.point(element.nodes[l]);
    const Vec3 normal = inverse * glm::cross(b - a, c - a);
    const double length = metricLength(best_.metric, normal);
    if (!(length > std::numeric_limits<double>::min())) continue;
    const double weight = 1.02 - bestQualities_[i];
    sum += weight * ((a + b + c) * (1.0 / 3.0) + normal * (kRegularHeight / length));
    weights += weight;
  }
  return weights > 0.0 ? sum * (1.0 / weights) : best_.point;
}

/// Tries random steps, forward and backward, with the sizes of the metric.
void NodeMover::search(MoveEffort effort, AdaptRandom& random) {
  double step = 0.25;
  const PrincipalAxes axes = principalAxes(best_.metric);
  const int tries = effort == MoveEffort::kLong ? 10 : 5;
  for (int i = 0; i < tries; ++i) {
    Vec3 way(0.0);
    for (std::size_t k = 0; k < 3; ++k)
      way += axes.axes[k] * ((2.0 * random.next() - 1.0) / std::sqrt(axes.values[k]));
    const Vec3 from = best_.point;
    if (!attempt(from + step * way) && !attempt(from - step * way)) step *= 0.75;
  }
}

bool NodeMover::move(NodeId node, MoveEffort effort, AdaptRandom& random) {
  AdaptMesh& mesh = context_.mesh;
  AdaptNode& own = mesh.node(node);
  if (own.place.kind == PlaceKind::kFixed) return false;
  collect(node);
  given_ = own;
  best_ = own;
  least_ = badnessAround(node, std::numeric_limits<double>::max()) + tiltCost();
  bestQualities_ = qualities_;
  const double before = least_;
  approach(unitEdgeTarget());
  own = best_;
  approach(regularTarget());
  if (effort != MoveEffort::kTargets &&
      (least_ > context_.badness.poorSurroundings() || effort == MoveEffort::kLong))
    search(effort, random);
  if (least_ < before - kMoveGain) {
    own = best_;
    for (std::size_t i = 0; i < ball_.size(); ++i)
      mesh.element(ball_[i]).quality = bestQualities_[i];
    mesh.touch(ball_);
    return true;
  }
  own = given_;
  own.tried = mesh.now;
  return false;
}

}  // namespace tetrafront
