#include "remesh/surface_editor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "field/size_field.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "quality/metrics.h"
#include "remesh/triangle_parts.h"

namespace tetrafront {
namespace {

/// Length of a move / target size below which the target size of the node is kept.
constexpr double kNearMove = 0.05;
/// Height / tolerance up to which the apex of a cap may be absorbed by the feature line beneath it.
constexpr double kAbsorbedHeight = 0.05;
/// Length / tolerance of an edge whose nodes nearly coincide, and length / target length of one that is far too short: a collapse
/// hardly changes the lengths of other edges. Long needles are thus collapsed, before splits would multiply them.
constexpr double kTinyEdge = 1e-3;
constexpr double kFarTooShort = 0.03;
/// Smallest relative gain of a squared sine that justifies a flip; with any gain, rounding could flip an edge for ever.
constexpr double kMinFlipGain = 1e-3;
/// Squared sine of an angle below which the gain of a flip is rounding.
constexpr double kMinSquaredSine = 1e-12;
/// Squared sine of half a degree. A cap with a smaller angle could stay for ever.
constexpr double kMinCapSquaredSine = 7.6e-5;
/// Cosine of an angle opposite an edge, 75 degrees. In a plane, a flip raises the smallest angle only if the two angles
/// opposite the edge exceed 180 degrees together; the margin is for bends.
constexpr double kNarrowApex = 0.26;
/// Smallest cosine between the normals of the two triangles of a flip: across a bend, the other
/// diagonal would change the shape.
constexpr double kFlipCosine = 0.5;

/// Returns the triangle with node `old` replaced by `now`.
NodeTriple replaced(NodeTriple nodes, NodeId old, NodeId now) {
  for (NodeId& node : nodes) {
    if (node == old) node = now;
  }
  return nodes;
}

}  // namespace

SurfaceEditor::SurfaceEditor(GuardedSurface& surface, const RemeshSizes& sizes,
                             std::span<const std::uint8_t> isSettled, bool keepsSettled)
    : surface_(surface),
      complex_(surface.complex()),
      reference_(surface.reference()),
      sizes_(sizes),
      isStretched_(sizes.isStretched()),
      size_(complex_.nodeCount()),
      sizeHint_(complex_.nodeCount()),
      view_(isStretched_ ? complex_.nodeCount() : 0),
      changed_(complex_.nodeCount(), kFirstTime),
      keepsSettled_(keepsSettled) {
  for (std::size_t i = 0; i < isSettled.size(); ++i) {
    if (isSettled[i] != 0) changed_[i] = kFirstTime - 1;
  }
  std::vector<std::uint32_t> regions(complex_.nodeCount(), FieldHint::kAnyRegion);
  if (sizes.hasRegions()) {
    for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
      for (const NodeId node : complex_.nodesOf(t)) {
        std::uint32_t& region = regions[node.index()];
        region = sizes.tighterOf(region, sizes.regionOf(complex_.patchOf(t)));
      }
    }
  }
  RemeshSizes::Hint hint;
  for (const NodeId node : IdRange<NodeId>(complex_.nodeCount())) {
    hint.field.region = regions[node.index()];
    sizeHint_[node.index()] = hint;
    measureSize(node);
    hint = sizeHint_[node.index()];
  }
}

/// `near`: a node not far from the new one. `region`: as regionAround().
NodeId SurfaceEditor::addNode(const Vec3& point, NodeKind kind, NodeId near, std::uint32_t region) {
  const NodeId node = surface_.addNode(point, kind);
  size_.emplace_back();
  sizeHint_.push_back(sizeHint_[near.index()]);
  sizeHint_.back().field.region = region;
  if (isStretched_) view_.emplace_back();
  changed_.push_back(time_);
  measureSize(node);
  return node;
}

void SurfaceEditor::removeLastNode() {
  surface_.removeLastNode();
  size_.pop_back();
  sizeHint_.pop_back();
  if (isStretched_) view_.pop_back();
  changed_.pop_back();
}

void SurfaceEditor::measureSize(NodeId node) {
  const Vec3& point = complex_.pointOf(node);
  RemeshSizes::Hint& hint = sizeHint_[node.index()];
  if (!isStretched_) {
    size_[node.index()] = sizes_.sizeAt(point, hint);
    return;
  }
  const SymmetricTensor tensor = sizes_.tensorAt(point, hint);
  size_[node.index()] = meanSizeOf(tensor);
  view_[node.index()] = tensor.inverse();
}

