#pragma once

/// @file Removes slivers, which are triangles with collinear corners, without changing the shape of the surface.

#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns whether the corners of the triangle are collinear. Exact.
[[nodiscard]] bool isSliver(const SurfaceMesh& mesh, TriangleId triangle);

/// The sliver and `other` are now the halves of `other`, split at the node `middle` on its edge.
struct SliverSplit {
  TriangleId sliver;
  TriangleId other;
  NodeId middle;
};

/// Splits the triangle beyond the longest edge of a sliver at the sliver's middle corner; the halves replace both
/// triangles. Slivers next to other slivers follow once these are gone. A sliver remains if two of its corners have
/// equal positions, or if its longest edge does not have exactly one other triangle. Triangles with a repeated node
/// must be removed first. Returns the splits in the order in which they were made. O(n log s) for s slivers.
std::vector<SliverSplit> splitBesideSlivers(SurfaceMesh& mesh);

}  // namespace tetrafront
