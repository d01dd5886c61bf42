#include "fill/boundary_clearing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "fill/star_kernel.h"

namespace tetrafront {
namespace {

/// Tetrahedra around a star may give way to an existing point, up to so many in all.
constexpr std::size_t kLargestGrowth = 200;
/// Halvings of the step inwards, in doubles and then exactly.
constexpr int kMaxHalvings = 50;
constexpr int kMaxExactHalvings = 400;
constexpr int kMaxTruncations = 8;

Vec3 unitNormal(const ExactPoints& points, const std::array<NodeId, 3>& t) {
  const Vec3& a = points.place(t[0]);
  const Vec3 n = glm::cross(points.place(t[1]) - a, points.place(t[2]) - a);
  const double length = std::sqrt(glm::dot(n, n));
  return length > 0.0 ? n * (1.0 / length) : n;
}

/// The leading so many times 53 bits.
Dyadic truncated(const Dyadic& value, int steps) {
  Dyadic result;
  Dyadic rest = value;
  for (int i = 0; i < steps && rest.sign() != 0; ++i) {
    const Dyadic part(rest.toDouble());
    result = result + part;
    rest = rest - part;
  }
  return result;
}

}  // namespace

BoundaryClearing::BoundaryClearing(FillMesh& mesh,
                                   const std::vector<std::array<NodeId, 3>>& triangles,
                                   std::span<const NodeId> boundaryPoints)
    : mesh_(mesh), triangles_(triangles), cone_(mesh, none_), thickening_(mesh) {
  separateSectors(boundaryPoints);
}

/// A point where pieces of the inside meet in an edge or at it alone becomes one point for each.
void BoundaryClearing::separateSectors(std::span<const NodeId> boundaryPoints) {
  std::map<NodeId, std::vector<TetId>> tetsAt;
  for (const NodeId node : boundaryPoints) tetsAt[node];
  for (std::size_t i = 0; i < mesh_.slotCount(); ++i) {
    if (!mesh_.isLive(TetId(i))) continue;
    for (const NodeId node : mesh_.tet(TetId(i)).nodes) {
      const auto found = tetsAt.find(node);
      if (found != tetsAt.end()) found->second.emplace_back(i);
    }
  }
  for (const auto& [node, tets] : tetsAt) {
    bool first = true;
    for (const TetId tet : tets) {
      // Already given away.
      if (!mesh_.has(tet, node)) continue;
      mesh_.starFrom(tet, node, star_);
      if (first && star_.size() == tets.size()) {
        wait(node);
        break;
      }
      first = false;
      const NodeId own = mesh_.points.copy(node);
      mesh_.separate(star_, node, own);
      wait(own);
    }
  }
}

void BoundaryClearing::wait(NodeId node) {
  turns_.resize(mesh_.points.size(), Turn::kNone);
  turns_[node.index()] = Turn::kWaiting;
  waiting_.push_back(node);
}

void BoundaryClearing::postpone(NodeId node) {
  turns_[node.index()] = Turn::kPostponed;
  postponed_.push_back(node);
}

/// The one that has been postponed longest; none if none is.
NodeId BoundaryClearing::nextToLift() {
  while (nextPostponed_ < postponed_.size()) {
    const NodeId node = postponed_[nextPostponed_++];
    if (turns_[node.index()] == Turn::kPostponed) return node;
  }
  return {};
}

/// Points wait for an existing point as long as there is hope; only then one is lifted to a new one,
/// which may make room for those around it.
BoundaryClearing::State BoundaryClearing::step() {
  const bool lifting = nextWaiting_ == waiting_.size();
  const NodeId node = lifting ? nextToLift() : waiting_[nextWaiting_++];
  if (node.isNone()) return State::kDone;
  mesh_.star(node, star_);
  if (!describe(node)) return State::kFailed;
  if (lifting ? replaceByExistingInRoom(node) || replaceByNew(node) : replaceByExisting(node)) {
    turns_[node.index()] = Turn::kNone;
    queueTouched(mesh_.lastMade());
    for (const NodeId point : madeRoom_) {
      mesh_.star(point, star_);
      queueTouched(star_);
    }
    madeRoom_.clear();
    return State::kRunning;
  }
  if (lifting) return State::kFailed;
  postpone(node);
  return State::kRunning;
}

/// What did not go with the same tetrahedra around does not go now; what has others now may.
void BoundaryClearing::queueTouched(std::span<const TetId> changed) {
  turns_.resize(mesh_.points.size(), Turn::kNone);
  const auto touch = [&](NodeId node) {
    if (turns_[node.index()] == Turn::kPostponed) wait(node);
  };
  for (const TetId id : changed) {
    const FillTet& t = mesh_.tet(id);
    for (std::uint32_t k = 0; k < 4; ++k) {
      touch(t.nodes[k]);
      const TetFace beyond = t.across[k];
      if (!beyond.isNone()) touch(mesh_.tet(beyond.tet).nodes[beyond.corner]);
    }
  }
}

// ---- what is around a point --------------------------------------------------------------------

/// Of what is in `star_`.
bool BoundaryClearing::describe(NodeId node) {
  fans_.clear();
  std::map<std::uint32_t, std::vector<std::array<NodeId, 2>>> linksOf;
  std::map<std::uint32_t, NodeId> aboveOf;
  for (const TetId id : star_) {
    const FillTet& t = mesh_.tet(id);
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (!t.across[k].isNone() || t.nodes[k] == node) continue;
      const std::array<NodeId, 3> f = mesh_.innerFace(id, k);
      const std::size_t at = f[0] == node ? 0 : (f[1] == node ? 1 : 2);
      linksOf[t.facet[k]].push_back({f[(at + 1) % 3], f[(at + 2) % 3]});
      aboveOf[t.facet[k]] = t.nodes[k];
    }
  }
  for (auto& [facet, links] : linksOf) {
    Fan fan;
    fan.facet = facet;
    fan.above = aboveOf[facet];
    if (!chainFans(links, fan) || !triangulate(fan)) return false;
    fans_.push_back(std::move(fan));
  }
  return !fans_.empty();
}

