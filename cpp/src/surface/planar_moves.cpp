#include "surface/planar_moves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/rules.h"
#include "surface/triangle_shape.h"

namespace tetrafront {

namespace {

/// Height of an equilateral triangle / edge.
constexpr double kEquilateralHeight = 0.86602540378443865;
/// The directions of a search: the corners of an octagon.
constexpr double kDiagonal = 0.70710678118654752;
constexpr std::array<Vec2, 8> kDirections{{{1.0, 0.0},
                                           {0.0, 1.0},
                                           {-1.0, 0.0},
                                           {0.0, -1.0},
                                           {kDiagonal, kDiagonal},
                                           {-kDiagonal, kDiagonal},
                                           {-kDiagonal, -kDiagonal},
                                           {kDiagonal, -kDiagonal}}};

}  // namespace

Vec3 PlanarMoves::targetPosition(PlanarNodeId node, const LocalSpace& local) const {
  const Vec3 here = local.unit(mesh_->positionOf(node));
  const std::vector<PlanarNodeId>& ring = star_.ring;
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 p = local.unit(mesh_->positionOf(ring[i]));
    const Vec3 q = local.unit(mesh_->positionOf(ring[(i + 1) % ring.size()]));
    const Vec3 middle = 0.5 * (p + q);
    const Vec3 along = q - p;
    const double squared = glm::dot(along, along);
    // From the edge to the node, perpendicular to the edge.
    Vec3 across = here - middle;
    across -= (glm::dot(across, along) / squared) * along;
    const double height = glm::length(across);
    if (!(height > 0.0)) {
      sum += here;
      continue;
    }
    const double length = 0.5 * (std::sqrt(squared) + local.targetLength);
    sum += middle + (kEquilateralHeight * length / height) * across;
  }
  return local.space(sum / static_cast<double>(ring.size()));
}

double PlanarMoves::rate(Rating rating, const Vec3& position, const LocalSpace& local) const {
  const std::vector<PlanarNodeId>& ring = star_.ring;
  const Vec3 centre = local.unit(position);
  double cost = 0.0;
  double smallestSine = 1.0;
  Vec3 p = local.unit(mesh_->positionOf(ring.back()));
  for (const PlanarNodeId node : ring) {
    const Vec3 q = local.unit(mesh_->positionOf(node));
    if (rating == Rating::kShapes)
      cost += shapeCost(centre, p, q);
    else
      smallestSine = std::min(smallestSine, triangleSine(centre, p, q));
    p = q;
  }
  return rating == Rating::kShapes ? -cost : smallestSine;
}

/// Returns the step of the plane whose image is nearest to the move: (J^T J) step = J^T move.
Vec2 PlanarMoves::stepFor(const SurfacePoint& here, const Vec3& move) const {
  const Metric2 metric = planeMetric(here, 1.0);
  const Vec2 right(glm::dot(here.alongXi, move), glm::dot(here.alongEta, move));
  const double determinant = metric.determinant();
  return {(metric.yy * right.x - metric.xy * right.y) / determinant,
          (metric.xx * right.y - metric.xy * right.x) / determinant};
}

void PlanarMoves::smooth(PlanarNodeId node) {
  if (!links_->collectStar(node, star_)) return;
  const SurfacePoint here = metric_->surface().evaluate(mesh_->planeOf(node));
  const LocalSpace local = metric_->spaceAt(here.position, mesh_->sizeOf(node), hint_);
  const Vec2 step = stepFor(here, targetPosition(node, local) - here.position);
  const double rated = rate(Rating::kShapes, mesh_->positionOf(node), local);
  const Vec2 from = mesh_->planeOf(node);
  for (const double fraction : kMoves)
    if (moveTo(node, from + fraction * step, Rating::kShapes, rated, local)) return;
}

void PlanarMoves::polish(PlanarNodeId node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = metric_->spaceAt(mesh_->positionOf(node), mesh_->sizeOf(node), hint_);
  const double rated = rate(Rating::kShapes, mesh_->positionOf(node), local);
  if (-rated > kMaxGoodCost * static_cast<double>(star_.ring.size()))
    search(node, Rating::kShapes, rated, local);
}

void PlanarMoves::widenAngles(PlanarNodeId node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = metric_->spaceAt(mesh_->positionOf(node), mesh_->sizeOf(node), hint_);
  search(node, Rating::kSmallestSine, rate(Rating::kSmallestSine, mesh_->positionOf(node), local),
         local);
}

/// Repeatedly takes the first of eight directions that improves the rating, with decreasing step lengths.
void PlanarMoves::search(PlanarNodeId node, Rating rating, double rated, const LocalSpace& local) {
  double shortest = glm::length(mesh_->positionOf(star_.ring.front()) - mesh_->positionOf(node));
  for (const PlanarNodeId other : star_.ring)
    shortest = std::min(shortest, glm::length(mesh_->positionOf(other) - mesh_->positionOf(node)));
  for (const double stepLength : kSearchSteps) {
    bool hasMoved = true;
    for (int round = 0; round < kSearchRounds && hasMoved; ++round) {
      const SurfacePoint here = metric_->surface().evaluate(mesh_->planeOf(node));
      if (!(glm::length(glm::cross(here.alongXi, here.alongEta)) > 0.0)) return;
      const Vec3 first = glm::normalize(here.alongXi);
      const Vec3 second = glm::normalize(here.alongEta - glm::dot(here.alongEta, first) * first);
      const Vec2 from = mesh_->planeOf(node);
      hasMoved = std::ranges::any_of(kDirections, [&](const Vec2& direction) {
        const Vec3 move = stepLength * shortest * (direction.x * first + direction.y * second);
        return moveTo(node, from + stepFor(here, move), rating, rated + kMinRatingGain, local);
      });
      if (hasMoved) rated = rate(rating, mesh_->positionOf(node), local);
    }
  }
}

/// Moves the node if its triangles stay counter-clockwise and the rating becomes at least `minRating`; returns
/// whether it moved.
bool PlanarMoves::moveTo(PlanarNodeId node, const Vec2& to, Rating rating, double minRating,
                         const LocalSpace& local) {
  const std::vector<PlanarNodeId>& ring = star_.ring;
  const Vec2 from = mesh_->planeOf(node);
  mesh_->plane[node.index()] = to;
  bool isValid = true;
  for (std::size_t i = 0; i < ring.size() && isValid; ++i)
    isValid = mesh_->orientation(node, ring[i], ring[(i + 1) % ring.size()]) > 0;
  if (isValid) {
    const PlaneSample sample = metric_->sample(to, hint_);
    if (rate(rating, sample.position, local) >= minRating) {
      mesh_->positions[node.index()] = sample.position;
      mesh_->sizes[node.index()] = sample.size;
      return true;
    }
  }
  mesh_->plane[node.index()] = from;
  return false;
}

}  // namespace tetrafront
