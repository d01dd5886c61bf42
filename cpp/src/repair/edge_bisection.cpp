#include "repair/edge_bisection.h"

#include <algorithm>
#include <bit>

#include "sizing/target_sizes.h"
#include "topology/surface_access.h"

namespace tetrafront {

EdgeBisection::EdgeBisection(TrackedSurface& surface, const SizeField& field,
                             const RegionSizes& regions, FieldHint& hint)
    : mesh_(surface.mesh), origin_(surface.origin), field_(field), regions_(regions), hint_(hint) {
  const EdgeTable edges(mesh_.triangles, countNodes(mesh_), {});
  edgeOf_.resize(mesh_.triangles.size());
  nextOnEdge_.resize(mesh_.triangles.size());
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, halfEdges.front());
    std::uint32_t region = FieldHint::kAnyRegion;
    for (const HalfEdgeId h : halfEdges) {
      region = field.tighterOf(region, regions.regionOf(triangleOf(h).index()));
    }
    const EdgeId edge = addEdge(nodes.from, nodes.to, region);
    for (const HalfEdgeId h : halfEdges) link(edge, h);
  }
}

void EdgeBisection::measureEdges(std::size_t first, std::size_t last) {
  for (std::size_t e = first; e < last; ++e) measureEdge(EdgeId(e));
}

void EdgeBisection::measureTriangles(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) measureTriangle(TriangleId(t));
}

bool EdgeBisection::advance(std::uint32_t budget, double maxTriangles) {
  for (std::uint32_t i = 0; i < budget; ++i) {
    if (isFinished() || countTriangles(mesh_) > maxTriangles) return true;
    const EdgeId edge(waiting_.pop());
    const double need = needOf(edge);
    if (!(need > kMaxEdgeLength)) continue;
    const EdgeId longest = longestAround(edge);
    waiting_.remove(longest.value);
    bisect(longest);
    if (longest != edge) request(edge, need);
  }
  return false;
}

void EdgeBisection::measureEdge(EdgeId edge) {
  Edge& measured = edges_[edge.index()];
  const Vec3 a = pointOf(mesh_, measured.from);
  const Vec3 b = pointOf(mesh_, measured.to);
  hint_.region = measured.region;
  measured.length = metricLength(field_, a, b, hint_);
  measured.span = field_.isStretched() ? measured.length : glm::length(b - a);
  request(edge, measured.length);
}

void EdgeBisection::measureTriangle(TriangleId triangle) {
  const EdgeId longest = longestOf(triangle);
  request(longest, lengthInside(triangle, longest));
}

bool EdgeBisection::isLonger(EdgeId edge, EdgeId other) const {
  const double span = edges_[edge.index()].span;
  const double otherSpan = edges_[other.index()].span;
  return span != otherSpan ? span > otherSpan : edge < other;
}

EdgeId EdgeBisection::longestOf(TriangleId triangle) const {
  const EdgeId* edges = &edgeOf_[halfEdgeOf(triangle, 0).index()];
  EdgeId longest = edges[0];
  if (isLonger(edges[1], longest)) longest = edges[1];
  if (isLonger(edges[2], longest)) longest = edges[2];
  return longest;
}

/// Steps from triangle to triangle over ever longer edges, and returns the one that is the longest of all its
/// triangles.
EdgeId EdgeBisection::longestAround(EdgeId edge) const {
  for (EdgeId before; before != edge;) {
    before = edge;
    for (HalfEdgeId h = edges_[before.index()].first; !h.isNone(); h = nextOnEdge_[h.index()]) {
      const EdgeId longest = longestOf(triangleOf(h));
      if (isLonger(longest, edge)) edge = longest;
    }
  }
  return edge;
}

/// Returns the length of the edge in target lengths at the centroid of the triangle.
double EdgeBisection::lengthInside(TriangleId triangle, EdgeId edge) {
  const Edge& measured = edges_[edge.index()];
  hint_.region = regions_.regionOf(origin_[triangle.index()].index());
  const Vec3 along = pointOf(mesh_, measured.to) - pointOf(mesh_, measured.from);
  return metricLengthAt(field_, centroidOf(cornersOf(mesh_, triangle)), along, hint_);
}

/// Returns the largest length of the edge, along itself and inside the triangles of which it is the longest edge.
double EdgeBisection::needOf(EdgeId edge) {
  double need = edges_[edge.index()].length;
  if (!(need > 0.0)) return need;
  for (HalfEdgeId h = edges_[edge.index()].first; !h.isNone(); h = nextOnEdge_[h.index()]) {
    if (longestOf(triangleOf(h)) == edge) need = std::max(need, lengthInside(triangleOf(h), edge));
  }
  return need;
}