/// Puts the links from node to node in their order; in a fan that ends at an edge they form no loop.
bool BoundaryClearing::chainFans(std::vector<std::array<NodeId, 2>>& links, Fan& fan) const {
  std::map<NodeId, NodeId> next;
  std::map<NodeId, NodeId> previous;
  for (const auto& link : links) {
    next[link[0]] = link[1];
    previous[link[1]] = link[0];
  }
  if (next.size() != links.size() || previous.size() != links.size()) return false;
  NodeId start = links.front()[0];
  for (const auto& [node, to] : next) {
    if (!previous.contains(node)) start = node;
  }
  fan.polygon.assign(1, start);
  for (auto at = next.find(start); at != next.end() && at->second != start;
       at = next.find(at->second)) {
    fan.polygon.push_back(at->second);
    if (fan.polygon.size() > links.size() + 1) return false;
  }
  const bool closed = !previous.empty() && previous.contains(start);
  return fan.polygon.size() == links.size() + (closed ? 0 : 1);
}

/// Cuts off ears. Corners on a straight line are corners too: they stay.
bool BoundaryClearing::triangulate(Fan& fan) const {
  std::vector<NodeId> rest = fan.polygon;
  const auto turn = [&](NodeId a, NodeId b, NodeId c) {
    return mesh_.points.orient(a, b, c, fan.above);
  };
  while (rest.size() > 2) {
    const std::size_t n = rest.size();
    std::size_t best = n;
    double bestMeasure = -1.0;
    for (std::size_t i = 0; i < n; ++i) {
      const NodeId a = rest[(i + n - 1) % n];
      const NodeId b = rest[i];
      const NodeId c = rest[(i + 1) % n];
      const Vec3 ab = mesh_.points.place(b) - mesh_.points.place(a);
      const Vec3 bc = mesh_.points.place(c) - mesh_.points.place(b);
      const Vec3 ca = mesh_.points.place(a) - mesh_.points.place(c);
      const Vec3 normal = glm::cross(ab, bc);
      const double measure = std::sqrt(glm::dot(normal, normal)) /
                             (glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca));
      if (measure <= bestMeasure || turn(a, b, c) <= 0) continue;
      const bool empty = std::none_of(rest.begin(), rest.end(), [&](NodeId p) {
        return p != a && p != b && p != c && turn(a, b, p) >= 0 && turn(b, c, p) >= 0 &&
               turn(c, a, p) >= 0;
      });
      if (!empty) continue;
      best = i;
      bestMeasure = measure;
    }
    if (best == n) return false;
    fan.triangles.push_back(
        {{rest[(best + n - 1) % n], rest[best], rest[(best + 1) % n]}, fan.facet});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return true;
}

