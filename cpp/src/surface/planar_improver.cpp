#include "surface/planar_improver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/sort.h"
#include "surface/rules.h"
#include "surface/triangle_shape.h"

namespace tetrafront {

PlanarImprover::PlanarImprover(const PatchMetric& metric, PlanarMesh& mesh, PlanarLinks& links,
                               PlanarMoves& moves)
    : metric_(&metric), mesh_(&mesh), links_(&links), moves_(&moves) {
  std::vector<NodeId> nodes(mesh.surfaceNodes.begin(),
                            mesh.surfaceNodes.begin() + mesh.boundaryCount);
  stableSort(nodes);
  hasSeam_ = std::ranges::adjacent_find(nodes) != nodes.end();
}

// ---- measures ----------------------------------------------------------------------------------

LocalSpace PlanarImprover::localSpaceAt(PlanarNodeId node) {
  return metric_->spaceAt(mesh_->positionOf(node), mesh_->sizeOf(node), hint_);
}

double PlanarImprover::sine(const LocalSpace& local, PlanarNodeId a, PlanarNodeId b,
                            PlanarNodeId c) const {
  return triangleSine(local.unit(mesh_->positionOf(a)), local.unit(mesh_->positionOf(b)),
                      local.unit(mesh_->positionOf(c)));
}

/// Length of an edge / target length.
double PlanarImprover::length(const LocalSpace& local, PlanarNodeId a, PlanarNodeId b) const {
  return glm::length(local.unit(mesh_->positionOf(b) - mesh_->positionOf(a))) / local.targetLength;
}

double PlanarImprover::starSine(const LocalSpace& local, PlanarNodeId centre) const {
  double smallest = 1.0;
  for (std::size_t i = 0; i < star_.ring.size(); ++i)
    smallest = std::min(
        smallest, sine(local, centre, star_.ring[i], star_.ring[(i + 1) % star_.ring.size()]));
  return smallest;
}

/// Returns the smallest sine of the fan that collapsing `centre` into ring[target] would make. Returns -1 if a
/// triangle would be flipped or folded, or if an edge would connect nodes that must not be connected.
double PlanarImprover::fanSine(const LocalSpace& local, PlanarNodeId centre,
                               std::size_t target) const {
  const std::vector<PlanarNodeId>& ring = star_.ring;
  const std::size_t count = ring.size();
  const auto normal = [&](PlanarNodeId a, PlanarNodeId b, PlanarNodeId c) {
    return glm::cross(mesh_->positionOf(b) - mesh_->positionOf(a),
                      mesh_->positionOf(c) - mesh_->positionOf(a));
  };
  Vec3 mean(0.0);
  for (std::size_t i = 0; i < count; ++i) mean += normal(centre, ring[i], ring[(i + 1) % count]);
  double smallest = 1.0;
  for (std::size_t step = 1; step + 1 < count; ++step) {
    const PlanarNodeId from = ring[(target + step) % count];
    const PlanarNodeId to = ring[(target + step + 1) % count];
    if (mesh_->orientation(ring[target], from, to) <= 0) return -1.0;
    if (step > 1 && !mesh_->canConnect(ring[target], from)) return -1.0;
    const Vec3 made = normal(ring[target], from, to);
    if (glm::dot(made, mean) < kSharpFoldCosine * glm::length(made) * glm::length(mean))
      return -1.0;
    smallest = std::min(smallest, sine(local, ring[target], from, to));
  }
  return smallest;
}

double PlanarImprover::longestOfFan(const LocalSpace& local, std::size_t target) const {
  double longest = 0.0;
  for (const PlanarNodeId node : star_.ring)
    longest = std::max(longest, length(local, star_.ring[target], node));
  return longest;
}

/// On a patch with a seam, keeps nodes that have a neighbour on the boundary. Otherwise a boundary node could be
/// connected to itself, or to both copies of another one, across the seam.
bool PlanarImprover::canRemoveCentre() const {
  return !hasSeam_ || std::ranges::none_of(
                          star_.ring, [&](PlanarNodeId node) { return mesh_->isBoundary(node); });
}

// ---- forbidden edges ---------------------------------------------------------------------------

void PlanarImprover::splitForbiddenEdges(PlanarTriangleId triangle) {
  const auto isForbidden = [&](std::uint32_t k) {
    return !links_->neighbour(triangle, k).isNone() &&
           !mesh_->canConnect(links_->node(triangle, (k + 1) % 3),
                              links_->node(triangle, (k + 2) % 3));
  };
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (!isForbidden(k)) continue;
    const PlanarLinks::Diamond diamond = links_->diamond(triangle, k);
    const Vec2 middle = 0.5 * (mesh_->planeOf(diamond.a) + mesh_->planeOf(diamond.b));
    if (splitSine(localSpaceAt(diamond.a), diamond, middle) < 0.0) continue;
    splitAt(triangle, k, middle);
    // The sweep visits the new triangles later, but not again the one that kept the index.
    splitForbiddenEdges(triangle);
    return;
  }
}

