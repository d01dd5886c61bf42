#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "remesh/surface_editor.h"
#include "remesh/triangle_parts.h"

namespace tetrafront {
namespace {

/// Smallest gains of a radius ratio, which is at most 1, that justify a move; with any gain, rounding could move a node for
/// ever. With a gain of .001 and all parts of the way, smoothing would raise the mean ratio by .004 and remeshing would take
/// a quarter longer; the poorest triangles would not profit.
constexpr double kMinSmoothingGain = 5e-3;
/// The few poorest triangles also profit from small steps.
constexpr double kMinImprovement = 1e-3;
/// Fractions of the way that are tried one after the other. Smoothing comes back to a node soon.
constexpr std::array<double, 1> kSmoothingParts{1.0};
constexpr std::array<double, 3> kImprovingParts{1.0, 0.5, 0.25};
/// If all triangles have radius ratios above this after a move, a rise of their mean justifies the
/// move, even if the poorest triangle does not improve.
constexpr double kGoodRatio = 0.6;
/// Steps of improve() / mean edge length at the node, on a patch and along a line.
constexpr std::array<double, 3> kPatchSteps{0.4, 0.15, 0.05};
constexpr std::array<double, 4> kLineSteps{0.3, -0.3, 0.1, -0.1};
constexpr double kHalfRoot = 0.70710678118654752;
/// Eight directions in the plane.
constexpr std::array<std::array<double, 2>, 8> kDirections{{{1.0, 0.0},
                                                            {kHalfRoot, kHalfRoot},
                                                            {0.0, 1.0},
                                                            {-kHalfRoot, kHalfRoot},
                                                            {-1.0, 0.0},
                                                            {-kHalfRoot, -kHalfRoot},
                                                            {0.0, -1.0},
                                                            {kHalfRoot, -kHalfRoot}}};

std::span<const double> partsFor(MovePurpose purpose) {
  if (purpose == MovePurpose::kSmooth) return kSmoothingParts;
  return kImprovingParts;
}

}  // namespace

void SurfaceEditor::beginMove(NodeId node) {
  change_.clear();
  complex_.collectStar(node, change_.removed);
  for (const TriangleId t : change_.removed) {
    change_.added.push_back({complex_.nodesOf(t), complex_.patchOf(t)});
  }
  change_.moved = node;
  change_.position = complex_.pointOf(node);
}

bool SurfaceEditor::endMove(bool wasMade) {
  change_.clear();
  return wasMade;
}

bool SurfaceEditor::isBetter(const Ratios& before, MovePurpose purpose) const {
  const bool forMean = purpose == MovePurpose::kSmooth;
  const double least = forMean ? kMinSmoothingGain : kMinImprovement;
  const Ratios after = ratiosAdded();
  if (after.poorest > before.poorest + least) return true;
  return forMean && after.poorest > kGoodRatio && after.mean > before.mean + least;
}

/// Projects the moved node onto its patch; returns false if the patch is too far away.
bool SurfaceEditor::projectMove(NodeId node) {
  const Vec3& here = complex_.pointOf(node);
  const SmoothPatchId id = change_.added[0].patch;
  const SmoothPatch& patch = reference_.patch(id);
  if (patch.isPlanar) {
    const double height = glm::dot(change_.position - here, patch.normal);
    change_.position = reference_.representable(change_.position - patch.normal * height);
    return true;
  }
  if (const PatchFacetId facet = surface_.facetUnder(change_.removed); !facet.isNone()) {
    change_.position =
        reference_.representable(reference_.facet(facet).projected(change_.position));
    return true;
  }
  const double reach = std::max(2.0 * surface_.tolerance(), 0.5 * sizeOf(node));
  const NearestPoint nearest =
      reference_.nearest(change_.position, id, reach, surface_.beneath(change_.removed[0]));
  change_.position = reference_.representable(nearest.position);
  return !nearest.triangle.isNone();
}

bool SurfaceEditor::moveOnPatch(NodeId node, const Vec3& target, MovePurpose purpose) {
  beginMove(node);
  const Vec3 here = change_.position;
  const Ratios before = ratiosAdded();
  for (const double part : partsFor(purpose)) {
    change_.position = here + (target - here) * part;
    if (projectMove(node) && isBetter(before, purpose) && apply()) return endMove(true);
  }
  return endMove(false);
}

bool SurfaceEditor::moveOnLine(NodeId node, double arc, MovePurpose purpose) {
  const SurfaceComplex::LineNeighbours line = complex_.lineNeighbours(node);
  if (!line.areComplete()) return false;
  beginMove(node);
  const Ratios before = ratiosAdded();
  Stretch first = complex_.stretch(line.first);
  Stretch second = complex_.stretch(line.second);
  // Arcs jump by the length of a closed line where the line begins.
  const double jump = second.begin - first.end;
  const double here = first.end;
  for (const double part : partsFor(purpose)) {
    first.end = here + (arc - here) * part;
    second.begin = first.end + jump;
    change_.position = reference_.representable(reference_.line(first.line).at(first.end));
    if (!isBetter(before, purpose) ||
        !follows(first.line, first.begin, first.end, complex_.pointOf(line.before),
                 change_.position) ||
        !follows(second.line, second.begin, second.end, change_.position,
                 complex_.pointOf(line.after)))
      continue;
    if (!apply()) continue;
    surface_.updateStretch(line.first, first);
    surface_.updateStretch(line.second, second);
    return endMove(true);
  }
  return endMove(false);
}

/// Returns the weighted mean of the centroids of a node's triangles. The weight of a triangle grows
/// with its area in target lengths, so that triangles that are too large shrink.
Vec3 SurfaceEditor::centreOf(NodeId node) const {
  Vec3 sum(0.0);
  double weights = 0.0;
  complex_.visitStar(node, [&](TriangleId t, std::uint32_t /*k*/) {
    const NodeTriple& nodes = complex_.nodesOf(t);
    const Corners corners = complex_.cornersOf(t);
    const double size = (sizeOf(nodes[0]) + sizeOf(nodes[1]) + sizeOf(nodes[2])) / 3.0;
    const double weight =
        glm::length(crossOf(inMetric(nodes, corners))) / (size * size * size * size);
    sum += (corners[0] + corners[1] + corners[2]) * (weight / 3.0);
    weights += weight;
  });
  return weights > 0.0 ? sum / weights : complex_.pointOf(node);
}

bool SurfaceEditor::smooth(NodeId node) {
  if (isKept(node) || !complex_.isUsed(node) || complex_.kindOf(node) == NodeKind::kCorner)
    return false;
  if (complex_.kindOf(node) == NodeKind::kSmooth)
    return moveOnPatch(node, centreOf(node), MovePurpose::kSmooth);
  const SurfaceComplex::LineNeighbours line = complex_.lineNeighbours(node);
  if (!line.areComplete()) return false;
  const Stretch& first = complex_.stretch(line.first);
  const Stretch& second = complex_.stretch(line.second);
  const double whole = (first.end - first.begin) + (second.end - second.begin);
  const double before = sizeOf(line.before) + sizeOf(node);
  const double after = sizeOf(line.after) + sizeOf(node);
  return moveOnLine(node, first.begin + whole * before / (before + after), MovePurpose::kSmooth);
}

bool SurfaceEditor::improve(NodeId node) {
  if (isKept(node) || !complex_.isUsed(node) || complex_.kindOf(node) == NodeKind::kCorner)
    return false;
  return complex_.kindOf(node) == NodeKind::kLine ? improveOnLine(node) : improveOnPatch(node);
}

bool SurfaceEditor::improveOnLine(NodeId node) {
  bool moved = false;
  for (const double step : kLineSteps) {
    const SurfaceComplex::LineNeighbours line = complex_.lineNeighbours(node);
    if (!line.areComplete()) return moved;
    const Stretch& towards = complex_.stretch(step > 0.0 ? line.second : line.first);
    const double arc = complex_.stretch(line.first).end + step * (towards.end - towards.begin);
    moved = moveOnLine(node, arc, MovePurpose::kImprove) || moved;
  }
  return moved;
}

bool SurfaceEditor::improveOnPatch(NodeId node) {
  bool moved = false;
  for (const double step : kPatchSteps) {
    beginMove(node);
    const Vec3 here = change_.position;
    Vec3 normal(0.0);
    double reach = 0.0;
    for (const SurfaceChange::Added& added : change_.added) {
      const Corners corners = cornersOf(added.nodes);
      normal += crossOf(corners);
      for (const Vec3& corner : corners) reach += 0.5 * glm::length(corner - here);
    }
    const double length = glm::length(normal);
    if (!(length > 0.0)) return moved;
    normal /= length;
    reach *= step / static_cast<double>(change_.added.size());
    const Vec3 axis = std::fabs(normal.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
    const Vec3 u = glm::normalize(glm::cross(axis, normal));
    const Vec3 v = glm::cross(normal, u);
    Vec3 best = here;
    double most = -1.0;
    for (const auto& [x, y] : kDirections) {
      change_.position = here + (u * x + v * y) * reach;
      const double poorest = ratiosAdded().poorest;
      if (poorest <= most) continue;
      most = poorest;
      best = change_.position;
    }
    moved = moveOnPatch(node, best, MovePurpose::kImprove) || moved;
  }
  return moved;
}

}  // namespace tetrafront