// ---- by an existing point ------------------------------------------------------------------------

/// A point in the plane of a fan can only be one of its own. Asked of the given triangle, whose nodes are
/// doubles.
bool BoundaryClearing::seesBoundary(NodeId apex) const {
  return std::all_of(fans_.begin(), fans_.end(), [&](const Fan& fan) {
    if (std::find(fan.polygon.begin(), fan.polygon.end(), apex) != fan.polygon.end()) return true;
    const auto& t = triangles_[fan.facet];
    return mesh_.points.orient(t[0], t[1], t[2], apex) > 0;
  });
}

/// The boundary without the point. Where the apex is on it, all triangles there meet at the apex.
std::vector<BoundaryFace> BoundaryClearing::boundaryFor(NodeId apex) const {
  std::vector<BoundaryFace> faces;
  for (const Fan& fan : fans_) {
    const std::size_t n = fan.polygon.size();
    const auto at = std::find(fan.polygon.begin(), fan.polygon.end(), apex);
    if (at == fan.polygon.end()) {
      faces.insert(faces.end(), fan.triangles.begin(), fan.triangles.end());
      continue;
    }
    const auto first = static_cast<std::size_t>(at - fan.polygon.begin());
    for (std::size_t i = 1; i + 1 < n; ++i) {
      faces.push_back(
          {{apex, fan.polygon[(first + i) % n], fan.polygon[(first + i + 1) % n]}, fan.facet});
    }
  }
  return faces;
}

std::vector<NodeId> BoundaryClearing::candidates(NodeId node) const {
  std::vector<NodeId> nodes = mesh_.neighboursIn(star_, node);
  std::erase_if(nodes, [&](NodeId apex) { return !seesBoundary(apex); });
  return nodes;
}

/// By the neighbour that makes the best tetrahedra.
bool BoundaryClearing::replaceByExisting(NodeId node) {
  NodeId best;
  double bestShape = 0.0;
  ConeRules rules;
  rules.lost = node;
  for (const NodeId apex : candidates(node)) {
    const std::vector<BoundaryFace> boundary = boundaryFor(apex);
    rules.boundary = boundary;
    if (!cone_.plan(apex, star_, rules)) continue;
    const double shape = cone_.leastShape();
    if (!best.isNone() && shape <= bestShape) continue;
    best = apex;
    bestShape = shape;
  }
  if (best.isNone()) return false;
  const std::vector<BoundaryFace> boundary = boundaryFor(best);
  rules.boundary = boundary;
  return cone_.make(best, star_, rules);
}

/// By the first neighbour that can, if tetrahedra around the star may give way too.
bool BoundaryClearing::replaceByExistingInRoom(NodeId node) {
  ConeRules rules;
  rules.lost = node;
  rules.largestCavity = star_.size() + kLargestGrowth;
  const std::vector<NodeId> nodes = candidates(node);
  return std::any_of(nodes.begin(), nodes.end(), [&](NodeId apex) {
    const std::vector<BoundaryFace> boundary = boundaryFor(apex);
    rules.boundary = boundary;
    return cone_.make(apex, star_, rules);
  });
}

// ---- by a new point ------------------------------------------------------------------------------

bool BoundaryClearing::tryLast(NodeId node, std::size_t growth) {
  std::vector<BoundaryFace> boundary;
  for (const Fan& fan : fans_) {
    boundary.insert(boundary.end(), fan.triangles.begin(), fan.triangles.end());
  }
  ConeRules rules;
  rules.lost = node;
  rules.largestCavity = growth;
  rules.boundary = boundary;
  const NodeId last(mesh_.points.size() - 1);
  if (cone_.make(last, star_, rules)) {
    interiorPoints_.push_back(last);
    return true;
  }
  mesh_.points.dropLast();
  return false;
}

bool BoundaryClearing::tryPlace(NodeId node, const Vec3& place, std::size_t growth) {
  mesh_.points.add(place);
  return tryLast(node, growth);
}

bool BoundaryClearing::tryPlace(NodeId node, const DyadicVec3& place) {
  mesh_.points.add(place);
  return tryLast(node, 0);
}

