#pragma once

/// @file Removes triangles that are so low that their middle corner nearly lies on the opposite edge. Welding nodes leaves them
/// where a node of one face meets an edge of another: rounded, it is beside the edge.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

struct LowTriangles {
  std::vector<TriangleId>
      parents;  ///< per triangle of the result, ascending: the triangle that it is or was a part of
  double deviation =
      0.0;  ///< upper bound of the distance that the surface has moved, in model units
};

/// Removes the triangles whose height above their longest edge is at most `height`, in model units. All others at this edge
/// are split at the opposite corner, so that a closed surface stays closed; new triangles may intersect others. No node moves.
/// `mayChange`: per node; triangles with three such nodes are removed. Triangles must not have a node twice. O(n) for n
/// triangles, for each of a few passes.
/// Both must outlive the task.
Task<LowTriangles> removeLowTriangles(Work& work, SurfaceMesh& mesh, double height,
                                      std::span<const std::uint8_t> mayChange);

}  // namespace tetrafront
