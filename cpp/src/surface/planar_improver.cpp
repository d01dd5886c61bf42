#include "surface/planar_improver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ids.h"
#include "base/sort.h"

namespace tetrafront {

namespace {

/// An edge shorter than this share of the wanted length makes one of its nodes needless.
constexpr double kShortEdge = 0.6;
/// Nodes with fewer triangles are needless: their angles are too wide.
constexpr std::size_t kFewTriangles = 5;
/// No removal makes an edge longer than this, in wanted lengths, unless there was a longer one.
constexpr double kLongestMade = 1.4;
/// Edges longer than this are divided.
constexpr double kLongEdge = 1.6;
/// Triangles of a smaller angle than about 33 degrees are repaired.
constexpr double kPoorSine = 0.54;
/// Angles wider than 25 degrees are good enough to be traded for a node less.
constexpr double kFairSine = 0.42261826174069944;
/// A repair must raise the smallest sine by this.
constexpr double kMinSineGain = 0.01;
/// A change must not turn a triangle's normal by more than 60 degrees from what was there.
constexpr double kSharpFoldCosine = 0.5;
/// Where along the line between the diamond's far corners a new node is tried.
constexpr std::array<double, 3> kSplitShares{0.5, 0.35, 0.65};

}  // namespace

PlanarImprover::PlanarImprover(const PatchMetric& metric, PlanarMesh& mesh, PlanarLinks& links,
                               PlanarMoves& moves)
    : metric_(&metric), mesh_(&mesh), links_(&links), moves_(&moves) {
  std::vector<std::uint32_t> nodes(mesh.aliases.begin(), mesh.aliases.begin() + mesh.boundaryCount);
  stableSort(nodes);
  hasSeam_ = std::ranges::adjacent_find(nodes) != nodes.end();
}

// ---- measures ----------------------------------------------------------------------------------

LocalSpace PlanarImprover::localAt(std::uint32_t node) {
  return metric_->spaceAt(mesh_->places[node], mesh_->sizes[node], hint_);
}

double PlanarImprover::sine(const LocalSpace& local, std::uint32_t a, std::uint32_t b,
                            std::uint32_t c) const {
  return triangleSine(local.unit(mesh_->places[a]), local.unit(mesh_->places[b]),
                      local.unit(mesh_->places[c]));
}

double PlanarImprover::length(const LocalSpace& local, std::uint32_t a, std::uint32_t b) const {
  return glm::length(local.unit(mesh_->places[b] - mesh_->places[a])) / local.wantedSide;
}

double PlanarImprover::starSine(const LocalSpace& local, std::uint32_t centre) const {
  double least = 1.0;
  for (std::size_t i = 0; i < star_.ring.size(); ++i)
    least = std::min(least,
                     sine(local, centre, star_.ring[i], star_.ring[(i + 1) % star_.ring.size()]));
  return least;
}

/// The smallest sine of the star's triangles if `centre` were drawn into ring[into]; below zero if
/// one of them would turn the wrong way, or fold, or join what must not be joined.
double PlanarImprover::fanSine(const LocalSpace& local, std::uint32_t centre,
                               std::size_t into) const {
  const std::vector<std::uint32_t>& ring = star_.ring;
  const std::size_t count = ring.size();
  const auto normal = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return glm::cross(mesh_->places[b] - mesh_->places[a], mesh_->places[c] - mesh_->places[a]);
  };
  Vec3 mean(0.0);
  for (std::size_t i = 0; i < count; ++i) mean += normal(centre, ring[i], ring[(i + 1) % count]);
  double least = 1.0;
  for (std::size_t step = 1; step + 1 < count; ++step) {
    const std::uint32_t from = ring[(into + step) % count];
    const std::uint32_t to = ring[(into + step + 1) % count];
    if (mesh_->turn(ring[into], from, to) <= 0) return -1.0;
    if (step > 1 && !mesh_->mayJoin(ring[into], from)) return -1.0;
    const Vec3 turned = normal(ring[into], from, to);
    if (glm::dot(turned, mean) < kSharpFoldCosine * glm::length(turned) * glm::length(mean))
      return -1.0;
    least = std::min(least, sine(local, ring[into], from, to));
  }
  return least;
}

