#include "fill/boundary_recovery.h"

#include <algorithm>
#include <cmath>

#include "base/sort.h"

namespace tetrafront {
namespace {

/// Maximum number of tetrahedra in the cavity of a swap.
constexpr std::size_t kMaxSwapCavity = 150;
/// Number of times a position is computed to more digits, 50 bits at a time, before the attempt
/// fails.
constexpr int kMaxRefinements = 10;
constexpr std::int8_t kUnknown = 2;
/// Another pass of swaps follows if the last one left at most this share of its edges, in tenths.
constexpr std::size_t kWorthAnotherPass = 9;
/// Progress over the edges, 0 to 1, that the passes of swaps approach: each covers half of the
/// distance that is left. The rest belongs to the last pass, which may split edges.
constexpr double kSwapsEnd = 0.4;
/// A walk around a node may go in circles. After this many steps, search the whole star instead.
constexpr int kMaxWalkSteps = 200;

/// numerator / denominator to `steps` times about 50 bits.
Dyadic refinedQuotient(const Dyadic& numerator, const Dyadic& denominator, int steps) {
  Dyadic result;
  Dyadic rest = numerator;
  for (int i = 0; i < steps && rest.sign() != 0; ++i) {
    const Dyadic part(quotient(rest, denominator));
    result = result + part;
    rest = rest - part * denominator;
  }
  return result;
}

}  // namespace

BoundaryRecovery::BoundaryRecovery(FillMesh& mesh, const std::vector<NodeTriple>& triangles,
                                   EdgeOrder order)
    : mesh_(mesh), triangles_(triangles), cone_(mesh, constraints_) {
  collectEdges(order);
}

void BoundaryRecovery::collectEdges(EdgeOrder order) {
  for (const auto& t : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) edgeOf_.push_back({lowerFirst(t[k], t[(k + 1) % 3]), 0});
  }
  sortUnique(edgeOf_);
  for (auto& [nodes, edge] : edgeOf_) {
    edge = static_cast<std::uint32_t>(edges_.size());
    waiting_.push_back(edge);
    edges_.push_back({nodes.first, nodes.second, {}});
  }
  sortWaiting(order);
}