/// Measures the size of a node that has moved less than about an edge.
void SurfaceEditor::updateSize(NodeId node) {
  if (isStretched_) {
    measureSize(node);
    return;
  }
  size_[node.index()] = sizes_.sizeNear(complex_.pointOf(node), sizeHint_[node.index()]);
}

/// Returns the region whose size applies to a node on an edge: the one with the smallest cap among those of the patches.
std::uint32_t SurfaceEditor::regionAround(std::span<const HalfEdgeId> edge) const {
  std::uint32_t region = FieldHint::kAnyRegion;
  for (const HalfEdgeId halfEdge : edge) {
    const SmoothPatchId patch = complex_.patchOf(triangleOf(halfEdge));
    region = sizes_.tighterOf(region, sizes_.regionOf(patch));
  }
  return region;
}

/// Measures the size of a node that now is on a line of this region.
void SurfaceEditor::enterRegion(NodeId node, std::uint32_t region) {
  if (!sizes_.hasRegions()) return;
  sizeHint_[node.index()].field.region = region;
  measureSize(node);
}

/// Returns true if a node moves so far that its target size must be queried again.
bool SurfaceEditor::isFarMove() const {
  if (change_.moved.isNone()) return false;
  const double reach = kNearMove * sizeOf(change_.moved);
  const Vec3 step = change_.position - complex_.pointOf(change_.moved);
  return glm::dot(step, step) > reach * reach;
}

bool SurfaceEditor::apply(bool coversSame) {
  const bool isFar = isFarMove();
  if (!surface_.apply(change_, coversSame)) return false;
  if (isFar) updateSize(change_.moved);
  for (const SurfaceChange::Added& added : change_.added) {
    for (const NodeId node : added.nodes) {
      if (!isKept(node)) changed_[node.index()] = time_;
    }
  }
  return true;
}

// ---- measures -----------------------------------------------------------------------------------

double SurfaceEditor::lengthOf(NodeId a, NodeId b) const {
  const Vec3 edge = complex_.pointOf(b) - complex_.pointOf(a);
  if (!isStretched_) return 2.0 * glm::length(edge) / (sizeOf(a) + sizeOf(b));
  return 0.5 * glm::length(view_[a.index()] * edge + view_[b.index()] * edge);
}

SurfaceEditor::Corners SurfaceEditor::inMetric(const NodeTriple& nodes, Corners corners) const {
  if (!isStretched_) return corners;
  const auto map = [&](const Vec3& v) {
    return view_[nodes[0].index()] * v + view_[nodes[1].index()] * v + view_[nodes[2].index()] * v;
  };
  return {Vec3(0.0), map(corners[1] - corners[0]), map(corners[2] - corners[0])};
}

double SurfaceEditor::squaredSineOf(const NodeTriple& nodes) const {
  const auto [a, b, c] = inMetric(nodes, cornersOf(nodes));
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double x = glm::dot(ab, ab);
  const double y = glm::dot(bc, bc);
  const double z = glm::dot(ca, ca);
  const Vec3 normal = glm::cross(ab, ca);
  // The smallest angle is between the two longer edges.
  const double longer = std::max({x * y, y * z, z * x});
  return longer > 0.0 ? glm::dot(normal, normal) / longer : 0.0;
}

double SurfaceEditor::radiusRatioOf(const NodeTriple& nodes) const {
  const auto [a, b, c] = inMetric(nodes, cornersOf(nodes));
  return triangleRadiusRatio(a, b, c);
}

double SurfaceEditor::poorestRemoved() const {
  double poorest = 1.0;
  for (const TriangleId t : change_.removed) {
    const NodeTriple& nodes = complex_.nodesOf(t);
    const auto [a, b, c] = inMetric(nodes, complex_.cornersOf(t));
    poorest = std::min(poorest, triangleRadiusRatio(a, b, c));
  }
  return poorest;
}

/// Returns the squared sine of the smallest angle of the removed triangles.
double SurfaceEditor::smallestRemoved() const {
  double smallest = 1.0;
  for (const TriangleId t : change_.removed) {
    smallest = std::min(smallest, squaredSineOf(complex_.nodesOf(t)));
  }
  return smallest;
}

