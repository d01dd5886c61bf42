#pragma once

/// @file The fans of triangles around the nodes of a surface. At a manifold node, all triangles form one fan. At a
/// non-manifold node, where the surface touches itself, they form several.

#include <cstdint>
#include <span>
#include <vector>

#include "topology/edge_table.h"

namespace tetrafront {

/// Returns the fan of each corner (3t + k is corner k of triangle t), identified by the lowest corner of the fan.
/// Two corners of one node are in the same fan if their triangles are connected over edges of exactly two
/// triangles. `edges` belongs to the triangles. O(n log n), usually O(n).
[[nodiscard]] std::vector<HalfEdgeId> cornerFans(std::span<const std::uint32_t> triangles,
                                                 const EdgeTable& edges);

}  // namespace tetrafront