/// Sorts the waiting edges by length. They already are in the order of their nodes.
void BoundaryRecovery::sortWaiting(EdgeOrder order) {
  if (order == EdgeOrder::kByNodes) return;
  std::vector<double> keys;
  for (const Edge& edge : edges_) {
    const Vec3 along = mesh_.points.position(edge.to) - mesh_.points.position(edge.from);
    const double square = glm::dot(along, along);
    keys.push_back(order == EdgeOrder::kLongestFirst ? -square : square);
  }
  stableSort(waiting_, [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
}

// ---- edges
// ---------------------------------------------------------------------------------------

FillState BoundaryRecovery::recoverNextEdge() {
  if (nextWaiting_ == waiting_.size()) {
    if (postponed_.empty()) return FillState::kDone;
    beginPass();
  }
  const std::uint32_t index = waiting_[nextWaiting_++];
  const FillState state = recoverEdge(edges_[index]);
  if (state == FillState::kFailed) return state;
  if (state == FillState::kRunning) postponed_.push_back(index);
  return FillState::kRunning;
}

double BoundaryRecovery::edgesFraction() const {
  if (waiting_.empty()) return 1.0;
  const double part = static_cast<double>(nextWaiting_) / static_cast<double>(waiting_.size());
  const double passEnd = maySplit_ ? 1.0 : 0.5 * (passBegan_ + kSwapsEnd);
  return passBegan_ + (passEnd - passBegan_) * part;
}

void BoundaryRecovery::beginPass() {
  passBegan_ = edgesFraction();
  maySplit_ = 10 * postponed_.size() > kWorthAnotherPass * waiting_.size();
  waiting_.swap(postponed_);
  postponed_.clear();
  nextWaiting_ = 0;
}

/// Intersects the ray with one tetrahedron at `from`. If the tetrahedron does not contain the start
/// of the ray, `away` is the corner whose opposite face separates them.
BoundaryRecovery::Hit BoundaryRecovery::hitInTet(TetId tet, NodeId from, NodeId towards,
                                                 std::uint32_t& away) const {
  const ExactPoints& points = mesh_.points;
  const std::uint32_t corner = mesh_.cornerOf(tet, from);
  const NodeTriple f = mesh_.innerFace(tet, corner);
  for (const NodeId node : f) {
    if (node == towards) return {Hit::Kind::kNode, tet, corner, node, node};
  }
  NodeTriple ahead;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    NodeTriple side = f;
    side[k] = towards;
    const int sign = points.orient(side[0], side[1], side[2], from);
    if (sign < 0) {
      away = mesh_.cornerOf(tet, f[k]);
      return {};
    }
    if (sign > 0) ahead[count++] = f[k];
  }
  if (count == 3) return {Hit::Kind::kFace, tet, corner, {}, {}};
  if (count == 2) return {Hit::Kind::kEdge, tet, corner, ahead[0], ahead[1]};
  return {count == 1 ? Hit::Kind::kNode : Hit::Kind::kNothing, tet, corner, ahead[0], ahead[0]};
}

/// Walks around the node, from tetrahedron to tetrahedron, towards the ray.
BoundaryRecovery::Hit BoundaryRecovery::walkToHit(NodeId from, NodeId towards) const {
  TetId tet = mesh_.at(from);
  for (int step = 0; step < kMaxWalkSteps && !tet.isNone(); ++step) {
    std::uint32_t away = 4;
    const Hit hit = hitInTet(tet, from, towards, away);
    if (away == 4) return hit;
    tet = mesh_.tet(tet).across[away].tet;
  }
  return {};
}

BoundaryRecovery::Hit BoundaryRecovery::firstHit(NodeId from, NodeId towards) {
  const Hit near = walkToHit(from, towards);
  if (near.kind != Hit::Kind::kNothing) return near;
  // A star may be large, and the one at the other end small. From there, only an edge between both can be seen.
  const Hit back = walkToHit(towards, from);
  if (back.kind == Hit::Kind::kNode && back.u == from)
    return {Hit::Kind::kNode, back.tet, mesh_.cornerOf(back.tet, from), towards, towards};
  mesh_.star(from, star_);
  visitedTetrahedra_ += star_.size();
  for (const TetId tet : star_) {
    std::uint32_t away = 4;
    const Hit hit = hitInTet(tet, from, towards, away);
    if (hit.kind != Hit::Kind::kNothing) return hit;
  }
  return {};
}

/// Collects the tetrahedra whose interior or faces contain the hit position.
void BoundaryRecovery::tetsAtHit(const Hit& hit, std::vector<TetId>& result) {
  if (hit.kind == Hit::Kind::kEdge) {
    mesh_.ring(hit.tet, hit.u, hit.v, result);
  } else {
    result.assign(1, hit.tet);
    const TetFace beyond = mesh_.tet(hit.tet).across[hit.corner];
    if (!beyond.isNone()) result.push_back(beyond.tet);
  }
}

/// Joins the tetrahedra around the hit to the apex from which the ray starts. The ray then passes
/// along an edge.
bool BoundaryRecovery::swapAtHit(const Hit& hit, NodeId apex) {
  tetsAtHit(hit, tets_);
  ConeRules rules;
  rules.maxCavity = std::max(kMaxSwapCavity, tets_.size());
  return cone_.make(apex, tets_, rules);
}

NodeId BoundaryRecovery::splitEdgeAt(const Edge& edge, const Hit& hit) {
  ExactPoints& points = mesh_.points;
  // Compute the heights of the edge's ends above a plane through the hit edge or face.
  NodeTriple plane = mesh_.innerFace(hit.tet, hit.corner);
  if (hit.kind == Hit::Kind::kEdge) {
    const NodeId start = mesh_.tet(hit.tet).nodes[hit.corner];
    for (const NodeId node : mesh_.tet(hit.tet).nodes) {
      if (node != hit.u && node != hit.v && node != start) plane = {hit.u, hit.v, node};
    }
  }
  const Dyadic from = points.exactVolume(plane[0], plane[1], plane[2], edge.from);
  const Dyadic to = points.exactVolume(plane[0], plane[1], plane[2], edge.to);
  if ((from - to).sign() == 0) return {};
  tetsAtHit(hit, tets_);
  const DyadicVec3 start = points.exact(edge.from);
  const DyadicVec3 along = points.exact(edge.to) - start;
  for (int steps = 1; steps <= kMaxRefinements; ++steps) {
    const DyadicVec3 position = start + along * refinedQuotient(from, from - to, steps);
    const NodeId node = points.add(position);
    ConeRules rules;
    rules.maxCavity = tets_.size() + kMaxSwapCavity;
    rules.delaunay = true;
    if (cone_.make(node, tets_, rules)) return node;
    rules.delaunay = false;
    if (cone_.make(node, tets_, rules)) return node;
    points.dropLast();
  }
  return {};
}

FillState BoundaryRecovery::recoverEdge(Edge& edge) {
  edge.chain.assign(1, edge.from);
  while (edge.chain.back() != edge.to) {
    const NodeId from = edge.chain.back();
    const Hit hit = firstHit(from, edge.to);
    if (hit.kind == Hit::Kind::kNothing) return FillState::kFailed;
    if (hit.kind == Hit::Kind::kNode) {
      if (hit.u != edge.to) return FillState::kFailed;
      constraints_.add(from, edge.to);
      edge.chain.push_back(edge.to);
      break;
    }
    if (swapAtHit(hit, from)) continue;
    const Hit back = firstHit(edge.to, from);
    if (back.kind != Hit::Kind::kFace && back.kind != Hit::Kind::kEdge) return FillState::kFailed;
    if (swapAtHit(back, edge.to)) continue;
    if (!maySplit_) return FillState::kRunning;
    const NodeId node = splitEdgeAt(edge, hit);
    if (node.isNone()) return FillState::kFailed;
    boundaryPoints_.push_back(node);
    constraints_.add(from, node);
    edge.chain.push_back(node);
  }
  return FillState::kDone;
}

// ---- triangles
// -----------------------------------------------------------------------------------

std::vector<NodeId> BoundaryRecovery::chainBetween(NodeId from, NodeId to) const {
  const auto at = std::lower_bound(edgeOf_.begin(), edgeOf_.end(),
                                   std::pair(lowerFirst(from, to), std::uint32_t{0}));
  std::vector<NodeId> chain = edges_[at->second].chain;
  if (chain.front() != from) std::reverse(chain.begin(), chain.end());
  return chain;
}

void BoundaryRecovery::beginTriangle(FacetId triangle) {
  for (const NodeId node : knownSigns_) planeSigns_[node.index()] = kUnknown;
  knownSigns_.clear();
  const auto know = [&](NodeId node) {
    planeSigns_.resize(mesh_.points.size(), kUnknown);
    planeSigns_[node.index()] = 0;
    knownSigns_.push_back(node);
  };
  open_.clear();
  const auto& t = triangles_[triangle.index()];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<NodeId> chain = chainBetween(t[k], t[(k + 1) % 3]);
    for (const NodeId node : chain) know(node);
    for (std::size_t i = 1; i < chain.size(); ++i) open_.emplace(chain[i - 1], chain[i]);
  }
}