double PlanarImprover::longestOfFan(const LocalSpace& local, std::size_t into) const {
  double longest = 0.0;
  for (const std::uint32_t node : star_.ring)
    longest = std::max(longest, length(local, star_.ring[into], node));
  return longest;
}

/// Across a seam, a node must not be joined to both images of another, nor to its own: on a patch
/// with a seam, nodes that have a neighbour on the boundary stay.
bool PlanarImprover::mayRemove() const {
  return !hasSeam_ || std::ranges::all_of(star_.ring, [&](std::uint32_t node) {
    return node >= mesh_->boundaryCount;
  });
}

// ---- edges that must not be ----------------------------------------------------------------------

void PlanarImprover::part(std::uint32_t triangle) {
  const auto isForbidden = [&](std::uint32_t k) {
    return links_->neighbour(triangle, k) != kNoIndex &&
           !mesh_->mayJoin(links_->node(triangle, (k + 1) % 3),
                           links_->node(triangle, (k + 2) % 3));
  };
  // What is left of the triangle after a division is examined anew, the rest of it in its turn.
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!isForbidden(k)) continue;
    const PlanarLinks::Diamond sides = links_->diamond(triangle, k);
    const Vec2 middle = 0.5 * (mesh_->plane[sides.a] + mesh_->plane[sides.b]);
    if (splitSine(localAt(sides.a), sides, middle) < 0.0) continue;
    addAndSplit(triangle, k, middle);
    part(triangle);
    return;
  }
}

void PlanarImprover::partLoneTriangle() {
  constexpr double kThird = 1.0 / 3.0;
  if (links_->triangleCount() != 1 || mesh_->mayJoin(links_->node(0, 0), links_->node(0, 1)) ||
      mesh_->mayJoin(links_->node(0, 1), links_->node(0, 2)))
    return;
  Vec2 centre(0.0);
  for (std::uint32_t k = 0; k < 3; ++k) centre += kThird * mesh_->plane[links_->node(0, k)];
  links_->insert(0, addNode(centre));
}

// ---- lengths -----------------------------------------------------------------------------------

void PlanarImprover::thin(std::uint32_t node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = localAt(node);
  double shortest = 1.0;
  double longest = kLongestMade;
  for (const std::uint32_t other : star_.ring) {
    shortest = std::min(shortest, length(local, node, other));
    longest = std::max(longest, length(local, node, other));
  }
  if (shortest >= kShortEdge && star_.ring.size() >= kFewTriangles) return;
  const double before = std::min(starSine(local, node), kFairSine);
  if (!mayRemove()) return;
  std::size_t best = star_.ring.size();
  double bestSine = before;
  for (std::size_t i = 0; i < star_.ring.size(); ++i) {
    if (longestOfFan(local, i) > longest) continue;
    const double after = fanSine(local, node, i);
    if (after <= bestSine) continue;
    best = i;
    bestSine = after;
  }
  if (best < star_.ring.size()) links_->collapse(node, star_, best);
}

void PlanarImprover::refine(std::uint32_t triangle) {
  if (!links_->isAlive(triangle)) return;
  const LocalSpace local = localAt(links_->node(triangle, 0));
  double longest = kLongEdge;
  std::uint32_t side = 3;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const double found =
        length(local, links_->node(triangle, (k + 1) % 3), links_->node(triangle, (k + 2) % 3));
    if (found <= longest || links_->neighbour(triangle, k) == kNoIndex) continue;
    longest = found;
    side = k;
  }
  if (side == 3) return;
  const PlanarLinks::Diamond sides = links_->diamond(triangle, side);
  const Vec2 middle = 0.5 * (mesh_->plane[sides.a] + mesh_->plane[sides.b]);
  const double before = std::min(
      {sine(local, sides.c, sides.a, sides.b), sine(local, sides.d, sides.b, sides.a), kFairSine});
  if (splitSine(local, sides, middle) > before) addAndSplit(triangle, side, middle);
}

// ---- angles ------------------------------------------------------------------------------------

