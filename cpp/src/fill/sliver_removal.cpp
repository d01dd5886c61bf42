#include "fill/sliver_removal.h"

#include <algorithm>
#include <cmath>

namespace tetrafront {
namespace {

/// A tetrahedron with a smaller shape is flat by rounding. Shape grows with the square of the
/// height: the limit is a height of 1e-10 edge lengths, far above the last bit of a coordinate and
/// far below the height of any intended element.
constexpr double kMaxSliverShape = 1e-20;
/// Range of heights tried for the new point, in lengths of the shorter edge: from a fair shape down
/// to one as flat as the sliver that it replaces.
constexpr double kMaxHeight = 0.1;
constexpr double kMinHeight = 1e-11;
/// Factor from one height to the next.
constexpr double kHeightFactor = 0.125;

}  // namespace

std::size_t SliverRemoval::removeAt(NodeId node, std::vector<NodeId>& made) {
  mesh_.star(node, star_);
  std::vector<NodeQuad> flat;
  for (const TetId id : star_) {
    const NodeQuad& n = mesh_.tet(id).nodes;
    if (std::fabs(shapeOf(mesh_.points, n)) < kMaxSliverShape) flat.push_back(n);
  }
  std::size_t count = 0;
  for (const NodeQuad& n : flat) {
    // Removing the previous sliver may have removed this one too.
    mesh_.star(node, star_);
    const auto isStill = [&](TetId id) { return mesh_.tet(id).nodes == n; };
    if (std::none_of(star_.begin(), star_.end(), isStill)) continue;
    const NodeId point = replaceOneOf(n);
    if (point.isNone()) continue;
    made.push_back(point);
    ++count;
  }
  return count;
}

/// Replaces one of the two opposite edges that cross in the plane.
NodeId SliverRemoval::replaceOneOf(const NodeQuad& flat) {
  for (const auto& [one, two] : {std::pair<Edge, Edge>{{flat[0], flat[1]}, {flat[2], flat[3]}},
                                 {{flat[0], flat[2]}, {flat[1], flat[3]}},
                                 {{flat[0], flat[3]}, {flat[1], flat[2]}}}) {
    NodeId point = replace(one, two);
    if (point.isNone()) point = replace(two, one);
    if (!point.isNone()) return point;
  }
  return {};
}

bool SliverRemoval::collectRing(const Edge& edge) {
  mesh_.star(edge.u, ring_);
  const auto seed =
      std::find_if(ring_.begin(), ring_.end(), [&](TetId tet) { return mesh_.has(tet, edge.v); });
  if (seed == ring_.end()) return false;
  const TetId first = *seed;
  mesh_.ring(first, edge.u, edge.v, ring_);
  return true;
}

NodeId SliverRemoval::replace(const Edge& edge, const Edge& other) {
  const ExactPoints& points = mesh_.points;
  const Vec3 start = points.position(edge.u);
  const Vec3 along = points.position(edge.v) - start;
  const Vec3 across = points.position(other.v) - points.position(other.u);
  const Vec3 between = points.position(other.u) - start;
  const Vec3 normal = glm::cross(along, across);
  const double square = glm::dot(normal, normal);
  if (!(square > 0.0)) return {};
  const double t = glm::dot(glm::cross(between, across), normal) / square;
  const double r = glm::dot(glm::cross(between, along), normal) / square;
  const bool cross = t > 0.0 && t < 1.0 && r > 0.0 && r < 1.0;
  if (!cross || !collectRing(edge)) return {};
  const Vec3 unit = normal * (1.0 / std::sqrt(square));
  const double length = std::min(glm::length(along), glm::length(across));
  ConeRules rules;
  rules.maxCavity = ring_.size() + kMaxCavityGrowth;
  for (double height = kMaxHeight; height > kMinHeight; height *= kHeightFactor) {
    for (const double off : {height * length, -height * length}) {
      const NodeId made = mesh_.points.add(start + along * t + unit * off);
      if (cone_.make(made, ring_, rules)) return made;
      mesh_.points.dropLast();
    }
  }
  return {};
}

}  // namespace tetrafront
