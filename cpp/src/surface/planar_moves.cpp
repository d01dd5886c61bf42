#include "surface/planar_moves.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetrafront {

namespace {

/// Shares of the wanted move that are tried.
constexpr std::array<double, 2> kMoves{1.0, 0.4};
/// Height of the equilateral triangle over its side.
constexpr double kEquilateralHeight = 0.86602540378443865;
/// Steps of the search for wider angles, as shares of the shortest edge at the node.
constexpr std::array<double, 3> kSearchSteps{0.3, 0.12, 0.04};
/// Rounds of one step length before the next.
constexpr int kSearchRounds = 3;
/// A search must raise the rating by this to go on.
constexpr double kMinRatingGain = 1e-3;
/// Nodes whose triangles cost more than this on average are polished; 1.1 is a mean shape of .95.
constexpr double kCostly = 1.1;
/// Directions searched: the corners of an octagon.
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

Vec3 PlanarMoves::wantedPlace(std::uint32_t node, const LocalSpace& local) const {
  const Vec3 here = local.unit(mesh_->places[node]);
  const std::vector<std::uint32_t>& ring = star_.ring;
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 p = local.unit(mesh_->places[ring[i]]);
    const Vec3 q = local.unit(mesh_->places[ring[(i + 1) % ring.size()]]);
    const Vec3 middle = 0.5 * (p + q);
    const Vec3 along = q - p;
    const double squared = glm::dot(along, along);
    // From the side towards the node, square to the side.
    Vec3 across = here - middle;
    across -= (glm::dot(across, along) / squared) * along;
    const double height = glm::length(across);
    if (!(height > 0.0)) {
      sum += here;
      continue;
    }
    const double wanted = 0.5 * (std::sqrt(squared) + local.wantedSide);
    sum += middle + (kEquilateralHeight * wanted / height) * across;
  }
  return local.space(sum / static_cast<double>(ring.size()));
}

double PlanarMoves::rate(Rating rating, const Vec3& place, const LocalSpace& local) const {
  const std::vector<std::uint32_t>& ring = star_.ring;
  const Vec3 centre = local.unit(place);
  double cost = 0.0;
  double least = 1.0;
  Vec3 p = local.unit(mesh_->places[ring.back()]);
  for (const std::uint32_t node : ring) {
    const Vec3 q = local.unit(mesh_->places[node]);
    if (rating == Rating::kShapes)
      cost += shapeCost(centre, p, q);
    else
      least = std::min(least, triangleSine(centre, p, q));
    p = q;
  }
  return rating == Rating::kShapes ? -cost : least;
}

/// The step of the plane whose image is nearest to the move: (J^T J) step = J^T move.
Vec2 PlanarMoves::stepFor(const SurfacePoint& here, const Vec3& move) const {
  const Metric2 metric = planeMetric(here, 1.0);
  const Vec2 right(glm::dot(here.alongXi, move), glm::dot(here.alongEta, move));
  const double determinant = metric.determinant();
  return {(metric.yy * right.x - metric.xy * right.y) / determinant,
          (metric.xx * right.y - metric.xy * right.x) / determinant};
}

void PlanarMoves::smooth(std::uint32_t node) {
  if (!links_->collectStar(node, star_)) return;
  const SurfacePoint here = metric_->surface().evaluate(mesh_->plane[node]);
  const LocalSpace local = metric_->spaceAt(here.position, mesh_->sizes[node], hint_);
  const Vec2 step = stepFor(here, wantedPlace(node, local) - here.position);
  const double rated = rate(Rating::kShapes, mesh_->places[node], local);
  const Vec2 from = mesh_->plane[node];
  for (const double share : kMoves)
    if (moveTo(node, from + share * step, Rating::kShapes, rated, local)) return;
}

void PlanarMoves::polish(std::uint32_t node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = metric_->spaceAt(mesh_->places[node], mesh_->sizes[node], hint_);
  const double rated = rate(Rating::kShapes, mesh_->places[node], local);
  if (-rated > kCostly * static_cast<double>(star_.ring.size()))
    search(node, Rating::kShapes, rated, local);
}

void PlanarMoves::widen(std::uint32_t node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = metric_->spaceAt(mesh_->places[node], mesh_->sizes[node], hint_);
  search(node, Rating::kSmallestSine, rate(Rating::kSmallestSine, mesh_->places[node], local),
         local);
}

/// Goes in the first of eight directions that is better, again and again, in ever smaller steps.
void PlanarMoves::search(std::uint32_t node, Rating rating, double rated, const LocalSpace& local) {
  double shortest = glm::length(mesh_->places[star_.ring.front()] - mesh_->places[node]);
  for (const std::uint32_t other : star_.ring)
    shortest = std::min(shortest, glm::length(mesh_->places[other] - mesh_->places[node]));
  for (const double share : kSearchSteps) {
    bool moved = true;
    for (int round = 0; round < kSearchRounds && moved; ++round) {
      const SurfacePoint here = metric_->surface().evaluate(mesh_->plane[node]);
      if (!(glm::length(glm::cross(here.alongXi, here.alongEta)) > 0.0)) return;
      const Vec3 first = glm::normalize(here.alongXi);
      const Vec3 second = glm::normalize(here.alongEta - glm::dot(here.alongEta, first) * first);
      const Vec2 from = mesh_->plane[node];
      moved = std::ranges::any_of(kDirections, [&](const Vec2& direction) {
        const Vec3 move = share * shortest * (direction.x * first + direction.y * second);
        return moveTo(node, from + stepFor(here, move), rating, rated + kMinRatingGain, local);
      });
      if (moved) rated = rate(rating, mesh_->places[node], local);
    }
  }
}

bool PlanarMoves::moveTo(std::uint32_t node, const Vec2& to, Rating rating, double least,
                         const LocalSpace& local) {
  const std::vector<std::uint32_t>& ring = star_.ring;
  const Vec2 from = mesh_->plane[node];
  mesh_->plane[node] = to;
  bool valid = true;
  for (std::size_t i = 0; i < ring.size() && valid; ++i)
    valid = mesh_->turn(node, ring[i], ring[(i + 1) % ring.size()]) > 0;
  if (valid) {
    const PlaneSample sample = metric_->sample(to, hint_);
    if (rate(rating, sample.position, local) >= least) {
      mesh_->places[node] = sample.position;
      mesh_->sizes[node] = sample.size;
      return true;
    }
  }
  mesh_->plane[node] = from;
  return false;
}

}  // namespace tetrafront
