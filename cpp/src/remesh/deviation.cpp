#include "remesh/deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geom/measure.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Division of a triangle ends after this many steps, or at this ratio of the bound to the distance: the bound is then at
/// most 2 % above the distance.
constexpr int kMaxDepth = 48;
constexpr double kSharpness = 1.02;
/// A part is cut only if it extends to both sides of the edge by more than this, relative to the bound.
/// The bound is about 1e-3 of the diagonal, so this is 1e-12 of it, a few thousand roundings.
constexpr double kMinCutPerBound = 1e-9;
/// Sampled distance / tolerance below which the nearest point found by a walk counts as nearest of all: the samples are for
/// colours, in which a fiftieth of the tolerance cannot be seen.
constexpr double kMinSampled = 0.02;
/// Steps of a walk between neighbouring triangles, after which the tree is faster.
constexpr int kMaxWalk = 24;

/// Distance of a position from a patch, for display.
float distanceFrom(const ReferenceSurface& reference, const Vec3& position, SmoothPatchId patch,
                   TriangleId hint, double tolerance) {
  // The walk from the hint ends near the nearest point, and so makes the search short.
  const double near = reference.nearest(position, patch, tolerance, hint).squaredDistance;
  const double least = kMinSampled * tolerance;
  if (near <= least * least) return static_cast<float>(std::sqrt(near));
  return static_cast<float>(
      std::sqrt(reference.nearest(position, patch, std::sqrt(near), {}).squaredDistance));
}

}  // namespace

DeviationBound::DeviationBound(const GuardedSurface& surface, double least)
    : Resumable(countTriangles(surface.reference().mesh())),
      complex_(surface.complex()),
      reference_(surface.reference()),
      bound_(least),
      above_(countTriangles(surface.reference().mesh())) {
  std::vector<Box> boxes;
  frames_.resize(complex_.triangleSlots());
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t) || reference_.patch(complex_.patchOf(t)).isPlanar) continue;
    const auto [a, b, c] = complex_.cornersOf(t);
    boxes.push_back(Box::of(a, b, c));
    frames_[t.index()] = TriangleFrame({a, b, c});
    items_.push_back(t);
    if (!surface.beneath(t).isNone()) above_[surface.beneath(t).index()] = t;
  }
  if (!boxes.empty()) tree_ = BoxTree(std::span<const Box>(boxes));
  spreadAbove();
  findNeighbours();
}

/// Gives a given triangle that no remeshed one was made above the one of a neighbour, to walk from.
void DeviationBound::spreadAbove() {
  std::vector<TriangleId> known;
  for (const TriangleId t : IdRange<TriangleId>(above_.size())) {
    if (!above_[t.index()].isNone()) known.push_back(t);
  }
  for (std::size_t i = 0; i < known.size(); ++i) {
    const TriangleId t = known[i];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const TriangleId next = reference_.smoothNeighbour(halfEdgeOf(t, k));
      if (next.isNone() || !above_[next.index()].isNone()) continue;
      above_[next.index()] = above_[t.index()];
      known.push_back(next);
    }
  }
}

/// Links the triangles of each curved patch across its edges.
void DeviationBound::findNeighbours() {
  neighbours_.resize(3 * complex_.triangleSlots());
  std::vector<HalfEdgeId> edge;
  for (const TriangleId t : items_) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfEdgeId halfEdge = halfEdgeOf(t, k);
      if (!complex_.stretchOf(halfEdge).isNone()) continue;
      const auto [a, b, apex] = complex_.nodesOf(halfEdge);
      complex_.collectEdge(a, b, edge);
      if (edge.size() != 2) continue;
      neighbours_[halfEdge.index()] = triangleOf(edge[edge[0] == halfEdge ? 1 : 0]);
    }
  }
}

bool DeviationBound::advance(std::size_t budget) {
  parts_ = 0;
  while (!isPassDone() && parts_ < budget) {
    const TriangleId t(take(1).first);
    const SmoothPatchId patch = reference_.patchOf(t);
    if (reference_.patch(patch).isPlanar) {
      ++parts_;
    } else {
      measure(cornersOf(reference_.mesh(), t), patch, above_[t.index()], 0);
    }
  }
  return isPassDone();
}

/// Walks from a triangle to one that is nearer to the position than its neighbours across the edges beyond which the
/// position lies.
TriangleId DeviationBound::walk(const Vec3& position, TriangleId from) const {
  TriangleId here = from;
  TriangleFrame::Distance distance = frames_[here.index()].measure(position);
  for (int step = 0; step < kMaxWalk; ++step) {
    const TriangleId last = here;
    const std::uint32_t beyond = distance.beyond;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const TriangleId next = neighbours_[halfEdgeOf(last, k).index()];
      if ((beyond >> k & 1U) == 0 || next.isNone()) continue;
      const TriangleFrame::Distance other = frames_[next.index()].measure(position);
      if (other.squared >= distance.squared) continue;
      distance = other;
      here = next;
    }
    if (here == last) break;
  }
  return here;
}

