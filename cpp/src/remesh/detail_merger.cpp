#include "remesh/detail_merger.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/sort.h"
#include "geom/measure.h"
#include "geom/predicates.h"
#include "geom/ray.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Two nodes bound a detail only if their distance along feature lines is at least this many times that through space.
/// Otherwise a line merely bends, or two lines meet at a corner.
constexpr double kArcPerWidth = 3.0;
/// Passes of merges and splits. Merges bring other lines closer.
constexpr int kMaxMergePasses = 8;
/// A triangle that is thicker than the distance may be turned by at most 60 degrees from the given surface.
constexpr double kMinTurnCosine = 0.5;
/// An edge is not split within this fraction of its length from its ends: rounding could make the parts degenerate.
constexpr double kMinPart = 1e-3;
/// A merge may remove at most this fraction of the thickness of a wall.
constexpr double kRemovedWall = 0.501;
/// Least cosine between the normal of a wall's other side and the direction through the wall.
constexpr double kOtherSideCosine = 0.2;
/// Distance / diagonal within which a wall's other side is this side itself: a few thousand roundings of a coordinate.
constexpr double kSameSide = 1e-12;

/// Cosine of the smallest angle of triangles that are not poor: 15 degrees.
constexpr double kPoorCosine = 0.9659258262890683;

/// Returns true if the angle of a triangle at `apex` is small.
bool isSharp(const Vec3& apex, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - apex;
  const Vec3 v = b - apex;
  return glm::dot(u, v) > kPoorCosine * glm::length(u) * glm::length(v);
}

}  // namespace

DetailMerger::DetailMerger(const ReferenceSurface& reference, double distance, DetailChoice choice)
    : reference_(reference),
      distance_(distance),
      choice_(choice),
      complex_(reference),
      grid_(complex_, distance, tetrafront::pointOf(reference.mesh(), NodeId(0U))),
      places_(complex_.nodeCount()),
      into_(complex_.nodeCount()),
      moved_(complex_.nodeCount(), 0.0) {
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) insert(t, t);
  for (std::size_t l = 0; l < reference.lines().size(); ++l) {
    const FeatureLine& line = reference.lines()[l];
    if (line.patches.size() > 2) hasInterfaces_ = true;
    for (std::size_t i = 0; i < line.nodes().size(); ++i) {
      const NodeId node = line.nodes()[i];
      if (complex_.kindOf(node) != NodeKind::kLine) continue;
      // The first node of a closed line is also the last one.
      if (!places_[node.index()].line.isNone()) continue;
      places_[node.index()] = {FeatureLineId(l), line.arcs()[i]};
    }
  }
}

void DetailMerger::insert(TriangleId triangle, TriangleId origin) {
  if (triangle.index() >= origin_.size()) origin_.resize(triangle.index() + 1);
  origin_[triangle.index()] = origin;
  grid_.insert(triangle);
}

Task<> DetailMerger::run(Work& work) {
  for (int pass = 0; pass < kMaxMergePasses; ++pass) {
    work.beginPart((1.0 + pass) / kMaxMergePasses);
    std::size_t made = 0;
    const std::size_t slots = complex_.triangleSlots();
    co_await work.forEachBlock(slots, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t) {
        if (splitUnderApex(TriangleId(t))) ++made;
      }
    });
    collectCandidates();
    co_await work.yield();
    co_await work.forEachBlock(candidates_.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        if (merge(candidates_[i])) ++made;
      }
    });
    if (made == 0) break;
  }
}

/// Returns the node at which a given node is now.
NodeId DetailMerger::nowAt(NodeId node) const {
  while (!into_[node.index()].isNone()) node = into_[node.index()];
  return node;
}

/// Returns the distance along the line to its end at a corner, or infinity.
double DetailMerger::distanceToEnd(const LinePlace& place, NodeId end) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (place.line.isNone()) return nearest;
  const FeatureLine& line = reference_.line(place.line);
  if (line.isClosed()) return nearest;
  if (nowAt(line.nodes().front()) == end) nearest = place.arc;
  if (nowAt(line.nodes().back()) == end) nearest = std::min(nearest, line.length() - place.arc);
  return nearest;
}