void EdgeBisection::request(EdgeId edge, double length) {
  longest_ = std::max(longest_, length);
  Edge& requested = edges_[edge.index()];
  if (!(length > kMaxEdgeLength) || !(requested.length > 0.0)) return;
  if (waiting_.contains(edge.value)) {
    if (!(length > requested.need)) return;
    waiting_.remove(edge.value);
  }
  requested.need = length;
  // Positive doubles have the same order as their bits.
  waiting_.push(edge.value, ~std::bit_cast<std::uint64_t>(length));
}

EdgeId EdgeBisection::addEdge(NodeId from, NodeId to, std::uint32_t region) {
  const EdgeId edge(edges_.size());
  edges_.push_back({.from = from, .to = to, .region = region});
  waiting_.reserveIds(edges_.size());
  return edge;
}

void EdgeBisection::link(EdgeId edge, HalfEdgeId halfEdge) {
  HalfEdgeId& first = edges_[edge.index()].first;
  edgeOf_[halfEdge.index()] = edge;
  nextOnEdge_[halfEdge.index()] = first;
  first = halfEdge;
}

/// Replaces a half-edge in the list of its edge.
void EdgeBisection::relink(EdgeId edge, HalfEdgeId halfEdge, HalfEdgeId replacement) {
  HalfEdgeId* entry = &edges_[edge.index()].first;
  while (*entry != halfEdge) entry = &nextOnEdge_[entry->index()];
  *entry = replacement;
  nextOnEdge_[replacement.index()] = nextOnEdge_[halfEdge.index()];
  edgeOf_[replacement.index()] = edge;
}

/// Bisects the edge and all its triangles.
void EdgeBisection::bisect(EdgeId edge) {
  const auto [a, b] = std::pair(edges_[edge.index()].from, edges_[edge.index()].to);
  const Vec3 from = pointOf(mesh_, a);
  const Vec3 to = pointOf(mesh_, b);
  const Vec3 middle = 0.5 * from + 0.5 * to;
  if (middle == from || middle == to) {
    edges_[edge.index()].length = 0.0;
    edges_[edge.index()].span = 0.0;
    return;
  }
  const NodeId m(countNodes(mesh_));
  mesh_.points.insert(mesh_.points.end(), {middle.x, middle.y, middle.z});
  ++bisectedEdges_;
  around_.clear();
  for (HalfEdgeId h = edges_[edge.index()].first; !h.isNone(); h = nextOnEdge_[h.index()]) {
    around_.push_back(h);
  }
  const EdgeId second = addEdge(m, b, edges_[edge.index()].region);
  edges_[edge.index()].to = m;
  edges_[edge.index()].first = {};
  measureEdge(edge);
  measureEdge(second);
  const std::uint32_t firstAdded = countTriangles(mesh_);
  for (const HalfEdgeId h : around_) bisectTriangle(h, edge, second);
  for (const HalfEdgeId h : around_) measureTriangle(triangleOf(h));
  measureTriangles(firstAdded, countTriangles(mesh_));
}

/// Bisects the triangle of a half-edge whose edge is already bisected:
///
///          apex
///         /  |  \        The triangle keeps the half at the tail of the half-edge. A new triangle takes the
///        /   |   \       other half; its corners are in the same order.
///    tail -- m -- head
void EdgeBisection::bisectTriangle(HalfEdgeId halfEdge, EdgeId firstHalf, EdgeId secondHalf) {
  const TriangleId added(countTriangles(mesh_));
  const NodeId m = edges_[firstHalf.index()].to;
  const auto [tail, head, apex] = nodesOf(mesh_.triangles, halfEdge);
  const HalfEdgeId after = nextOf(halfEdge);
  const HalfEdgeId addedHalfEdge = halfEdgeOf(added, halfEdge.value % 3);
  const HalfEdgeId addedAfter = nextOf(addedHalfEdge);
  const HalfEdgeId addedLast = nextOf(addedAfter);
  origin_.push_back(origin_[triangleOf(halfEdge).index()]);
  mesh_.triangles.resize(mesh_.triangles.size() + 3);
  edgeOf_.resize(mesh_.triangles.size());
  nextOnEdge_.resize(mesh_.triangles.size());
  mesh_.triangles[after.index()] = m.value;
  mesh_.triangles[addedHalfEdge.index()] = m.value;
  mesh_.triangles[addedAfter.index()] = head.value;
  mesh_.triangles[addedLast.index()] = apex.value;
  relink(edgeOf_[after.index()], after, addedAfter);
  const bool isAlong = tail == edges_[firstHalf.index()].from;
  link(isAlong ? firstHalf : secondHalf, halfEdge);
  link(isAlong ? secondHalf : firstHalf, addedHalfEdge);
  const EdgeId across = addEdge(m, apex, regions_.regionOf(origin_[added.index()].index()));
  link(across, after);
  link(across, addedLast);
  measureEdge(across);
}

}  // namespace tetrafront
