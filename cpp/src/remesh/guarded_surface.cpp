#include "remesh/guarded_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geom/measure.h"
#include "geom/predicates.h"
#include "remesh/envelope.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Height / longest edge below which a triangle may only replace one that is as thin.
constexpr double kThin = 1e-6;
/// Height / tolerance below which a triangle is a narrow strip within the tolerance, and least cosine between it and the
/// reference: it must not fold back.
constexpr double kNarrow = 0.2;
constexpr double kNarrowCosine = 0.1;

/// Returns height / longest edge.
double thicknessOf(const std::array<Vec3, 3>& corners) {
  const double longest = longestEdgeLengthOf(corners);
  const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  return longest > 0.0 ? glm::length(normal) / (longest * longest) : 0.0;
}

/// Returns 1 or -1 for a triangle that is exactly in the plane across an axis and faces up or down along it; 0 if it is
/// not in the plane, or too thin for its direction to be certain.
double facingAlong(const std::array<Vec3, 3>& corners, int axis, double level) {
  const auto& [a, b, c] = corners;
  if (a[axis] != level || b[axis] != level || c[axis] != level) return 0.0;
  const Vec3 normal = glm::cross(b - a, c - a);
  const double longest = longestEdgeLengthOf(corners);
  if (!(std::fabs(normal[axis]) > kThin * longest * longest)) return 0.0;
  return normal[axis] > 0.0 ? 1.0 : -1.0;
}

}  // namespace

GuardedSurface::GuardedSurface(const ReferenceSurface& reference, const SurfaceLimits& limits,
                               double baseSize)
    : reference_(reference),
      limits_(limits),
      complex_(reference),
      grid_(complex_, baseSize, tetrafront::pointOf(reference.mesh(), NodeId(0U))) {
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    insert(t);
    beneath_[t.index()] = t;
    const PatchFacetId facet = reference.facetOf(t);
    // The normal of a sliver may be unknown.
    if (!facet.isNone() && reference.facet(facet).normal != Vec3(0.0)) over_[t.index()] = facet;
  }
  for (const auto& [position, triangle] : findGuests(reference, complex_, limits.tolerance)) {
    nextGuest_.push_back(firstGuest_[triangle.index()]);
    firstGuest_[triangle.index()] = GuestId(guests_.size());
    guests_.push_back(position);
  }
}

/// Adds a new triangle to the grid and the arrays.
void GuardedSurface::insert(TriangleId triangle) {
  if (triangle.index() >= beneath_.size()) {
    beneath_.resize(triangle.index() + 1);
    over_.resize(beneath_.size());
    firstGuest_.resize(beneath_.size());
  }
  grid_.insert(triangle);
}

void GuardedSurface::replaceStretch(NodeId a, NodeId b, const Stretch& stretch) {
  complex_.setStretchBetween(a, b, complex_.addStretch(stretch));
}

bool GuardedSurface::apply(const SurfaceChange& change, bool coversSame) {
  change_ = &change;
  grid_.setHidden(change.removed, true);
  const bool admitted = isAdmitted(coversSame);
  grid_.setHidden(change.removed, false);
  if (!admitted) return false;
  if (change.moved.isNone()) {
    replaceTriangles();
  } else {
    moveTriangles();
  }
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    beneath_[slots_[i].index()] = below_[i].triangle;
    over_[slots_[i].index()] = overNow_[i];
  }
  for (const auto& [guest, host] : hosts_) {
    const TriangleId t = slots_[host];
    nextGuest_[guest.index()] = firstGuest_[t.index()];
    firstGuest_[t.index()] = guest;
  }
  return true;
}

/// Makes the cheapest checks first.
bool GuardedSurface::isAdmitted(bool coversSame) {
  measureAdded();
  return isThickEnough() && facesAsReference() && keepsCreases() &&
         (coversSame || isInOnePlane() || isFreeOfCollisions()) && isInEnvelope() && findHosts();
}

bool GuardedSurface::isFreeOfCollisions() {
  uncovered_.clear();
  for (const NumberedTriangle& triangle : numbered_) {
    if (!isCovered(triangle)) uncovered_.push_back(triangle);
  }
  return !grid_.collide({change_->removed, numbered_, change_->moved}, uncovered_);
}