/// Returns the distance along one feature line, or along two that meet at a corner; otherwise infinity.
double DetailMerger::distanceAlongLines(NodeId a, NodeId b) const {
  const LinePlace& here = places_[a.index()];
  const LinePlace& there = places_[b.index()];
  double nearest = std::min(distanceToEnd(here, b), distanceToEnd(there, a));
  if (here.line.isNone() || there.line.isNone()) return nearest;
  const FeatureLine& line = reference_.line(here.line);
  if (here.line == there.line) {
    const double along = std::fabs(here.arc - there.arc);
    nearest = std::min(nearest, line.isClosed() ? std::min(along, line.length() - along) : along);
  }
  if (line.isClosed()) return nearest;
  for (const NodeId end : {nowAt(line.nodes().front()), nowAt(line.nodes().back())}) {
    nearest = std::min(nearest, 0.5 * (distanceToEnd(here, end) + distanceToEnd(there, end)));
  }
  return nearest;
}

bool DetailMerger::boundDetail(NodeId a, NodeId b, double width) const {
  return isOnLine(a) && isOnLine(b) && distanceAlongLines(a, b) >= kArcPerWidth * width;
}

/// Returns true if all details are chosen, or the angle opposite the edge is small in one of its triangles.
bool DetailMerger::isChosen(NodeId a, NodeId b) const {
  if (choice_ == DetailChoice::kAll) return true;
  bool isPoor = false;
  complex_.visitStar(a, [&](TriangleId triangle, std::uint32_t k) {
    const NodeTriple& nodes = complex_.nodesOf(triangle);
    const NodeId next = nodes[(k + 1) % 3];
    const NodeId last = nodes[(k + 2) % 3];
    if (next != b && last != b) return;
    const NodeId apex = next == b ? last : next;
    isPoor |= isSharp(complex_.pointOf(apex), complex_.pointOf(a), complex_.pointOf(b));
  });
  return isPoor;
}

/// Returns true if the edge is narrower than the distance and joins two feature lines, or is a short feature line.
bool DetailMerger::isDetail(NodeId a, NodeId b) const {
  const double length = glm::length(complex_.pointOf(b) - complex_.pointOf(a));
  if (length >= distance_ || !isChosen(a, b)) return false;
  const StretchId stretch = complex_.stretchBetween(a, b);
  if (!stretch.isNone()) {
    const FeatureLine& line = reference_.line(complex_.stretch(stretch).line);
    return !line.isClosed() && line.length() < distance_;
  }
  return boundDetail(a, b, length);
}

/// Lists the edges that are details, the shortest first.
void DetailMerger::collectCandidates() {
  candidates_.clear();
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t)) continue;
    const NodeTriple& nodes = complex_.nodesOf(t);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const NodeId a = std::min(nodes[k], nodes[(k + 1) % 3]);
      const NodeId b = std::max(nodes[k], nodes[(k + 1) % 3]);
      if (complex_.halfEdgeBetween(a, b) != halfEdgeOf(t, k) || !isDetail(a, b)) continue;
      candidates_.push_back({a, b, glm::length(complex_.pointOf(b) - complex_.pointOf(a))});
    }
  }
  stableSort(candidates_,
             [](const Candidate& x, const Candidate& y) { return x.length < y.length; });
}

bool DetailMerger::merge(const Candidate& candidate) {
  const auto [a, b, length] = candidate;
  if (!complex_.areJoined(a, b) || !isDetail(a, b)) return false;
  // Corners stay if possible.
  const bool isCornerA = complex_.kindOf(a) == NodeKind::kCorner;
  const bool isCornerB = complex_.kindOf(b) == NodeKind::kCorner;
  if (isCornerA && !isCornerB) return moveOnto(b, a) || moveOnto(a, b);
  return moveOnto(a, b) || moveOnto(b, a);
}

bool DetailMerger::keepsTopology(NodeId a, NodeId b) {
  complex_.collectEdge(a, b, edge_);
  complex_.collectRing(a, ringA_);
  complex_.collectRing(b, ringB_);
  return collapseKeepsTopology(edge_, ringA_, ringB_);
}

bool DetailMerger::moveOnto(NodeId a, NodeId b) {
  const Vec3 from = complex_.pointOf(a);
  const double length = glm::length(complex_.pointOf(b) - from);
  const double moved = moved_[a.index()] + length;
  if (moved > distance_ || !keepsTopology(a, b)) return false;
  added_.clear();
  complex_.collectStar(a, removed_);
  for (const TriangleId t : removed_) {
    NodeTriple nodes = complex_.nodesOf(t);
    if (std::ranges::find(nodes, b) != nodes.end()) continue;
    std::ranges::replace(nodes, a, b);
    added_.push_back({nodes, complex_.patchOf(t), origin_[t.index()]});
  }
  if (added_.empty() || !isAdmitted() || !keepsWalls(a, b)) return false;
  from_ = a;
  onto_ = b;
  replace();
  from_ = onto_ = NodeId{};
  into_[a.index()] = b;
  moved_[b.index()] = std::max(moved_[b.index()], moved);
  // Where several lines meet, the place on one of them says nothing.
  if (places_[a.index()].line != places_[b.index()].line) places_[b.index()] = {};
  merged_.push_back({from, complex_.pointOf(b)});
  return true;
}

