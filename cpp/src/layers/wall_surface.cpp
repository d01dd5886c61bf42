#include "layers/wall_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/sort.h"
#include "geom/measure.h"
#include "topology/mesh_access.h"
#include "topology/smooth_triangles.h"

namespace tetrafront {
namespace {

/// Cosine of the smallest angle between triangles at a sharp edge, as for the adaptation.
constexpr double kSharpCosine = 0.766;

/// Barycentric weight below which a point counts as on the opposite edge.
constexpr double kOnEdge = 1e-9;

/// Relative difference of squared distances that rounding cannot make.
constexpr double kNearerBy = 1e-9;

double largestCoordinateOf(const SurfaceMesh& mesh) {
  double largest = 0.0;
  for (const double x : mesh.points) largest = std::max(largest, std::fabs(x));
  return largest;
}

/// Returns the weights of the corners of a triangle at one of its points.
std::array<double, 3> weightsAt(const std::array<Vec3, 3>& corners, const Vec3& at) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  if (!(square > 0.0)) return {1.0, 0.0, 0.0};
  const double v = glm::dot(glm::cross(c - b, at - b), normal) / square;
  const double w = glm::dot(glm::cross(a - c, at - c), normal) / square;
  return {v, w, 1.0 - v - w};
}

}  // namespace

WallSurface::WallSurface(const SurfaceMesh& boundary, std::span<const std::uint8_t> isWall)
    : boundary_(boundary), wallsAt_(countNodes(boundary)) {
  const std::size_t count = countTriangles(boundary);
  const EdgeTable edges(boundary.triangles, countNodes(boundary), {});
  const std::vector<std::uint32_t> sides(isWall.begin(), isWall.end());
  SmoothTriangles smooth =
      findSmoothTriangles(boundary, edges, sides, kSharpCosine, largestCoordinateOf(boundary));
  triangleNormals_ = std::move(smooth.normals);
  neighbours_ = std::move(smooth.neighbours);
  frames_.reserve(count);
  for (const TriangleId t : IdRange<TriangleId>(count))
    frames_.emplace_back(cornersOf(boundary, t));
  const auto forEachWall = [&](auto visit) {
    for (const TriangleId t : IdRange<TriangleId>(count)) {
      if (isWall[t.index()] == 0) continue;
      for (const NodeId node : nodesOf(boundary, t)) visit(node, t);
    }
  };
  forEachWall([this](NodeId node, TriangleId /*t*/) { wallsAt_.count(node); });
  wallsAt_.endCounting();
  forEachWall([this](NodeId node, TriangleId t) { wallsAt_.add(node, t); });
  nodeOf_.assign(3 * count, kNoIndex);
  forEachSmoothPatch(neighbours_, [&](std::span<const TriangleId> members) {
    if (isWall[members[0].index()] == 0) return;
    Group group;
    group.triangles.assign(members.begin(), members.end());
    std::vector<Box> boxes;
    for (const TriangleId t : members) {
      const auto [a, b, c] = cornersOf(boundary_, t);
      boxes.push_back(Box::of(a, b, c));
    }
    group.box = boxes[0];
    for (const Box& box : boxes) group.box.include(box);
    group.tree = BoxTree(boxes);
    groups_.push_back(std::move(group));
    findNormalsAndCurvatures(members);
  });
}

void WallSurface::GroupNode::addEdge(const Vec3& along, const Vec3& beyond) {
  const double turn = glm::dot(edge, along);
  isOnCorner = isOnCorner || (isOnEdge && std::fabs(turn) < kSharpCosine * glm::length(edge));
  edge += turn < 0.0 ? -along : along;
  outward += beyond;
  isOnEdge = true;
}

void WallSurface::GroupNode::finish() {
  normal = unitOf(normal);
  if (area > 0.0) curvature = curvature.scaledBy(1.0 / area);
  edge = unitOf(edge);
  outward = unitOf(outward);
}

void WallSurface::findNormalsAndCurvatures(std::span<const TriangleId> members) {
  std::vector<std::uint32_t> own;
  for (const TriangleId t : members)
    for (const NodeId node : nodesOf(boundary_, t)) own.push_back(node.value);
  sortUnique(own);
  const std::size_t first = nodes_.size();
  nodes_.resize(first + own.size());
  for (const TriangleId t : members) {
    const NodeTriple corners = nodesOf(boundary_, t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = std::ranges::lower_bound(own, corners[k].value) - own.begin();
      nodeOf_[3 * t.index() + k] = static_cast<std::uint32_t>(first + static_cast<std::size_t>(at));
    }
  }
  for (const TriangleId t : members) {
    const std::array<Vec3, 3> corners = cornersOf(boundary_, t);
    const Vec3& normal = triangleNormals_[t.index()];
    const double area =
        0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const SymmetricTensor bend = bendOf(t);
    const std::uint32_t* const nodeOf = &nodeOf_[3 * t.index()];
    for (std::uint32_t k = 0; k < 3; ++k) {
      GroupNode& node = nodes_[nodeOf[k]];
      node.normal += area * normal;
      node.curvature.accumulate(bend, 1.0);
      node.area += area;
      if (!neighbours_[halfEdgeOf(t, k).index()].isNone()) continue;
      const Vec3 along = unitOf(corners[(k + 1) % 3] - corners[k]);
      node.addEdge(along, glm::cross(along, normal));
      nodes_[nodeOf[(k + 1) % 3]].addEdge(along, glm::cross(along, normal));
    }
  }
  for (std::size_t i = first; i < nodes_.size(); ++i) nodes_[i].finish();
}