/// Returns true if an added triangle b c d lies in two removed ones, a b c and a c d, exactly in one plane across an axis. No other
/// triangle intersects those, so none intersects the added one: all triangles at their common edge are removed, because every
/// change removes all triangles of an edge or of a star, to which the edge belongs. In a fan of needles, this is cheaper than
/// a test of each needle. O(n) for n removed triangles.
bool GuardedSurface::isCovered(const NumberedTriangle& added) const {
  if (change_->removed.size() < 2 || !change_->moved.isNone()) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double level = added.corners[0][axis];
    const double facing = facingAlong(added.corners, axis, level);
    if (facing == 0.0) continue;
    std::array<TriangleId, 2> covering{};
    std::size_t count = 0;
    for (const TriangleId t : change_->removed) {
      if (facingAlong(complex_.cornersOf(t), axis, level) * facing <= 0.0) continue;
      if (count == covering.size()) return false;
      covering[count++] = t;
    }
    return count == covering.size() && areCovering(covering, added, axis, facing);
  }
  return false;
}

/// Returns true if two triangles a b c and a c d cover the triangle b c d, because a b d faces the same way. If a is on the edge
/// b d, all triangles at a must be removed: others would touch the edge.
bool GuardedSurface::areCovering(const std::array<TriangleId, 2>& covering,
                                 const NumberedTriangle& added, int axis, double facing) const {
  NodeId a{};
  std::array<std::size_t, 3> uses{};
  for (const TriangleId t : covering) {
    std::size_t others = 0;
    for (const NodeId node : complex_.nodesOf(t)) {
      const auto at = std::ranges::find(added.nodes, node.value);
      if (at != added.nodes.end()) {
        ++uses[static_cast<std::size_t>(at - added.nodes.begin())];
        continue;
      }
      if (++others > 1 || !(a.isNone() || a == node)) return false;
      a = node;
    }
  }
  const auto c = static_cast<std::size_t>(std::ranges::find(uses, 2U) - uses.begin());
  if (a.isNone() || c == 3 || uses[(c + 1) % 3] != 1 || uses[(c + 2) % 3] != 1) return false;
  const auto flat = [axis](const Vec3& p) { return Vec2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  const int orientation = orient2d(flat(complex_.pointOf(a)), flat(added.corners[(c + 2) % 3]),
                                   flat(added.corners[(c + 1) % 3]));
  return orientation == 0 ? isStarRemoved(a) : orientation * facing > 0.0;
}

/// Removed triangles are hidden from the grid while a change is checked.
bool GuardedSurface::isStarRemoved(NodeId node) const {
  bool isRemoved = true;
  complex_.visitStar(
      node, [&](TriangleId t, std::uint32_t /*k*/) { isRemoved = isRemoved && grid_.isHidden(t); });
  return isRemoved;
}

/// Returns true if all removed and added triangles are exactly in one plane across an axis and face the same way. Both
/// have the same boundary, so they cover the same part of the plane once.
bool GuardedSurface::isInOnePlane() const {
  const std::array<Vec3, 3>& first = numbered_[0].corners;
  for (int axis = 0; axis < 3; ++axis) {
    const double level = first[0][axis];
    const double facing = facingAlong(first, axis, level);
    if (facing == 0.0) continue;
    const auto isSame = [&](const std::array<Vec3, 3>& corners) {
      return facingAlong(corners, axis, level) * facing > 0.0;
    };
    return std::ranges::all_of(
               numbered_,
               [&](const NumberedTriangle& triangle) { return isSame(triangle.corners); }) &&
           std::ranges::all_of(change_->removed,
                               [&](TriangleId t) { return isSame(complex_.cornersOf(t)); });
  }
  return false;
}

void GuardedSurface::measureAdded() {
  numbered_.clear();
  for (const SurfaceChange::Added& added : change_->added) {
    const auto [a, b, c] = added.nodes;
    numbered_.push_back(numbered(added.nodes, {positionOf(a), positionOf(b), positionOf(c)}));
  }
}

/// A thin triangle may only replace one that is as thin.
bool GuardedSurface::isThickEnough() const {
  double least = kThin;
  for (const TriangleId t : change_->removed) {
    least = std::min(least, thicknessOf(complex_.cornersOf(t)));
  }
  return std::ranges::all_of(numbered_, [&](const NumberedTriangle& triangle) {
    return thicknessOf(triangle.corners) >= least;
  });
}

PatchFacetId GuardedSurface::facetUnder(std::span<const TriangleId> triangles) const {
  const PatchFacetId first = over_[triangles.front().index()];
  const bool isCommon =
      std::ranges::all_of(triangles, [&](TriangleId t) { return over_[t.index()] == first; });
  return isCommon ? first : PatchFacetId{};
}

/// Returns true if the added triangles replace others that lie over the facet, face as it does and are near it. They then
/// lie over it, too.
bool GuardedSurface::faceFacet(PatchFacetId id) {
  if (id.isNone()) return false;
  const Facet& facet = reference_.facet(id);
  const bool isNear = std::ranges::all_of(numbered_, [&](const NumberedTriangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    const Vec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    return area > 0.0 && glm::dot(normal, facet.normal) >= limits_.facingCosine * area &&
           isNearFacet(facet, triangle.corners, limits_.tolerance) && !collinear(a, b, c);
  });
  if (!isNear) return false;
  for (std::size_t i = 0; i < numbered_.size(); ++i) below_[i].triangle = hintFor(i);
  overNow_.assign(numbered_.size(), id);
  return true;
}

bool GuardedSurface::facesAsReference() {
  below_.assign(change_->added.size(), NearestPoint{});
  overNow_.assign(change_->added.size(), PatchFacetId{});
  if (faceFacet(facetUnder(change_->removed))) return true;
  for (std::size_t i = 0; i < change_->added.size(); ++i) {
    const auto& [a, b, c] = numbered_[i].corners;
    const Vec3 normal = glm::cross(b - a, c - a);
    const double area = glm::length(normal);
    if (!(area > 0.0) || collinear(a, b, c)) return false;
    const bool isNarrow =
        area < kNarrow * limits_.tolerance * longestEdgeLengthOf(numbered_[i].corners);
    const SmoothPatchId id = change_->added[i].patch;
    const SmoothPatch& patch = reference_.patch(id);
    Vec3 facing = patch.normal;
    below_[i].triangle = hintFor(i);
    if (!patch.isPlanar) {
      below_[i] = reference_.nearest((a + b + c) / 3.0, id, limits_.tolerance, below_[i].triangle);
      if (below_[i].triangle.isNone()) return false;
      facing = reference_.normalOf(below_[i].triangle);
    }
    const double leastCosine = isNarrow ? kNarrowCosine : limits_.facingCosine;
    if (glm::dot(normal, facing) < leastCosine * area) return false;
  }
  return true;
}

/// Feature lines stay sharp: limits of the distance alone would allow a crease to become flat in places.
bool GuardedSurface::keepsCreases() {
  for (const SurfaceChange::Added& added : change_->added) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeId a = added.nodes[k];
      const NodeId b = added.nodes[(k + 1) % 3];
      if (complex_.kindOf(a) == NodeKind::kSmooth || complex_.kindOf(b) == NodeKind::kSmooth)
        continue;
      const FeatureLineId line = lineOf(a, b);
      if (!line.isNone() && !keepsCrease(a, b, line)) return false;
    }
  }
  return true;
}