/// Returns true if the added triangles are not degenerate, do not turn over, intersect no others and pass over none.
bool DetailMerger::isAdmitted() {
  numbered_.clear();
  for (const Added& added : added_) {
    const auto [a, b, c] = added.nodes;
    const std::array<Vec3, 3> corners{complex_.pointOf(a), complex_.pointOf(b),
                                      complex_.pointOf(c)};
    if (collinear(corners[0], corners[1], corners[2])) return false;
    const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Vec3& facing = reference_.normalOf(added.origin);
    // Thin triangles may turn as they like.
    const bool isThick = glm::length(normal) > distance_ * longestEdgeLengthOf(corners);
    if (isThick && glm::dot(normal, facing) < kMinTurnCosine * glm::length(normal)) return false;
    numbered_.push_back(numbered(added.nodes, corners));
  }
  grid_.setHidden(removed_, true);
  const bool collides = grid_.collide({removed_, numbered_, NodeId{}});
  grid_.setHidden(removed_, false);
  return !collides;
}

/// Returns false if a triangle whose node moves onto another one would go through half of a wall. The thickness is that at
/// some distance from the line: at a neck, or at the end of a cusp, the part becomes thicker there.
bool DetailMerger::keepsWalls(NodeId from, NodeId onto) const {
  const Vec3& start = complex_.pointOf(from);
  const Vec3& end = complex_.pointOf(onto);
  return std::ranges::all_of(added_, [&](const Added& added) {
    const std::array<Vec3, 3> corners = cornersOf(reference_.mesh(), added.origin);
    const double depth = glm::dot(corners[0] - end, reference_.normalOf(added.origin));
    if (depth <= 0.0 && !hasInterfaces_) return true;
    const Vec3 towards = centroidOf(corners) - start;
    const double length = glm::length(towards);
    const Vec3 beside = length > 0.0 ? start + towards * std::max(distance_ / length, 1.0) : start;
    const NearestPoint nearest =
        reference_.nearest(beside, added.patch, 2.0 * distance_ + length, added.origin);
    if (nearest.triangle.isNone()) return true;
    const Vec3& normal = reference_.normalOf(nearest.triangle);
    return !hasWall(nearest.position, depth > 0.0 ? -normal : normal, std::fabs(depth));
  });
}

/// Returns true if `depth` is more than half of the thickness at the position.
bool DetailMerger::hasWall(const Vec3& position, const Vec3& inward, double depth) const {
  const Ray ray(position, inward, kSameSide * reference_.diagonal());
  double limit = depth / kRemovedWall;
  bool isFound = false;
  reference_.tree().visitAlong(ray, limit, [&](std::uint32_t item) {
    const TriangleId t = reference_.pieces()[item].triangle;
    const double cosine = glm::dot(reference_.normalOf(t), inward);
    if ((hasInterfaces_ ? std::fabs(cosine) : cosine) < kOtherSideCosine) return;
    const std::optional<double> distance = ray.distanceTo(cornersOf(reference_.mesh(), t));
    if (!distance || !(*distance < limit)) return;
    isFound = true;
    limit = 0.0;  // ends the search
  });
  return isFound;
}

/// Splits a feature edge of the triangle below its apex, if the apex is on another line and near.
bool DetailMerger::splitUnderApex(TriangleId triangle) {
  if (!complex_.isAlive(triangle)) return false;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfEdgeId halfEdge = halfEdgeOf(triangle, k);
    const auto [a, b, apex] = complex_.nodesOf(halfEdge);
    if (complex_.stretchOf(halfEdge).isNone() || !isOnLine(apex)) continue;
    if (!isChosen(apex, a) && !isChosen(apex, b)) continue;
    const Vec3& from = complex_.pointOf(a);
    const Vec3 edge = complex_.pointOf(b) - from;
    const Vec3 offset = complex_.pointOf(apex) - from;
    const double part = glm::dot(offset, edge) / glm::dot(edge, edge);
    if (!(part > kMinPart && part < 1.0 - kMinPart)) continue;
    const double height = glm::length(offset - edge * part);
    // An end that is as near is merged without a new node.
    if (height >= distance_ || std::min(part, 1.0 - part) * glm::length(edge) < height) continue;
    if (boundDetail(apex, part < 0.5 ? a : b, height) && splitFeatureEdge(halfEdge, part)) {
      return true;
    }
  }
  return false;
}

