#include "remesh/volume_correction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "geom/measure.h"
#include "quality/metrics.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Change of a volume, relative to it, that is left.
constexpr double kMinChange = 2e-3;
/// The same for parts if the whole volume has changed by more.
constexpr double kMinChangeOfPart = 2e-4;
constexpr int kMaxCorrections = 3;
/// Mean distance of a triangle from a smooth patch / distance of its centroid. Over an equilateral triangle, a quadratic
/// function differs from the linear one by 3 / 4 of the largest difference on average.
constexpr double kMeanPerCentroid = 0.75;
/// Length / tolerance of moves that are not worth their time.
constexpr double kMinMove = 0.01;
/// Distances measured per unit of budget.
constexpr std::size_t kGapsPerUnit = 16;
/// A move may reduce the radius ratio of a triangle by this factor.
constexpr double kMinRatioKept = 0.98;

}  // namespace

VolumeCorrection::VolumeCorrection(GuardedSurface& surface)
    : surface_(surface), complex_(surface.complex()), reference_(surface.reference()) {
  findParts();
}

/// Finds the connected parts and their volumes.
void VolumeCorrection::findParts() {
  partOf_.resize(reference_.patchCount());
  std::iota(partOf_.begin(), partOf_.end(), 0U);
  const auto rootOf = [this](std::uint32_t patch) {
    while (partOf_[patch] != patch) patch = partOf_[patch] = partOf_[partOf_[patch]];
    return patch;
  };
  for (const FeatureLine& line : reference_.lines()) {
    for (const std::uint32_t patch : line.patches) partOf_[rootOf(patch)] = rootOf(line.patches[0]);
  }
  for (std::uint32_t patch = 0; patch < partOf_.size(); ++patch) partOf_[patch] = rootOf(patch);
  given_.assign(partOf_.size(), 0.0);
  const Vec3 origin = pointOf(reference_.mesh(), NodeId(0U));
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(reference_.mesh()))) {
    const auto [a, b, c] = cornersOf(reference_.mesh(), t);
    given_[partOf_[reference_.patchOf(t).index()]] += sixVolumesBelow(origin, a, b, c);
  }
}

/// Finds the parts whose volumes have changed; returns false if there are none.
bool VolumeCorrection::findChanged() {
  std::vector<double> made(given_.size(), 0.0);
  std::vector<double> curvedArea(given_.size(), 0.0);
  const Vec3 origin = pointOf(reference_.mesh(), NodeId(0U));
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t)) continue;
    const std::array<Vec3, 3> corners = complex_.cornersOf(t);
    const auto& [a, b, c] = corners;
    const SmoothPatchId patch = complex_.patchOf(t);
    const std::uint32_t part = partOf_[patch.index()];
    made[part] += sixVolumesBelow(origin, a, b, c);
    if (!reference_.patch(patch).isPlanar) curvedArea[part] += areaOf(corners);
  }
  isChanged_.assign(given_.size(), 0);
  evenGap_.assign(given_.size(), 0.0);
  // A thin wall has the difference of two volumes.
  const double whole = std::accumulate(given_.begin(), given_.end(), 0.0);
  const double wholeMade = std::accumulate(made.begin(), made.end(), 0.0);
  const bool hasChanged = std::fabs(wholeMade - whole) > kMinChange * std::fabs(whole);
  const double least = hasChanged ? kMinChangeOfPart : kMinChange;
  for (std::size_t i = 0; i < given_.size(); ++i) {
    const double missing = given_[i] - made[i];
    if (std::fabs(missing) > least * std::fabs(given_[i])) isChanged_[i] = 1;
    if (curvedArea[i] > 0.0) evenGap_[i] = missing / (6.0 * curvedArea[i]);
  }
  return std::ranges::find(isChanged_, 1) != isChanged_.end();
}

bool VolumeCorrection::isSelected(TriangleId triangle) const {
  return complex_.isAlive(triangle) && isChanged_[partOf_[complex_.patchOf(triangle).index()]] != 0;
}

Task<> VolumeCorrection::run(Work& work) {
  for (int pass = 0; pass < kMaxCorrections && findChanged(); ++pass) {
    co_await correct(work, &VolumeCorrection::addLineGaps);
    if (pass == 0) {
      co_await correct(work, &VolumeCorrection::addPatchGap);
    } else {
      // The moves along the lines have changed what is missing.
      if (!findChanged()) co_return;
      co_await correct(work, &VolumeCorrection::addEvenGap);
    }
  }
}

/// Moves nodes. All gaps are measured before the first move.
Task<> VolumeCorrection::correct(Work& work, AddGap add) {
  gaps_.assign(complex_.nodeCount(), Gap{});
  co_await work.forEachId<TriangleId>(
      complex_.triangleSlots(),
      [this, add](TriangleId triangle) {
        if (isSelected(triangle)) (this->*add)(triangle);
      },
      kGapsPerUnit);
  co_await work.forEachId<NodeId>(complex_.nodeCount(), [this](NodeId node) { move(node); });
}

