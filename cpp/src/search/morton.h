#pragma once

/// @file Orders positions along a Morton curve: neighbours in this order are mostly neighbours in
/// space.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the indices of `positions` in the order of the curve; positions in one cell keep their
/// order. A radix sort, O(n): visits each position eleven times. `positions` must outlive the task.
Task<std::vector<std::uint32_t>> mortonOrder(Work& work, std::span<const Vec3> positions,
                                             std::size_t visitsPerUnit);

/// The same in one call.
[[nodiscard]] std::vector<std::uint32_t> mortonOrder(std::span<const Vec3> positions);

}  // namespace tetrafront