bool DetailMerger::splitFeatureEdge(HalfEdgeId halfEdge, double part) {
  const auto [a, b, apex] = complex_.nodesOf(halfEdge);
  const Vec3 edge = complex_.pointOf(b) - complex_.pointOf(a);
  const StretchId id = complex_.stretchOf(halfEdge);
  const Stretch whole = complex_.stretch(id);
  const double along = whole.from == a ? part : 1.0 - part;
  const double arc = whole.begin + along * (whole.end - whole.begin);
  const NodeId middle = complex_.addNode(
      reference_.representable(complex_.pointOf(a) + edge * part), NodeKind::kLine);
  complex_.collectEdge(a, b, edge_);
  removed_.clear();
  added_.clear();
  for (const HalfEdgeId each : edge_) {
    const TriangleId t = triangleOf(each);
    const HalfEdgeNodes nodes = complex_.nodesOf(each);
    removed_.push_back(t);
    added_.push_back({{nodes.from, middle, nodes.apex}, complex_.patchOf(t), origin_[t.index()]});
    added_.push_back({{middle, nodes.to, nodes.apex}, complex_.patchOf(t), origin_[t.index()]});
  }
  if (!isAdmitted()) {
    complex_.removeLastNode();
    return false;
  }
  places_.push_back({whole.line, arc});
  into_.emplace_back();
  moved_.push_back(std::max(moved_[a.index()], moved_[b.index()]));
  replace();
  const NodeId first = whole.from == a ? a : b;
  const NodeId last = whole.from == a ? b : a;
  complex_.setStretchBetween(first, middle,
                             complex_.addStretch({whole.line, whole.begin, arc, first}));
  complex_.setStretchBetween(middle, last,
                             complex_.addStretch({whole.line, arc, whole.end, middle}));
  return true;
}

/// Returns the stretch that an edge will have after the change. Feature edges of a node that moves move with it.
StretchId DetailMerger::stretchAfter(NodeId a, NodeId b) const {
  const StretchId now = complex_.stretchBetween(a, b);
  if (!now.isNone() || onto_.isNone()) return now;
  if (a == onto_) return complex_.stretchBetween(from_, b);
  return b == onto_ ? complex_.stretchBetween(a, from_) : now;
}

void DetailMerger::replace() {
  std::vector<StretchId> stretches;
  for (const Added& added : added_) {
    for (std::size_t k = 0; k < 3; ++k) {
      stretches.push_back(stretchAfter(added.nodes[k], added.nodes[(k + 1) % 3]));
    }
  }
  for (const TriangleId t : removed_) {
    grid_.remove(t);
    complex_.removeTriangle(t);
  }
  for (const Added& added : added_) {
    insert(complex_.addTriangle(added.nodes, added.patch), added.origin);
  }
  for (std::size_t i = 0; i < added_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const StretchId stretch = stretches[3 * i + k];
      if (stretch.isNone()) continue;
      complex_.setStretchBetween(added_[i].nodes[k], added_[i].nodes[(k + 1) % 3], stretch);
    }
  }
}

double DetailMerger::deviation() const {
  double largest = 0.0;
  for (const NodeId node : IdRange<NodeId>(complex_.nodeCount())) {
    if (complex_.isUsed(node)) largest = std::max(largest, moved_[node.index()]);
  }
  return largest;
}

void DetailMerger::copyTo(SurfaceMesh& mesh, std::vector<TriangleId>& origin) const {
  mesh.points.clear();
  mesh.triangles.clear();
  origin.clear();
  std::vector<std::uint32_t> number(complex_.nodeCount(), kNoIndex);
  for (const NodeId node : IdRange<NodeId>(complex_.nodeCount())) {
    if (!complex_.isUsed(node)) continue;
    number[node.index()] = static_cast<std::uint32_t>(mesh.points.size() / 3);
    const Vec3& point = complex_.pointOf(node);
    mesh.points.insert(mesh.points.end(), {point.x, point.y, point.z});
  }
  for (const TriangleId t : IdRange<TriangleId>(complex_.triangleSlots())) {
    if (!complex_.isAlive(t)) continue;
    for (const NodeId node : complex_.nodesOf(t)) mesh.triangles.push_back(number[node.index()]);
    origin.push_back(origin_[t.index()]);
  }
}

}  // namespace tetrafront