void PlanarImprover::splitLoneTriangle() {
  constexpr double kThird = 1.0 / 3.0;
  constexpr PlanarTriangleId kOnly(0U);
  if (links_->triangleCount() != 1 ||
      mesh_->canConnect(links_->node(kOnly, 0), links_->node(kOnly, 1)) ||
      mesh_->canConnect(links_->node(kOnly, 1), links_->node(kOnly, 2)))
    return;
  Vec2 centre(0.0);
  for (std::uint32_t k = 0; k < 3; ++k) centre += kThird * mesh_->planeOf(links_->node(kOnly, k));
  links_->insert(kOnly, addNode(centre));
}

// ---- lengths -----------------------------------------------------------------------------------

void PlanarImprover::removeIfNeedless(PlanarNodeId node) {
  if (!links_->collectStar(node, star_)) return;
  const LocalSpace local = localSpaceAt(node);
  double shortest = 1.0;
  double longest = kMaxEdgeOfFan;
  for (const PlanarNodeId other : star_.ring) {
    shortest = std::min(shortest, length(local, node, other));
    longest = std::max(longest, length(local, node, other));
  }
  if (shortest >= kShortEdge && star_.ring.size() >= kFewTriangles) return;
  if (!canRemoveCentre()) return;
  std::size_t best = star_.ring.size();
  double bestSine = std::min(starSine(local, node), kFairSine);
  for (std::size_t i = 0; i < star_.ring.size(); ++i) {
    if (longestOfFan(local, i) > longest) continue;
    const double after = fanSine(local, node, i);
    if (after <= bestSine) continue;
    best = i;
    bestSine = after;
  }
  if (best < star_.ring.size()) links_->collapse(node, star_, best);
}

void PlanarImprover::splitLongEdge(PlanarTriangleId triangle) {
  if (!links_->isAlive(triangle)) return;
  constexpr std::uint32_t kNoCorner = 3;
  const LocalSpace local = localSpaceAt(links_->node(triangle, 0));
  double longest = kLongEdge;
  std::uint32_t corner = kNoCorner;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const double found =
        length(local, links_->node(triangle, (k + 1) % 3), links_->node(triangle, (k + 2) % 3));
    if (found <= longest || links_->neighbour(triangle, k).isNone()) continue;
    longest = found;
    corner = k;
  }
  if (corner == kNoCorner) return;
  const PlanarLinks::Diamond diamond = links_->diamond(triangle, corner);
  const auto& [other, a, b, c, d] = diamond;
  const Vec2 middle = 0.5 * (mesh_->planeOf(a) + mesh_->planeOf(b));
  const double before = std::min({sine(local, c, a, b), sine(local, d, b, a), kFairSine});
  if (splitSine(local, diamond, middle) > before) splitAt(triangle, corner, middle);
}

// ---- angles ------------------------------------------------------------------------------------

void PlanarImprover::widenSmallAngle(PlanarTriangleId triangle) {
  if (!links_->isAlive(triangle)) return;
  const PlanarMesh::Triangle nodes = mesh_->triangles[triangle.index()];
  const double before = sine(localSpaceAt(nodes[0]), nodes[0], nodes[1], nodes[2]);
  if (before >= kPoorSine) return;
  Change best;
  best.sine = before + kMinSineGain;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (links_->neighbour(triangle, k).isNone()) continue;
    considerFlip(triangle, k, best);
    considerSplit(triangle, k, best);
  }
  for (const PlanarNodeId node : nodes) considerCollapses(node, best);
  if (best.kind != Change::Kind::kNone) {
    apply(best);
    return;
  }
  for (const PlanarNodeId node : nodes) moves_->widenAngles(node);
}

