#pragma once

/// @file The sharp edges of a surface, and the patches of triangles that all its other edges join.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/edge_table.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// Triangles and their neighbours across smooth edges.
struct SmoothTriangles {
  /// Unit normal per triangle; that of a neighbour if the triangle is flatter than the rounding of its corners.
  std::vector<Vec3> normals;
  /// Per half-edge: the triangle across it; none at a sharp edge.
  std::vector<TriangleId> neighbours;
  /// Per edge of the table. An edge is sharp if the cosine of the angle between the normals of its two triangles is
  /// smaller than a limit, if these are in different groups, or if it does not have two triangles of the same
  /// orientation.
  std::vector<std::uint8_t> isSharp;
};

/// Finds the sharp edges. `groups`: a number per triangle, or empty. `largestCoordinate`: of all nodes, by magnitude. O(n).
[[nodiscard]] SmoothTriangles findSmoothTriangles(const SurfaceMesh& mesh, const EdgeTable& edges,
                                                  std::span<const std::uint32_t> groups,
                                                  double creaseCosine, double largestCoordinate);

/// Calls visit(members) for each set of triangles that smooth edges join, in the order of their lowest triangles.
/// `neighbours`: as in SmoothTriangles.
template <class Visit>
void forEachSmoothPatch(std::span<const TriangleId> neighbours, Visit visit) {
  std::vector<std::uint8_t> isVisited(neighbours.size() / 3, 0);
  std::vector<TriangleId> members;
  for (const TriangleId seed : IdRange<TriangleId>(isVisited.size())) {
    if (isVisited[seed.index()] != 0) continue;
    isVisited[seed.index()] = 1;
    members.assign(1, seed);
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const TriangleId next = neighbours[halfEdgeOf(members[i], k).index()];
        if (next.isNone() || isVisited[next.index()] != 0) continue;
        isVisited[next.index()] = 1;
        members.push_back(next);
      }
    }
    visit(std::span<const TriangleId>(members));
  }
}

}  // namespace tetrafront