bool BoundaryRecovery::recoverTriangle(FacetId triangle) {
  beginTriangle(triangle);
  while (!open_.empty()) {
    if (!findFaceAt(triangle, *open_.begin())) return false;
  }
  return true;
}

/// Marks the face of the triangle to the left of an edge, or removes one obstacle to it.
bool BoundaryRecovery::findFaceAt(FacetId triangle, Direction edge) {
  const auto [x, y] = edge;
  const Hit hit = firstHit(x, y);
  if (hit.kind != Hit::Kind::kNode || hit.u != y) return false;
  mesh_.ring(hit.tet, x, y, tets_);
  const auto& t = triangles_[triangle.index()];
  const auto planeSignOf = [&](NodeId node) -> int {
    planeSigns_.resize(mesh_.points.size(), kUnknown);
    std::int8_t& known = planeSigns_[node.index()];
    if (known == kUnknown) {
      known = static_cast<std::int8_t>(mesh_.points.orient(t[0], t[1], t[2], node));
      knownSigns_.push_back(node);
    }
    return known;
  };
  for (const TetId tet : tets_) {
    // u and v are the other two corners, so that x y u v is positively oriented.
    const std::uint32_t cx = mesh_.cornerOf(tet, x);
    const NodeTriple f = mesh_.innerFace(tet, cx);
    const std::size_t cy = f[0] == y ? 0 : (f[1] == y ? 1 : 2);
    // (f, x) is positively oriented, and therefore also (x, f reversed).
    const NodeId u = f[(cy + 2) % 3];
    const NodeId v = f[(cy + 1) % 3];
    const int su = planeSignOf(u);
    const int sv = planeSignOf(v);
    if (su == 0 && sv > 0) {
      markFace(triangle, tet, x, y, u);
      return true;
    }
    if (sv == 0 && su < 0) {
      markFace(triangle, tet, x, y, v);
      return true;
    }
    if (su < 0 && sv > 0) return passCrossing(triangle, edge, u, v, tet);
  }
  return false;
}

