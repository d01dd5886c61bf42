#pragma once

/// @file The fans of triangles around the nodes of a surface: at a plain node all triangles are in
/// one, at a pinched node the surface touches itself and there are more.

#include <cstdint>
#include <span>
#include <vector>

#include "boundary/edge_table.h"

namespace tetrafront {

/// A number per corner (3t + k is corner k of triangle t): equal for corners of one node whose
/// triangles are connected over edges of exactly two triangles. It is the fan's lowest corner.
/// `edges` belongs to the triangles. O(n log n), seldom more than O(n).
[[nodiscard]] std::vector<std::uint32_t> cornerFans(std::span<const std::uint32_t> triangles,
                                                    const EdgeTable& edges);

}  // namespace tetrafront