/// Returns the feature line of an edge after the change, or none.
FeatureLineId GuardedSurface::lineOf(NodeId a, NodeId b) const {
  for (const SurfaceChange::LineEdge& edge : change_->newLineEdges) {
    if ((edge.a == a && edge.b == b) || (edge.a == b && edge.b == a)) return edge.line;
  }
  const StretchId stretch = complex_.stretchBetween(a, b);
  return stretch.isNone() ? FeatureLineId{} : complex_.stretch(stretch).line;
}

/// Returns false if the crease at the edge would have less than half the smallest angle of its line, and less than now.
bool GuardedSurface::keepsCrease(NodeId a, NodeId b, FeatureLineId line) {
  const double creaseCosine = reference_.line(line).creaseCosine;
  if (creaseCosine > reference_.rules().creaseCosine) return true;
  const double squaredHalfCosine = 0.5 * (1.0 + creaseCosine);
  const auto normalOf = [](const std::array<Vec3, 3>& corners) {
    return glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  };
  creaseNow_.clear();
  creaseThen_.clear();
  complex_.collectEdge(a, b, edge_);
  for (const HalfEdgeId halfEdge : edge_) {
    const TriangleId t = triangleOf(halfEdge);
    creaseNow_.push_back(normalOf(complex_.cornersOf(t)));
    if (!grid_.isHidden(t)) creaseThen_.push_back(creaseNow_.back());
  }
  for (const NumberedTriangle& triangle : numbered_) {
    const bool hasA = std::ranges::find(triangle.nodes, a.value) != triangle.nodes.end();
    const bool hasB = std::ranges::find(triangle.nodes, b.value) != triangle.nodes.end();
    if (hasA && hasB) creaseThen_.push_back(normalOf(triangle.corners));
  }
  if (creaseThen_.size() != 2) return true;
  const auto cosineOf = [](const std::vector<Vec3>& normals) {
    return glm::dot(normals[0], normals[1]) / (glm::length(normals[0]) * glm::length(normals[1]));
  };
  const double cosine = cosineOf(creaseThen_);
  if (cosine <= 0.0 || cosine * cosine <= squaredHalfCosine) return true;
  return creaseNow_.size() == 2 && cosine <= cosineOf(creaseNow_);
}

