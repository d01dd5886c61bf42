#pragma once

/// @file Nodes that are near enough to be one.

#include <cstdint>
#include <span>
#include <vector>

namespace tetrafront {

/// Per node (x y z in `points`, finite): the node it becomes, itself or one of a lower number no
/// further than `distance` away (>= 0; 0: at the same place) that stays what it is. Taken in
/// ascending order, the lowest such node is chosen: chains do not collapse into one node.
/// O(n log n): few nodes that stay are near each other.
[[nodiscard]] std::vector<std::uint32_t> weldedNodes(std::span<const double> points,
                                                     double distance);

}  // namespace tetrafront