double SurfaceEditor::smallestAdded() const {
  double smallest = 1.0;
  for (const SurfaceChange::Added& added : change_.added) {
    smallest = std::min(smallest, squaredSineOf(added.nodes));
  }
  return smallest;
}

SurfaceEditor::Ratios SurfaceEditor::ratiosAdded() const {
  Ratios ratios;
  double sum = 0.0;
  for (const SurfaceChange::Added& added : change_.added) {
    const double ratio = radiusRatioOf(added.nodes);
    ratios.poorest = std::min(ratios.poorest, ratio);
    sum += ratio;
  }
  ratios.mean = sum / static_cast<double>(change_.added.size());
  return ratios;
}

bool SurfaceEditor::follows(FeatureLineId line, double begin, double end, const Vec3& a,
                            const Vec3& b) const {
  const double limit = surface_.tolerance() * surface_.tolerance();
  return reference_.line(line).squaredDeviation(begin, end, a, b) <= limit;
}

// ---- split --------------------------------------------------------------------------------------

bool SurfaceEditor::split(NodeId a, NodeId b, double part) {
  complex_.collectEdge(a, b, edge_);
  if (edge_.empty()) return false;
  const Vec3 straight = reference_.representable(
      complex_.pointOf(a) + (complex_.pointOf(b) - complex_.pointOf(a)) * part);
  const StretchId id = complex_.stretchOf(edge_[0]);
  if (!id.isNone()) {
    const Stretch& stretch = complex_.stretch(id);
    const double along = stretch.from == a ? part : 1.0 - part;
    const double arc = stretch.begin + (stretch.end - stretch.begin) * along;
    const Vec3 onLine = reference_.representable(reference_.line(stretch.line).at(arc));
    return trySplit(a, b, onLine, id, arc) ||
           (onLine != straight && trySplit(a, b, straight, id, arc));
  }
  const Vec3 onPatch = splitPosition(straight, triangleOf(edge_[0]));
  return trySplit(a, b, onPatch, id, 0.0) ||
         (onPatch != straight && trySplit(a, b, straight, id, 0.0));
}

/// Returns the nearest point of the patch, or the position itself if the patch is planar or no
/// point is near enough.
Vec3 SurfaceEditor::splitPosition(const Vec3& straight, TriangleId triangle) const {
  const SmoothPatchId patch = complex_.patchOf(triangle);
  if (reference_.patch(patch).isPlanar) return straight;
  if (const PatchFacetId id = surface_.facetUnder({&triangle, 1}); !id.isNone())
    return reference_.representable(reference_.facet(id).projected(straight));
  const NearestPoint nearest =
      reference_.nearest(straight, patch, 2.0 * surface_.tolerance(), surface_.beneath(triangle));
  return nearest.triangle.isNone() ? straight : reference_.representable(nearest.position);
}

/// Divides a stretch at an arc, where the line has this position; returns nothing if a part would leave the tolerance.
std::optional<SurfaceEditor::StretchParts> SurfaceEditor::partsOf(StretchId id, NodeId a, NodeId b,
                                                                  const Vec3& position,
                                                                  double arc) const {
  StretchParts parts{complex_.stretch(id), complex_.stretch(id), NodeId{}};
  parts.to = parts.before.from == a ? b : a;
  parts.before.end = parts.after.begin = arc;
  const bool isNear =
      follows(parts.before.line, parts.before.begin, arc, complex_.pointOf(parts.before.from),
              position) &&
      follows(parts.after.line, arc, parts.after.end, position, complex_.pointOf(parts.to));
  return isNear ? std::optional(parts) : std::nullopt;
}

/// Replaces a stretch by its parts, which meet at a node.
void SurfaceEditor::divideStretch(StretchId id, StretchParts parts, NodeId middle) {
  parts.after.from = middle;
  surface_.releaseStretch(id);
  surface_.replaceStretch(parts.before.from, middle, parts.before);
  surface_.replaceStretch(middle, parts.to, parts.after);
}

