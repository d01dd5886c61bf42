#include "fill/boundary_fans.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tetrafront {
namespace {

/// Corner i of a polygon, between its neighbours.
NodeTriple cornerAt(const std::vector<NodeId>& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  return {polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]};
}

}  // namespace

bool BoundaryFans::describe(NodeId point, std::span<const TetId> star) {
  fans_.clear();
  std::map<FacetId, std::vector<Link>> linksOf;
  std::map<FacetId, NodeId> aboveOf;
  for (const TetId id : star) {
    const FillTet& t = mesh_.tet(id);
    for (std::uint32_t k = 0; k < 4; ++k) {
      if (!t.across[k].isNone() || t.nodes[k] == point) continue;
      const NodeTriple f = mesh_.innerFace(id, k);
      const std::size_t at = f[0] == point ? 0 : (f[1] == point ? 1 : 2);
      linksOf[t.facet[k]].push_back({f[(at + 1) % 3], f[(at + 2) % 3]});
      aboveOf[t.facet[k]] = t.nodes[k];
    }
  }
  for (const auto& [facet, links] : linksOf) {
    Fan fan;
    fan.facet = facet;
    fan.above = aboveOf[facet];
    if (!chain(links, fan) || !triangulate(fan)) return false;
    fans_.push_back(std::move(fan));
  }
  return !fans_.empty();
}

/// Chains the links into a polygon. The polygon of a fan that ends at an edge is not a loop.
bool BoundaryFans::chain(const std::vector<Link>& links, Fan& fan) {
  std::map<NodeId, NodeId> next;
  std::map<NodeId, NodeId> previous;
  for (const Link& link : links) {
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

/// Returns the shape of an ear; 0 if it is degenerate. Computed in doubles: the order of the ears
/// only affects shapes.
double BoundaryFans::shapeOfEar(const NodeTriple& ear) const {
  const ExactPoints& points = mesh_.points;
  const Vec3 ab = points.position(ear[1]) - points.position(ear[0]);
  const Vec3 bc = points.position(ear[2]) - points.position(ear[1]);
  const Vec3 ca = points.position(ear[0]) - points.position(ear[2]);
  const Vec3 normal = glm::cross(ab, bc);
  return std::sqrt(glm::dot(normal, normal)) /
         (glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca));
}

/// Decides by exact signs whether the corner is convex and no other corner lies in its triangle.
bool BoundaryFans::isEar(const std::vector<NodeId>& rest, std::size_t i, NodeId above) const {
  const auto orientation = [&](NodeId p, NodeId q, NodeId r) {
    return mesh_.points.orient(p, q, r, above);
  };
  const NodeTriple ear = cornerAt(rest, i);
  const NodeId a = ear[0];
  const NodeId b = ear[1];
  const NodeId c = ear[2];
  if (orientation(a, b, c) <= 0) return false;
  return std::none_of(rest.begin(), rest.end(), [&](NodeId p) {
    return p != a && p != b && p != c && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
           orientation(c, a, p) >= 0;
  });
}

/// Cuts off ears, the best shaped first. Corners on a straight line are nodes of the mesh and must
/// stay.
bool BoundaryFans::triangulate(Fan& fan) const {
  std::vector<NodeId> rest = fan.polygon;
  while (rest.size() > 2) {
    std::size_t best = rest.size();
    double bestShape = -1.0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const double shape = shapeOfEar(cornerAt(rest, i));
      if (shape <= bestShape || !isEar(rest, i, fan.above)) continue;
      best = i;
      bestShape = shape;
    }
    if (best == rest.size()) return false;
    fan.triangles.push_back({cornerAt(rest, best), fan.facet});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return true;
}

/// A point in the plane of a fan is visible only if it belongs to the fan. The test uses the given
/// triangle, because its nodes are doubles.
bool BoundaryFans::areVisibleFrom(NodeId apex) const {
  return std::all_of(fans_.begin(), fans_.end(), [&](const Fan& fan) {
    if (std::find(fan.polygon.begin(), fan.polygon.end(), apex) != fan.polygon.end()) return true;
    const auto& t = triangles_[fan.facet.index()];
    return mesh_.points.orient(t[0], t[1], t[2], apex) > 0;
  });
}

std::vector<BoundaryFace> BoundaryFans::faces() const {
  std::vector<BoundaryFace> faces;
  for (const Fan& fan : fans_) {
    faces.insert(faces.end(), fan.triangles.begin(), fan.triangles.end());
  }
  return faces;
}

std::vector<BoundaryFace> BoundaryFans::facesFor(NodeId apex) const {
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

std::vector<NodeTriple> BoundaryFans::planes() const {
  std::vector<NodeTriple> planes;
  for (const Fan& fan : fans_) planes.push_back(triangles_[fan.facet.index()]);
  return planes;
}

}  // namespace tetrafront