void PlanarImprover::repair(std::uint32_t triangle) {
  if (!links_->isAlive(triangle)) return;
  const std::array<std::uint32_t, 3> nodes{links_->node(triangle, 0), links_->node(triangle, 1),
                                           links_->node(triangle, 2)};
  const double before = sine(localAt(nodes[0]), nodes[0], nodes[1], nodes[2]);
  if (before >= kPoorSine) return;
  Change best;
  best.sine = before + kMinSineGain;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (links_->neighbour(triangle, k) == kNoIndex) continue;
    considerFlip(triangle, k, best);
    considerSplit(triangle, k, best);
  }
  for (const std::uint32_t node : nodes) considerCollapses(node, best);
  if (best.kind != Change::Kind::kNone) {
    make(best);
    return;
  }
  for (const std::uint32_t node : nodes) moves_->widen(node);
}

void PlanarImprover::considerFlip(std::uint32_t t, std::uint32_t k, Change& best) {
  const auto [other, a, b, c, d] = links_->diamond(t, k);
  if (!mesh_->mayJoin(c, d)) return;
  const LocalSpace local = localAt(a);
  const double after = std::min(sine(local, c, a, d), sine(local, c, d, b));
  if (after <= best.sine || mesh_->turn(c, a, d) <= 0 || mesh_->turn(c, d, b) <= 0) return;
  const auto& places = mesh_->places;
  if (foldCosine(places[c], places[d], places[b], places[a]) < kSharpFoldCosine) return;
  best = {Change::Kind::kFlip, after, t, k, Vec2(0.0)};
}

void PlanarImprover::considerCollapses(std::uint32_t node, Change& best) {
  if (!links_->collectStar(node, star_) || !mayRemove()) return;
  const LocalSpace local = localAt(node);
  const double before = starSine(local, node);
  for (std::size_t i = 0; i < star_.ring.size(); ++i) {
    if (longestOfFan(local, i) > kLongEdge) continue;
    const double after = fanSine(local, node, i);
    if (after > best.sine && after > before + kMinSineGain)
      best = {Change::Kind::kCollapse, after, node, static_cast<std::uint32_t>(i), Vec2(0.0)};
  }
}

void PlanarImprover::considerSplit(std::uint32_t t, std::uint32_t k, Change& best) {
  const PlanarLinks::Diamond sides = links_->diamond(t, k);
  const LocalSpace local = localAt(sides.a);
  // Two short sides more help nobody.
  if (length(local, sides.a, sides.b) < 2.0 * kShortEdge) return;
  const Vec2 middle = 0.5 * (mesh_->plane[sides.a] + mesh_->plane[sides.b]);
  const Vec2 across = 0.5 * (mesh_->plane[sides.c] + mesh_->plane[sides.d]);
  for (const double share : kSplitShares) {
    const Vec2 at = middle + share * (across - middle);
    const double after = splitSine(local, sides, at);
    if (after > best.sine) best = {Change::Kind::kSplit, after, t, k, at};
  }
}

double PlanarImprover::splitSine(const LocalSpace& local, const PlanarLinks::Diamond& sides,
                                 const Vec2& at) {
  const std::uint32_t node = addNode(at);
  double least = 1.0;
  for (const auto& [from, to] : {std::pair{sides.c, sides.a}, std::pair{sides.a, sides.d},
                                 std::pair{sides.d, sides.b}, std::pair{sides.b, sides.c}})
    least = mesh_->turn(node, from, to) > 0 ? std::min(least, sine(local, node, from, to)) : -1.0;
  mesh_->dropLastNode();
  return least;
}

void PlanarImprover::make(const Change& change) {
  switch (change.kind) {
    case Change::Kind::kFlip:
      links_->flip(change.at, change.corner);
      break;
    case Change::Kind::kCollapse:
      if (links_->collectStar(change.at, star_)) links_->collapse(change.at, star_, change.corner);
      break;
    case Change::Kind::kSplit:
      addAndSplit(change.at, change.corner, change.place);
      break;
    case Change::Kind::kNone:
      break;
  }
}

void PlanarImprover::addAndSplit(std::uint32_t t, std::uint32_t k, const Vec2& at) {
  const std::uint32_t node = addNode(at);
  links_->split(t, k, node);
  moves_->smooth(node);
}

std::uint32_t PlanarImprover::addNode(const Vec2& at) {
  const PlaneSample sample = metric_->sample(at, hint_);
  return mesh_->addNode(at, sample.position, sample.size);
}

}  // namespace tetrafront
