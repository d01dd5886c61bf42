#include "topology/smooth_triangles.h"

#include <array>
#include <cstddef>
#include <utility>

namespace tetrafront {
namespace {

/// Height below which a triangle counts as a sliver, relative to the largest coordinate: rounding
/// its corners to single precision changes more, so its normal is meaningless.
constexpr double kSliverHeight = 2e-6;
/// The same limit if the triangles around it would join smoothly without it. Text files often have six digits, and
/// rounding to them moves a corner by up to 5e-6 of its coordinate.
constexpr double kSmoothSliverHeight = 1e-5;

/// Sets the neighbours across edges of two triangles of the same orientation.
void linkTriangles(SmoothTriangles& smooth, const SurfaceMesh& mesh, const EdgeTable& edges) {
  smooth.neighbours.assign(mesh.triangles.size(), TriangleId{});
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    const std::span<const HalfEdgeId> on = edges.halfEdgesOf(edge);
    if (on.size() != 2) continue;
    if (nodesOf(mesh.triangles, on[0]).from != nodesOf(mesh.triangles, on[1]).to) continue;
    smooth.neighbours[on[0].index()] = triangleOf(on[1]);
    smooth.neighbours[on[1].index()] = triangleOf(on[0]);
  }
}

/// Returns true if the neighbours across all edges would join smoothly without the triangle.
bool isBetweenSmooth(const SmoothTriangles& smooth, TriangleId t, double creaseCosine) {
  std::array<Vec3, 3> normals;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const TriangleId next = smooth.neighbours[halfEdgeOf(t, k).index()];
    if (next.isNone()) return false;
    normals[k] = smooth.normals[next.index()];
  }
  return glm::dot(normals[0], normals[1]) >= creaseCosine &&
         glm::dot(normals[1], normals[2]) >= creaseCosine &&
         glm::dot(normals[2], normals[0]) >= creaseCosine;
}

/// Two slivers that share their longest edge would follow each other, and neither has a reliable normal. Each then follows
/// the neighbour across the longer of its other edges, or across the shortest if only that one is no sliver.
void separateTwins(const SmoothTriangles& smooth, const SurfaceMesh& mesh,
                   std::vector<TriangleId>& follows) {
  const std::vector<TriangleId> given = follows;
  for (const TriangleId t : IdRange<TriangleId>(given.size())) {
    const TriangleId twin = given[t.index()];
    if (twin.isNone() || given[twin.index()] != t) continue;
    const std::array<Vec3, 3> corners = cornersOf(mesh, t);
    const std::uint32_t k = longestEdgeOf(corners);
    std::array<std::uint32_t, 2> others{(k + 1) % 3, (k + 2) % 3};
    const auto lengthOf = [&](std::uint32_t i) {
      return glm::length(corners[(i + 1) % 3] - corners[i]);
    };
    if (lengthOf(others[1]) > lengthOf(others[0])) std::swap(others[0], others[1]);
    const auto neighbour = [&](std::size_t i) {
      return smooth.neighbours[halfEdgeOf(t, others[i]).index()];
    };
    const auto isKnown = [&](TriangleId other) {
      return !other.isNone() && given[other.index()].isNone();
    };
    follows[t.index()] =
        !isKnown(neighbour(0)) && isKnown(neighbour(1)) ? neighbour(1) : neighbour(0);
  }
}

/// Gives a sliver the normal of the neighbour across its longest edge, which may be a sliver too.
void replaceNormalsOfSlivers(SmoothTriangles& smooth, const SurfaceMesh& mesh, double creaseCosine,
                             double largestCoordinate) {
  std::vector<Vec3>& normals = smooth.normals;
  std::vector<TriangleId> follows(normals.size(), TriangleId{});
  for (const TriangleId t : IdRange<TriangleId>(normals.size())) {
    const std::array<Vec3, 3> corners = cornersOf(mesh, t);
    const std::uint32_t k = longestEdgeOf(corners);
    const double longest = glm::length(corners[(k + 1) % 3] - corners[k]);
    const double area = glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    const double height = area / longest;
    if (height < kSliverHeight * largestCoordinate ||
        (height < kSmoothSliverHeight * largestCoordinate &&
         isBetweenSmooth(smooth, t, creaseCosine))) {
      follows[t.index()] = smooth.neighbours[halfEdgeOf(t, k).index()];
    }
  }
  separateTwins(smooth, mesh, follows);
  for (const TriangleId t : IdRange<TriangleId>(normals.size())) {
    std::vector<TriangleId> chain;
    TriangleId end = t;
    while (!follows[end.index()].isNone() && chain.size() < normals.size()) {
      chain.push_back(end);
      const TriangleId next = follows[end.index()];
      follows[end.index()] = TriangleId{};
      end = next;
    }
    for (const TriangleId link : chain) normals[link.index()] = normals[end.index()];
  }
}

}  // namespace

SmoothTriangles findSmoothTriangles(const SurfaceMesh& mesh, const EdgeTable& edges,
                                    std::span<const std::uint32_t> groups, double creaseCosine,
                                    double largestCoordinate) {
  SmoothTriangles smooth;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const auto [a, b, c] = cornersOf(mesh, t);
    const Vec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    smooth.normals.push_back(length > 0.0 ? normal / length : Vec3(0.0));
  }
  linkTriangles(smooth, mesh, edges);
  replaceNormalsOfSlivers(smooth, mesh, creaseCosine, largestCoordinate);

  smooth.isSharp.assign(edges.edgeCount(), 0);
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    const std::span<const HalfEdgeId> on = edges.halfEdgesOf(edge);
    bool isSharp = true;
    if (!smooth.neighbours[on[0].index()].isNone()) {
      const std::size_t t = triangleOf(on[0]).index();
      const std::size_t u = triangleOf(on[1]).index();
      isSharp = glm::dot(smooth.normals[t], smooth.normals[u]) < creaseCosine ||
                (!groups.empty() && groups[t] != groups[u]);
    }
    if (!isSharp) continue;
    smooth.isSharp[edge.index()] = 1;
    for (const HalfEdgeId halfEdge : on) smooth.neighbours[halfEdge.index()] = TriangleId{};
  }
  return smooth;
}

}  // namespace tetrafront