/// Returns a given triangle near an added one, in the same patch; none if no removed triangle is in
/// this patch.
TriangleId GuardedSurface::hintFor(std::size_t added) const {
  const std::vector<TriangleId>& removed = change_->removed;
  for (const TriangleId t :
       {removed[std::min(added, removed.size() - 1)], removed.front(), removed.back()}) {
    if (complex_.patchOf(t) == change_->added[added].patch) return beneath(t);
  }
  // More than two patches meet at an edge with an interface.
  for (const TriangleId t : removed) {
    if (complex_.patchOf(t) == change_->added[added].patch) return beneath(t);
  }
  return {};
}

bool GuardedSurface::isInEnvelope() {
  for (std::size_t i = 0; i < numbered_.size(); ++i) {
    const SmoothPatchId patch = change_->added[i].patch;
    if (reference_.patch(patch).isPlanar || !overNow_[i].isNone()) continue;
    const EnvelopeProof proof =
        proveWithin(reference_, numbered_[i].corners, patch, limits_.tolerance, below_[i]);
    if (!proof.isProven) return false;
    overNow_[i] = proof.over;
  }
  return true;
}

/// Finds an added triangle within the tolerance of every guest of a removed triangle.
bool GuardedSurface::findHosts() {
  hosts_.clear();
  const bool areThereGuests = std::ranges::any_of(
      change_->removed, [&](TriangleId t) { return !firstGuest_[t.index()].isNone(); });
  if (!areThereGuests) return true;
  around_.clear();
  for (const NumberedTriangle& added : numbered_) {
    const auto& [a, b, c] = added.corners;
    around_.push_back(Box::of(a, b, c));
  }
  const double limit = limits_.tolerance * limits_.tolerance;
  for (const TriangleId t : change_->removed) {
    for (GuestId guest = firstGuest_[t.index()]; !guest.isNone();
         guest = nextGuest_[guest.index()]) {
      const Vec3& point = guests_[guest.index()];
      std::size_t host = numbered_.size();
      double nearest = limit;
      for (std::size_t i = 0; i < numbered_.size(); ++i) {
        if (change_->added[i].patch != complex_.patchOf(t)) continue;
        if (around_[i].squaredDistance(point) > nearest) continue;
        const auto& [a, b, c] = numbered_[i].corners;
        const double square = squaredDistanceToTriangle(point, a, b, c);
        if (square > nearest) continue;
        nearest = square;
        host = i;
      }
      if (host == numbered_.size()) return false;
      hosts_.emplace_back(guest, host);
    }
  }
  return true;
}

/// The triangles of a node that moves keep their slots.
void GuardedSurface::moveTriangles() {
  complex_.moveNode(change_->moved, change_->position);
  slots_ = change_->removed;
  for (const TriangleId t : slots_) {
    grid_.update(t);
    firstGuest_[t.index()] = GuestId{};
  }
}

void GuardedSurface::replaceTriangles() {
  carried_.clear();
  for (const SurfaceChange::Added& added : change_->added) {
    for (std::size_t k = 0; k < 3; ++k) {
      carried_.push_back(complex_.stretchBetween(added.nodes[k], added.nodes[(k + 1) % 3]));
    }
  }
  for (const TriangleId t : change_->removed) {
    grid_.remove(t);
    complex_.removeTriangle(t);
    firstGuest_[t.index()] = GuestId{};
  }
  slots_.clear();
  for (std::size_t i = 0; i < change_->added.size(); ++i) {
    const TriangleId t = complex_.addTriangle(change_->added[i].nodes, change_->added[i].patch);
    for (std::uint32_t k = 0; k < 3; ++k) {
      complex_.setStretch(halfEdgeOf(t, k), carried_[3 * i + k]);
    }
    insert(t);
    slots_.push_back(t);
  }
}

}  // namespace tetrafront
