#pragma once

/// @file An order of places along a Morton curve: neighbours in it are mostly neighbours in space.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Positions in `places` along the curve; places of one cell in the order of their positions.
/// O(n log n).
[[nodiscard]] std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> places);

}  // namespace tetrafront