bool BoundaryRecovery::passCrossing(FacetId triangle, Direction edge, NodeId below, NodeId above,
                                    TetId tet) {
  std::vector<TetId> around;
  mesh_.ring(tet, below, above, around);
  ConeRules rules;
  rules.maxCavity = std::max(kMaxSwapCavity, around.size());
  if (cone_.make(edge.first, around, rules) || cone_.make(edge.second, around, rules)) return true;
  return splitCrossing(triangle, below, above, around);
}

bool BoundaryRecovery::splitCrossing(FacetId triangle, NodeId below, NodeId above,
                                     std::span<const TetId> around) {
  ExactPoints& points = mesh_.points;
  const auto& t = triangles_[triangle.index()];
  const Dyadic low = points.exactVolume(t[0], t[1], t[2], below);
  const Dyadic high = points.exactVolume(t[0], t[1], t[2], above);
  const DyadicVec3 a = points.exact(t[0]);
  const DyadicVec3 ab = points.exact(t[1]) - a;
  const DyadicVec3 ac = points.exact(t[2]) - a;
  const DyadicVec3 normal = cross(ab, ac);
  const DyadicVec3 start = points.exact(below);
  const DyadicVec3 along = points.exact(above) - start;
  const Dyadic square = dot(normal, normal);
  for (int steps = 1; steps <= kMaxRefinements; ++steps) {
    // Find a position near the crossing, then move it into the plane by its coordinates in the
    // triangle.
    const DyadicVec3 near = start + along * refinedQuotient(low, low - high, steps) - a;
    const Dyadic s = refinedQuotient(dot(cross(near, ac), normal), square, steps);
    const Dyadic r = refinedQuotient(dot(cross(ab, near), normal), square, steps);
    const DyadicVec3 position = a + ab * s + ac * r;
    const NodeId node = points.add(position);
    ConeRules rules;
    rules.maxCavity = around.size() + kMaxSwapCavity;
    rules.delaunay = true;
    bool done = cone_.make(node, around, rules);
    rules.delaunay = false;
    if (done || cone_.make(node, around, rules)) {
      boundaryPoints_.push_back(node);
      planeSigns_.resize(points.size(), kUnknown);
      planeSigns_[node.index()] = 0;
      knownSigns_.push_back(node);
      return true;
    }
    points.dropLast();
  }
  return false;
}

void BoundaryRecovery::markFace(FacetId triangle, TetId tet, NodeId x, NodeId y, NodeId w) {
  for (std::uint32_t k = 0; k < 4; ++k) {
    const NodeId apex = mesh_.tet(tet).nodes[k];
    if (apex != x && apex != y && apex != w) {
      mesh_.markFacet(tet, k, triangle);
    }
  }
  close({x, y});
  close({y, w});
  close({w, x});
}

void BoundaryRecovery::close(Direction edge) {
  if (open_.erase(edge) == 0) open_.emplace(edge.second, edge.first);
}

}  // namespace tetrafront