Vec3 BoundaryClearing::inwards() const {
  Vec3 sum(0.0);
  for (const Fan& fan : fans_) sum += unitNormal(mesh_.points, triangles_[fan.facet]);
  const double length = std::sqrt(glm::dot(sum, sum));
  return length > 0.0 ? sum * (1.0 / length) : sum;
}

DyadicVec3 BoundaryClearing::exactNormal(const Fan& fan) const {
  const auto& t = triangles_[fan.facet];
  const DyadicVec3 a = mesh_.points.exact(t[0]);
  return cross(mesh_.points.exact(t[1]) - a, mesh_.points.exact(t[2]) - a);
}

/// A direction that leads inwards from all planes around the point, by exact signs.
std::optional<DyadicVec3> BoundaryClearing::exactInwards() const {
  const DyadicVec3 first = exactNormal(fans_.front());
  const DyadicVec3 last = exactNormal(fans_.back());
  const auto leadsIn = [&](const DyadicVec3& d) {
    return dot(first, d).sign() > 0 && dot(last, d).sign() > 0;
  };
  DyadicVec3 plain = toDyadic(inwards());
  if (leadsIn(plain)) return plain;
  // Of normals n, m with n.m = -c < 0, (m.m + c) n + (n.n + c) m has with each the product
  // n.n m.m - c c > 0.
  const Dyadic c = dot(first, last).negated();
  const DyadicVec3 direction = first * (dot(last, last) + c) + last * (dot(first, first) + c);
  for (int steps = 1; steps <= kMaxTruncations; ++steps) {
    DyadicVec3 shorter{truncated(direction[0], steps), truncated(direction[1], steps),
                       truncated(direction[2], steps)};
    if (leadsIn(shorter)) return shorter;
  }
  return {};
}

/// How far the farthest node around is.
double BoundaryClearing::reach(NodeId node) const {
  double farthest = 0.0;
  for (const TetId id : star_) {
    for (const NodeId other : mesh_.tet(id).nodes) {
      const Vec3 way = mesh_.points.place(other) - mesh_.points.place(node);
      farthest = std::max(farthest, glm::length(way));
    }
  }
  return farthest;
}

bool BoundaryClearing::replaceByNew(NodeId node) {
  if (replaceByDouble(node)) return true;
  madeRoom_.clear();
  if (thickening_.makeRoomAt(node, madeRoom_) > 0) {
    interiorPoints_.insert(interiorPoints_.end(), madeRoom_.begin(), madeRoom_.end());
    mesh_.star(node, star_);
    if (!describe(node)) return false;
    if (replaceByDouble(node)) return true;
  }
  return replaceByExact(node);
}

bool BoundaryClearing::replaceByDouble(NodeId node) {
  StarKernel kernel;
  const Vec3 place = mesh_.points.place(node);
  for (const TetId id : star_) {
    kernel.add(mesh_.points, mesh_.innerFace(id, mesh_.cornerOf(id, node)));
  }
  for (const Fan& fan : fans_) {
    for (const BoundaryFace& face : fan.triangles) kernel.add(mesh_.points, face.nodes);
  }
  const Vec3 middle = kernel.middle();
  const Vec3 direction = inwards();
  for (const std::size_t growth : {std::size_t{0}, kLargestGrowth}) {
    if (tryPlace(node, kernel.deepest(middle), growth)) return true;
    double step = 0.5 * reach(node);
    for (int i = 0; i < kMaxHalvings; ++i, step *= 0.5) {
      const Vec3 there = place + direction * step;
      if (tryPlace(node, kernel.deepest(there), growth) || tryPlace(node, there, growth)) {
        return true;
      }
    }
  }
  return false;
}

/// A little way inwards, however little. Such a way exists, but for doubles it may be too little.
bool BoundaryClearing::replaceByExact(NodeId node) {
  const std::optional<DyadicVec3> exact = exactInwards();
  if (!exact) return false;
  const double length = std::fabs((*exact)[0].toDouble()) + std::fabs((*exact)[1].toDouble()) +
                        std::fabs((*exact)[2].toDouble());
  int exponent = 0;
  std::frexp(reach(node) / length, &exponent);
  const DyadicVec3 start = mesh_.points.exact(node);
  for (int i = 0; i < kMaxExactHalvings; ++i) {
    const Dyadic factor(std::ldexp(1.0, exponent - i));
    if (tryPlace(node, start + *exact * factor)) return true;
  }
  return false;
}

}  // namespace tetrafront