/// Returns the triangle of the patch nearest to the position. `guess`: one that may be near, or none.
TriangleId DeviationBound::nearest(const Vec3& position, SmoothPatchId patch,
                                   TriangleId guess) const {
  double square = std::numeric_limits<double>::infinity();
  if (!guess.isNone()) square = frames_[guess.index()].squaredDistance(position);
  TriangleId found = guess;
  tree_.visitNear(position, square, [&](std::uint32_t item) {
    const TriangleId t = items_[item];
    if (complex_.patchOf(t) != patch) return;
    const double other = frames_[t.index()].squaredDistance(position);
    if (other >= square) return;
    square = other;
    found = t;
  });
  return found;
}

double DeviationBound::boundBy(const Corners& corners, TriangleId triangle) const {
  const TriangleFrame& frame = frames_[triangle.index()];
  double largest = 0.0;
  for (const Vec3& corner : corners) {
    largest = std::max(largest, frame.squaredDistance(corner));
  }
  return std::sqrt(largest);
}

/// Returns the plane through an edge of the triangle beyond which most of the part lies, if the rest of the part is
/// within the bound of the triangle.
std::optional<Cut> DeviationBound::findCut(const Corners& corners, TriangleId triangle) const {
  const Corners over = complex_.cornersOf(triangle);
  const Vec3 cross = glm::cross(over[1] - over[0], over[2] - over[0]);
  const double area = glm::length(cross);
  if (!(area > 0.0)) return {};
  const Vec3 normal = cross / area;
  for (const Vec3& corner : corners) {
    if (std::fabs(glm::dot(corner - over[0], normal)) > bound_) return {};
  }
  std::optional<Cut> best;
  double farthest = kMinCutPerBound * bound_;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 edge = over[(k + 1) % 3] - over[k];
    const Cut cut{over[k], glm::cross(edge, normal) / glm::length(edge)};
    const auto [least, most] = std::ranges::minmax(cut.depthsOf(corners));
    if (most <= farthest || least >= -kMinCutPerBound * bound_) continue;
    farthest = most;
    best = cut;
  }
  return best;
}

void DeviationBound::measure(const Corners& corners, SmoothPatchId patch, TriangleId guess,
                             int depth) {
  ++parts_;
  const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
  TriangleId t = guess.isNone() ? nearest(centroid, patch, {}) : walk(centroid, guess);
  double bound = boundBy(corners, t);
  if (bound <= bound_) return;
  if (const std::optional<Cut> cut = findCut(corners, t); cut && depth < kMaxDepth) {
    for (const Corners& part : divide(corners, *cut)) measure(part, patch, t, depth + 1);
    return;
  }
  t = nearest(centroid, patch, t);
  bound = boundBy(corners, t);
  if (bound <= bound_) return;
  // The distance of the centroid is at most the largest one.
  const bool isSharp =
      bound <= kSharpness * std::sqrt(frames_[t.index()].squaredDistance(centroid));
  if (isSharp || depth >= kMaxDepth) {
    bound_ = bound;
    return;
  }
  for (const Corners& half : halvesOf(corners)) measure(half, patch, t, depth + 1);
}

float SampledDeviation::distanceAt(const Vec3& position, TriangleId triangle) const {
  return distanceFrom(surface_.reference(), position, surface_.complex().patchOf(triangle),
                      surface_.beneath(triangle), surface_.tolerance());
}

/// Distance of the middle of an edge, which its two triangles share unless they are in different patches.
float SampledDeviation::ofEdge(HalfEdgeId halfEdge) {
  const SurfaceComplex& complex = surface_.complex();
  const auto [a, b, apex] = complex.nodesOf(halfEdge);
  const auto measured = [&] {
    return distanceAt(0.5 * (complex.pointOf(a) + complex.pointOf(b)), triangleOf(halfEdge));
  };
  if (!complex.stretchOf(halfEdge).isNone()) return measured();
  float& distance = ofEdge_[complex.halfEdgeBetween(std::min(a, b), std::max(a, b)).index()];
  if (distance < 0.0F) distance = measured();
  return distance;
}

float sampledDeviation(const ReferenceSurface& reference, const std::array<Vec3, 3>& corners,
                       TriangleId near, double tolerance) {
  const SmoothPatchId patch = reference.patchOf(near);
  if (reference.patch(patch).isPlanar) return 0.0F;
  const auto distanceAt = [&](const Vec3& position) {
    return distanceFrom(reference, position, patch, near, tolerance);
  };
  const auto& [a, b, c] = corners;
  float largest = distanceAt((a + b + c) / 3.0);
  for (std::size_t k = 0; k < 3; ++k) {
    largest = std::max(largest, distanceAt(corners[k]));
    largest = std::max(largest, distanceAt(0.5 * (corners[k] + corners[(k + 1) % 3])));
  }
  return largest;
}

float SampledDeviation::of(TriangleId triangle) {
  const SurfaceComplex& complex = surface_.complex();
  if (surface_.reference().patch(complex.patchOf(triangle)).isPlanar) return 0.0F;
  float largest = 0.0F;
  for (const NodeId node : complex.nodesOf(triangle)) {
    float& distance = ofNode_[node.index()];
    if (distance < 0.0F) distance = distanceAt(complex.pointOf(node), triangle);
    largest = std::max(largest, distance);
  }
  const auto [a, b, c] = complex.cornersOf(triangle);
  largest = std::max(largest, distanceAt((a + b + c) / 3.0, triangle));
  for (std::uint32_t k = 0; k < 3; ++k)
    largest = std::max(largest, ofEdge(halfEdgeOf(triangle, k)));
  return largest;
}

}  // namespace tetrafront