bool SurfaceEditor::trySplit(NodeId a, NodeId b, const Vec3& position, StretchId id, double arc) {
  std::optional<StretchParts> parts;
  if (!id.isNone()) {
    parts = partsOf(id, a, b, position, arc);
    if (!parts) return false;
  }
  const NodeKind kind = id.isNone() ? NodeKind::kSmooth : NodeKind::kLine;
  const NodeId middle = addNode(position, kind, a, regionAround(edge_));
  change_.clear();
  for (const HalfEdgeId halfEdge : edge_) {
    const TriangleId t = triangleOf(halfEdge);
    const HalfEdgeNodes nodes = complex_.nodesOf(halfEdge);
    const SmoothPatchId patch = complex_.patchOf(t);
    change_.removed.push_back(t);
    change_.added.push_back({{nodes.from, middle, nodes.apex}, patch});
    change_.added.push_back({{middle, nodes.to, nodes.apex}, patch});
  }
  if (parts) addLineEdges(*parts, middle);
  if (!apply()) {
    removeLastNode();
    return false;
  }
  if (parts) divideStretch(id, *parts, middle);
  return true;
}

void SurfaceEditor::addLineEdges(const StretchParts& parts, NodeId middle) {
  change_.newLineEdges.push_back({parts.before.from, middle, parts.before.line});
  change_.newLineEdges.push_back({middle, parts.to, parts.before.line});
}

bool SurfaceEditor::absorb(NodeId a, NodeId b) {
  complex_.collectEdge(a, b, edge_);
  if (edge_.size() != 2 || complex_.stretchOf(edge_[0]).isNone()) return false;
  return tryAbsorb(edge_[0], edge_[1]) || tryAbsorb(edge_[1], edge_[0]);
}

/// Gives the line to the apex of `cap`. `other`: the half-edge on the other side of the line.
bool SurfaceEditor::tryAbsorb(HalfEdgeId cap, HalfEdgeId other) {
  const auto [from, to, apex] = complex_.nodesOf(cap);
  const NodeId opposite = complex_.nodesOf(other).apex;
  if (complex_.kindOf(apex) != NodeKind::kSmooth || complex_.areJoined(apex, opposite))
    return false;
  const Vec3& position = complex_.pointOf(apex);
  const Vec3 edge = complex_.pointOf(to) - complex_.pointOf(from);
  const double part = glm::dot(position - complex_.pointOf(from), edge) / glm::dot(edge, edge);
  const double height = glm::length(position - complex_.pointOf(from) - edge * part);
  if (!(part > 0.0 && part < 1.0) || height > kAbsorbedHeight * surface_.tolerance()) return false;
  const StretchId id = complex_.stretchOf(cap);
  const Stretch& stretch = complex_.stretch(id);
  const double along = stretch.from == from ? part : 1.0 - part;
  const double arc = stretch.begin + (stretch.end - stretch.begin) * along;
  const std::optional<StretchParts> parts = partsOf(id, from, to, position, arc);
  if (!parts) return false;
  const SmoothPatchId patch = complex_.patchOf(triangleOf(other));
  change_.clear();
  change_.removed = {triangleOf(cap), triangleOf(other)};
  change_.added = {{{to, apex, opposite}, patch}, {{apex, from, opposite}, patch}};
  const std::uint32_t region = regionAround(std::array{cap, other});
  addLineEdges(*parts, apex);
  if (!apply()) return false;
  surface_.putOnLine(apex);
  enterRegion(apex, region);
  divideStretch(id, *parts, apex);
  return true;
}

// ---- collapse -----------------------------------------------------------------------------------

/// Returns true if `a` and `b` have no common neighbours other than the apexes of the triangles at
/// their edge.
bool SurfaceEditor::keepsTopology(NodeId a, NodeId b) {
  complex_.collectRing(a, ringA_);
  complex_.collectRing(b, ringB_);
  return collapseKeepsTopology(edge_, ringA_, ringB_);
}

/// Compares the triangles of the change. In a cusp, a needle may become a cap with no smaller angles: the next collapse
/// removes it.
bool SurfaceEditor::allowsShapes(const CollapseRule& rule) const {
  const double before = poorestRemoved();
  const double after = ratiosAdded().poorest;
  if (rule.mustImprove) return after > before;
  if (after >= std::min(rule.poorest, before)) return true;
  const double smallest = smallestAdded();
  return smallest >= smallestRemoved() && smallest > kMinCapSquaredSine;
}

