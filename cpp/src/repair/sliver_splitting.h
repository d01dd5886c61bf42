#pragma once

/// @file Triangles whose corners lie on one line, dissolved without changing the shape.

#include <cstdint>
#include <vector>

#include "tetrafront/mesh.h"

namespace tetrafront {

/// True if the triangle's corners lie on one line. Exact.
[[nodiscard]] bool isSliver(const SurfaceMesh& mesh, std::uint32_t triangle);

/// Both triangles now are halves of `other`, divided where the node `middle` lies on its edge.
struct SliverSplit {
  std::uint32_t sliver = 0;
  std::uint32_t other = 0;
  std::uint32_t middle = 0;
};

/// Takes slivers away together with the triangles beyond their longest edges: these are split at the
/// slivers' middle corners, and the halves take both places. Slivers beside others follow once these
/// are gone; what remains has two corners at one place, or a longest edge without just one other
/// triangle. The splits, in the order in which they were made. Triangles with a repeated node must be
/// gone. O(n log s) for s slivers.
std::vector<SliverSplit> splitBesideSlivers(SurfaceMesh& mesh);

}  // namespace tetrafront
