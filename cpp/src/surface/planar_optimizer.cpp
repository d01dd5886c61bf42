// The flips are Lawson's, by shape instead of by circumcircle: on a curved patch the shape in space counts. Each
// flip lowers the summed cost of the shapes, so a sweep of flips ends. Moves lower the same sum. The other changes
// raise the smallest angle of the triangles that they touch, or keep it at 25 degrees or more. The schedule has a
// fixed number of sweeps.

#include "surface/planar_optimizer.h"

#include <algorithm>

#include "surface/rules.h"
#include "surface/triangle_shape.h"

namespace tetrafront {

PlanarOptimizer::PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh)
    : metric_(&metric),
      mesh_(&mesh),
      links_(mesh),
      moves_(metric, mesh, links_),
      improver_(metric, mesh, links_, moves_) {}

/// Removes and splits first, while the nodes still move. Widens small angles last, and again after the nodes
/// around the new triangles were moved. More sweeps of smoothing change shapes by less than a percent.
const std::vector<PlanarOptimizer::Sweep>& PlanarOptimizer::schedule() {
  using enum Sweep;
  static const std::vector<Sweep> sweeps{
      kSplitForbidden, kFlip,        kSmooth, kFlip,        kRemoveNodes, kSplitLong,
      kFlip,           kSmooth,      kFlip,   kSmooth,      kFlip,        kRemoveNodes,
      kFlip,           kSmooth,      kFlip,   kWidenAngles, kFlip,        kPolish,
      kFlip,           kWidenAngles, kPolish, kWidenAngles};
  return sweeps;
}

bool PlanarOptimizer::advance(std::uint32_t budget) {
  std::uint32_t work = 0;
  if (!isLinked_) {
    isLinked_ = true;
    links_.build();
    if (mesh_->separated.empty()) sweep_ = 1;  // no edge is forbidden
    work += links_.triangleCount() / 8;
  }
  while (!isDone_ && work < budget) {
    if (sweep_ == schedule().size()) {
      improver_.splitLoneTriangle();
      links_.compact();
      isDone_ = true;
      break;
    }
    const Sweep sweep = schedule()[sweep_];
    const bool visitsNodes =
        sweep == Sweep::kSmooth || sweep == Sweep::kPolish || sweep == Sweep::kRemoveNodes;
    if (visitsNodes) next_ = std::max(next_, mesh_->boundaryCount);
    if (next_ >= (visitsNodes ? mesh_->plane.size() : links_.triangleCount())) {
      ++sweep_;
      next_ = 0;
      continue;
    }
    visit(sweep, next_++);
    ++work;
  }
  return isDone_;
}

void PlanarOptimizer::visit(Sweep sweep, std::uint32_t index) {
  switch (sweep) {
    case Sweep::kSplitForbidden:
      improver_.splitForbiddenEdges(PlanarTriangleId(index));
      break;
    case Sweep::kFlip:
      flipFrom(PlanarTriangleId(index));
      break;
    case Sweep::kSmooth:
      moves_.smooth(PlanarNodeId(index));
      break;
    case Sweep::kPolish:
      moves_.polish(PlanarNodeId(index));
      break;
    case Sweep::kRemoveNodes:
      improver_.removeIfNeedless(PlanarNodeId(index));
      break;
    case Sweep::kSplitLong:
      improver_.splitLongEdge(PlanarTriangleId(index));
      break;
    case Sweep::kWidenAngles:
      improver_.widenSmallAngle(PlanarTriangleId(index));
      break;
  }
}

void PlanarOptimizer::flipFrom(PlanarTriangleId triangle) {
  if (!links_.isAlive(triangle)) return;
  // Each pair of triangles is rated in its own metric. If the metric varies, a chain of flips might return to its
  // start. Other chains are much shorter than this limit.
  constexpr std::size_t kMaxChain = 1000;
  pending_.assign(1, triangle);
  for (std::size_t flips = 0; !pending_.empty() && flips < kMaxChain; ++flips) {
    const PlanarTriangleId t = pending_.back();
    pending_.pop_back();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const PlanarTriangleId other = links_.neighbour(t, k);
      if (other.isNone() || !flip(t, k)) continue;
      pending_.push_back(other);
      pending_.push_back(t);
      break;
    }
  }
}

/// Flips the edge opposite corner k of t if the new triangles are better; returns whether it flipped.
bool PlanarOptimizer::flip(PlanarTriangleId t, std::uint32_t k) {
  const auto [other, a, b, c, d] = links_.diamond(t, k);
  if (!mesh_->canConnect(c, d)) return false;
  const Vec3& a3 = mesh_->positionOf(a);
  const Vec3& b3 = mesh_->positionOf(b);
  const Vec3& c3 = mesh_->positionOf(c);
  const Vec3& d3 = mesh_->positionOf(d);
  // The order of this sum gives the flipped edge bit for bit the same middle, and thus the same space.
  const Vec3 middle = 0.25 * ((a3 + b3) + (c3 + d3));
  const LocalSpace local = metric_->spaceAt(middle, mesh_->sizeOf(a), hint_);
  const Vec3 unitA = local.unit(a3);
  const Vec3 unitB = local.unit(b3);
  const Vec3 unitC = local.unit(c3);
  const Vec3 unitD = local.unit(d3);
  const double before = shapeCost(unitA, unitB, unitC) + shapeCost(unitB, unitA, unitD);
  const double after = shapeCost(unitC, unitA, unitD) + shapeCost(unitC, unitD, unitB);
  if (mesh_->orientation(c, a, d) <= 0 || mesh_->orientation(c, d, b) <= 0) return false;
  const double foldBefore = foldCosine(unitA, unitB, unitC, unitD);
  // The long triangles with which a front closes may face away from a curved patch, whatever their shape. If so,
  // fewer flipped triangles count more than better shapes.
  if (foldBefore < 0.0) {
    const int flippedBefore = countFlipped(a, b, c) + countFlipped(b, a, d);
    const int flippedAfter = countFlipped(c, a, d) + countFlipped(c, d, b);
    if (flippedAfter < flippedBefore) links_.flip(t, k);
    if (flippedAfter != flippedBefore) return flippedAfter < flippedBefore;
  }
  if (after >= (1.0 - kMinPlanarFlipGain) * before) return false;
  const double foldAfter = foldCosine(unitC, unitD, unitB, unitA);
  if (foldAfter < kSharpFoldCosine && foldAfter < foldBefore) return false;
  links_.flip(t, k);
  return true;
}

/// Returns 1 if the triangle faces away from the patch at its centre, else 0.
int PlanarOptimizer::countFlipped(PlanarNodeId a, PlanarNodeId b, PlanarNodeId c) const {
  constexpr double kThird = 1.0 / 3.0;
  const Vec2 centre = kThird * (mesh_->planeOf(a) + mesh_->planeOf(b) + mesh_->planeOf(c));
  const SurfacePoint point = metric_->surface().evaluate(centre);
  const Vec3 normal = glm::cross(mesh_->positionOf(b) - mesh_->positionOf(a),
                                 mesh_->positionOf(c) - mesh_->positionOf(a));
  return glm::dot(normal, glm::cross(point.alongXi, point.alongEta)) < 0.0 ? 1 : 0;
}

}  // namespace tetrafront