/// Returns the curvature of a triangle times its area: an edge that bends by an angle over its length bends the surface across it
/// (Cohen-Steiner & Morvan 2003). Half of each edge counts.
SymmetricTensor WallSurface::bendOf(TriangleId triangle) const {
  const std::array<Vec3, 3> corners = cornersOf(boundary_, triangle);
  const Vec3& normal = triangleNormals_[triangle.index()];
  SymmetricTensor bend = SymmetricTensor::isotropic(0.0);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId next = neighbours_[halfEdgeOf(triangle, k).index()];
    if (next.isNone()) continue;
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    const Vec3 turn = triangleNormals_[next.index()] - normal;
    const Vec3 across = glm::cross(unitOf(edge), normal);
    // `across` points out of the triangle: where a wall bulges into the mesh, its outward normal turns the other way.
    const double angle = glm::dot(turn, across) < 0.0 ? glm::length(turn) : -glm::length(turn);
    bend.accumulate(squareOf(across), 0.5 * angle * glm::length(edge));
  }
  return bend;
}

bool WallSurface::nearest(std::size_t groupIndex, const Vec3& position, double limit,
                          WallPoint& found) const {
  const Group& group = groups_[groupIndex];
  double squared = limit * limit;
  if (group.box.squaredDistance(position) >= squared) return false;
  found = {};
  // Equal distances are those of a common edge: the lowest triangle counts.
  double searched = squared * (1.0 + kNearerBy);
  group.tree.visitNear(position, searched, [&](std::uint32_t item) {
    const TriangleId t = group.triangles[item];
    const double own = frames_[t.index()].squaredDistance(position);
    if (own > squared || (own == squared && !found.triangle.isNone() && t > found.triangle)) return;
    squared = own;
    searched = std::max(own * (1.0 + kNearerBy), std::numeric_limits<double>::min());
    found.triangle = t;
  });
  if (found.triangle.isNone()) return false;
  const TriangleFrame& frame = frames_[found.triangle.index()];
  found.distance = std::sqrt(squared);
  found.position = frame.nearestPoint(position, frame.measure(position));
  describe(weightsAt(cornersOf(boundary_, found.triangle), found.position), found);
  return true;
}

void WallSurface::describe(const std::array<double, 3>& weights, WallPoint& found) const {
  const std::size_t first = 3 * found.triangle.index();
  const std::array<Vec3, 3> corners = cornersOf(boundary_, found.triangle);
  found.curvature = SymmetricTensor::isotropic(0.0);
  const GroupNode* nearCorner = nullptr;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const GroupNode& node = nodes_[nodeOf_[first + k]];
    found.normal += weights[k] * node.normal;
    found.curvature.accumulate(node.curvature, weights[k]);
    if (weights[k] > 1.0 - kOnEdge) nearCorner = &node;
    const HalfEdgeId opposite = halfEdgeOf(found.triangle, (k + 1) % 3);
    if (weights[k] > kOnEdge || !neighbours_[opposite.index()].isNone()) continue;
    found.isOnEdge = true;
    found.edge = unitOf(corners[(k + 2) % 3] - corners[(k + 1) % 3]);
    found.outward = glm::cross(found.edge, triangleNormals_[found.triangle.index()]);
  }
  found.normal = unitOf(found.normal);
  if (nearCorner == nullptr || !nearCorner->isOnEdge) return;
  found.isOnEdge = true;
  found.isOnCorner = nearCorner->isOnCorner;
  found.edge = nearCorner->edge;
  found.outward = nearCorner->outward;
}

bool WallSurface::isNearestAround(const WallPoint& found, const Vec3& position) const {
  if (!found.isOnEdge || !(found.distance > 0.0)) return true;
  const double limit = found.distance * found.distance * (1.0 - kNearerBy);
  for (const NodeId node : nodesOf(boundary_, found.triangle)) {
    for (const TriangleId t : wallsAt_.at(node)) {
      if (frames_[t.index()].squaredDistance(position) < limit) return false;
    }
  }
  return true;
}

}  // namespace tetrafront