/// Adds the mean distances of the feature lines from the feature edges of a triangle.
void VolumeCorrection::addLineGaps(TriangleId triangle) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfEdgeId halfEdge = halfEdgeOf(triangle, k);
    const StretchId id = complex_.stretchOf(halfEdge);
    if (id.isNone()) continue;
    const Stretch& stretch = complex_.stretch(id);
    const auto [a, b, apex] = complex_.nodesOf(halfEdge);
    const Vec3 edge = complex_.pointOf(b) - complex_.pointOf(a);
    const double squared = glm::dot(edge, edge);
    // Relative to a node: a flat face across an axis stays exactly flat.
    const FeatureLine& line = reference_.line(stretch.line);
    Vec3 gap = line.centroidFrom(complex_.pointOf(a), stretch.begin, stretch.end) - 0.5 * edge;
    gap -= edge * (glm::dot(gap, edge) / squared);
    const double weight = std::sqrt(squared);
    for (const NodeId node : {a, b}) {
      if (complex_.kindOf(node) != NodeKind::kLine) continue;
      gaps_[node.index()].sum += gap * weight;
      gaps_[node.index()].weight += weight;
    }
  }
}

/// Adds the mean distance of the patch from a triangle.
void VolumeCorrection::addPatchGap(TriangleId triangle) {
  const SmoothPatchId patch = complex_.patchOf(triangle);
  if (reference_.patch(patch).isPlanar) return;
  const std::array<Vec3, 3> corners = complex_.cornersOf(triangle);
  const Vec3 centroid = centroidOf(corners);
  const NearestPoint nearest =
      reference_.nearest(centroid, patch, surface_.tolerance(), surface_.beneath(triangle));
  if (nearest.triangle.isNone()) return;
  const Vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  addGap(triangle,
         kMeanPerCentroid * glm::dot(nearest.position - centroid, cross) / glm::length(cross));
}

/// Spreads what is missing over the curved patches: the distances that are measured at the centroids have an error, which
/// is the larger the coarser the given facets are.
void VolumeCorrection::addEvenGap(TriangleId triangle) {
  const SmoothPatchId patch = complex_.patchOf(triangle);
  if (!reference_.patch(patch).isPlanar) addGap(triangle, evenGap_[partOf_[patch.index()]]);
}

/// Adds a distance from the triangle to the nodes inside its patch.
void VolumeCorrection::addGap(TriangleId triangle, double height) {
  const std::array<Vec3, 3> corners = complex_.cornersOf(triangle);
  const Vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  for (const NodeId node : complex_.nodesOf(triangle)) {
    if (complex_.kindOf(node) != NodeKind::kSmooth) continue;
    gaps_[node.index()].sum += cross * height;
    gaps_[node.index()].weight += glm::length(cross);
  }
}

void VolumeCorrection::move(NodeId node) {
  const auto& [sum, weight] = gaps_[node.index()];
  if (!(weight > 0.0)) return;
  const Vec3 step = sum / weight;
  if (glm::length(step) < kMinMove * surface_.tolerance()) return;
  const Vec3 here = complex_.pointOf(node);
  for (const double part : {1.0, 0.5, 0.25}) {
    if (tryMove(node, here + step * part)) break;
  }
}

bool VolumeCorrection::tryMove(NodeId node, const Vec3& to) {
  if (complex_.kindOf(node) == NodeKind::kLine && !followsLine(node, to)) return false;
  change_.clear();
  change_.moved = node;
  change_.position = reference_.representable(to);
  complex_.collectStar(node, change_.removed);
  for (const TriangleId t : change_.removed) {
    std::array<Vec3, 3> corners = complex_.cornersOf(t);
    const double before = triangleRadiusRatio(corners[0], corners[1], corners[2]);
    const NodeTriple& nodes = complex_.nodesOf(t);
    for (std::size_t k = 0; k < 3; ++k) {
      if (nodes[k] == node) corners[k] = change_.position;
    }
    if (triangleRadiusRatio(corners[0], corners[1], corners[2]) < kMinRatioKept * before)
      return false;
    change_.added.push_back({nodes, complex_.patchOf(t)});
  }
  return surface_.apply(change_);
}

/// Returns true if the stretches of the line beside a node stay within the tolerance of their edges.
bool VolumeCorrection::followsLine(NodeId node, const Vec3& to) const {
  const SurfaceComplex::LineNeighbours line = complex_.lineNeighbours(node);
  if (!line.areComplete()) return false;
  const Stretch& first = complex_.stretch(line.first);
  const Stretch& second = complex_.stretch(line.second);
  const double limit = surface_.tolerance() * surface_.tolerance();
  const FeatureLine& along = reference_.line(first.line);
  return along.squaredDeviation(first.begin, first.end, complex_.pointOf(line.before), to) <=
             limit &&
         along.squaredDeviation(second.begin, second.end, to, complex_.pointOf(line.after)) <=
             limit;
}

}  // namespace tetrafront