void PlanarImprover::considerFlip(PlanarTriangleId t, std::uint32_t k, Change& best) {
  const auto [other, a, b, c, d] = links_->diamond(t, k);
  if (!mesh_->canConnect(c, d)) return;
  const LocalSpace local = localSpaceAt(a);
  const double after = std::min(sine(local, c, a, d), sine(local, c, d, b));
  if (after <= best.sine || mesh_->orientation(c, a, d) <= 0 || mesh_->orientation(c, d, b) <= 0)
    return;
  if (foldCosine(mesh_->positionOf(c), mesh_->positionOf(d), mesh_->positionOf(b),
                 mesh_->positionOf(a)) < kSharpFoldCosine)
    return;
  best = {.kind = Change::Kind::kFlip, .sine = after, .triangle = t, .corner = k};
}

void PlanarImprover::considerCollapses(PlanarNodeId node, Change& best) {
  if (!links_->collectStar(node, star_) || !canRemoveCentre()) return;
  const LocalSpace local = localSpaceAt(node);
  const double before = starSine(local, node);
  for (std::size_t i = 0; i < star_.ring.size(); ++i) {
    if (longestOfFan(local, i) > kLongEdge) continue;
    const double after = fanSine(local, node, i);
    if (after > best.sine && after > before + kMinSineGain)
      best = {.kind = Change::Kind::kCollapse, .sine = after, .node = node, .target = i};
  }
}

void PlanarImprover::considerSplit(PlanarTriangleId t, std::uint32_t k, Change& best) {
  const PlanarLinks::Diamond diamond = links_->diamond(t, k);
  const LocalSpace local = localSpaceAt(diamond.a);
  // The two halves must not be short edges.
  if (length(local, diamond.a, diamond.b) < 2.0 * kShortEdge) return;
  const Vec2 middle = 0.5 * (mesh_->planeOf(diamond.a) + mesh_->planeOf(diamond.b));
  const Vec2 across = 0.5 * (mesh_->planeOf(diamond.c) + mesh_->planeOf(diamond.d));
  for (const double fraction : kSplitFractions) {
    const Vec2 at = middle + fraction * (across - middle);
    const double after = splitSine(local, diamond, at);
    if (after > best.sine)
      best = {
          .kind = Change::Kind::kSplit, .sine = after, .triangle = t, .corner = k, .position = at};
  }
}

/// Returns the smallest sine of the four triangles that a node at `at` would make; -1 if one would be flipped.
double PlanarImprover::splitSine(const LocalSpace& local, const PlanarLinks::Diamond& diamond,
                                 const Vec2& at) {
  const auto& [other, a, b, c, d] = diamond;
  const PlanarNodeId node = addNode(at);
  double smallest = 1.0;
  for (const auto& [from, to] :
       {std::pair{c, a}, std::pair{a, d}, std::pair{d, b}, std::pair{b, c}})
    smallest = mesh_->orientation(node, from, to) > 0
                   ? std::min(smallest, sine(local, node, from, to))
                   : -1.0;
  mesh_->removeLastNode();
  return smallest;
}

void PlanarImprover::apply(const Change& change) {
  switch (change.kind) {
    case Change::Kind::kFlip:
      links_->flip(change.triangle, change.corner);
      break;
    case Change::Kind::kCollapse:
      if (links_->collectStar(change.node, star_))
        links_->collapse(change.node, star_, change.target);
      break;
    case Change::Kind::kSplit:
      splitAt(change.triangle, change.corner, change.position);
      break;
    case Change::Kind::kNone:
      break;
  }
}

void PlanarImprover::splitAt(PlanarTriangleId t, std::uint32_t k, const Vec2& at) {
  const PlanarNodeId node = addNode(at);
  links_->split(t, k, node);
  moves_->smooth(node);
}

PlanarNodeId PlanarImprover::addNode(const Vec2& at) {
  const PlaneSample sample = metric_->sample(at, hint_);
  return mesh_->addNode(at, sample.position, sample.size);
}

}  // namespace tetrafront