bool SurfaceEditor::collapse(NodeId a, NodeId b, const CollapseRule& rule) {
  if (complex_.kindOf(a) == NodeKind::kCorner) return false;
  complex_.collectEdge(a, b, edge_);
  if (edge_.empty()) return false;
  const StretchId nearId = complex_.stretchOf(edge_[0]);
  const bool isLine = complex_.kindOf(a) == NodeKind::kLine;
  if (isLine && nearId.isNone()) return false;
  if (!keepsTopology(a, b)) return false;

  SurfaceComplex::LineNeighbours line;
  Stretch joint;
  NodeId other{};
  if (isLine) {
    line = complex_.lineNeighbours(a);
    if (!line.areComplete()) return false;
    other = line.before == b ? line.after : line.before;
    const Stretch& first = complex_.stretch(line.first);
    const Stretch& second = complex_.stretch(line.second);
    joint = first;
    joint.end = first.end + (second.end - second.begin);
    if (!follows(joint.line, joint.begin, joint.end, complex_.pointOf(line.before),
                 complex_.pointOf(line.after)))
      return false;
  }

  const auto isApex = [&](NodeId node) {
    return std::ranges::any_of(edge_,
                               [&](HalfEdgeId e) { return complex_.nodesOf(e).apex == node; });
  };
  // The collapse would merge two feature edges, and one of two lines would be lost.
  if (isLine && isApex(other)) return false;
  const bool isTiny =
      glm::length(complex_.pointOf(b) - complex_.pointOf(a)) <= kTinyEdge * surface_.tolerance() ||
      lengthOf(a, b) <= kFarTooShort;
  for (const NodeId node : ringA_) {
    if (!isTiny && node != b && !isApex(node) && lengthOf(node, b) > rule.longest) return false;
  }
  change_.clear();
  complex_.collectStar(a, change_.removed);
  for (const TriangleId t : change_.removed) {
    const NodeTriple& nodes = complex_.nodesOf(t);
    if (std::ranges::find(nodes, b) != nodes.end()) continue;
    change_.added.push_back({replaced(nodes, a, b), complex_.patchOf(t)});
  }
  if (change_.added.empty()) return false;
  if (!allowsShapes(rule)) return false;
  if (isLine) change_.newLineEdges.push_back({other, b, joint.line});
  if (!apply()) return false;
  if (isLine) {
    surface_.releaseStretch(line.first);
    surface_.releaseStretch(line.second);
    surface_.replaceStretch(other, b, joint);
  }
  return true;
}

// ---- flip ---------------------------------------------------------------------------------------

bool SurfaceEditor::mayFlip(HalfEdgeId halfEdge) const {
  const auto [a, b, apex] = complex_.nodesOf(halfEdge);
  const auto [from, to, top] = inMetric({a, b, apex}, cornersOf({a, b, apex}));
  const Vec3 u = from - top;
  const Vec3 v = to - top;
  const double dot = glm::dot(u, v);
  return dot <= 0.0 || dot * dot <= kNarrowApex * kNarrowApex * glm::dot(u, u) * glm::dot(v, v);
}

bool SurfaceEditor::flip(NodeId a, NodeId b) {
  complex_.collectEdge(a, b, edge_);
  if (edge_.size() != 2 || !complex_.stretchOf(edge_[0]).isNone()) return false;
  const TriangleId t = triangleOf(edge_[0]);
  const TriangleId u = triangleOf(edge_[1]);
  const auto [from, to, c] = complex_.nodesOf(edge_[0]);
  const NodeId d = complex_.nodesOf(edge_[1]).apex;
  const SmoothPatchId patch = complex_.patchOf(t);
  change_.clear();
  change_.removed = {t, u};
  change_.added = {{{from, d, c}, patch}, {{d, to, c}, patch}};
  const double before =
      std::min(squaredSineOf(complex_.nodesOf(t)), squaredSineOf(complex_.nodesOf(u)));
  const double after =
      std::min(squaredSineOf(change_.added[0].nodes), squaredSineOf(change_.added[1].nodes));
  if (after <= before * (1.0 + kMinFlipGain) + kMinSquaredSine) return false;
  if (c == d || complex_.areJoined(c, d)) return false;
  const Vec3 first = crossOf(cornersOf(change_.added[0].nodes));
  const Vec3 second = crossOf(cornersOf(change_.added[1].nodes));
  if (glm::dot(first, second) < kFlipCosine * glm::length(first) * glm::length(second))
    return false;
  const bool isFlat = orient3d(complex_.pointOf(from), complex_.pointOf(to), complex_.pointOf(c),
                               complex_.pointOf(d)) == 0;
  return apply(isFlat);
}

}  // namespace tetrafront
