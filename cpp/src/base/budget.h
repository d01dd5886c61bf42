#pragma once

/// @file Budgets of work that is done in slices. One unit is one face taken from the front, or work that takes
/// about as long.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// Returns `budget` x `stepsPerUnit` (> 0), or the largest std::size_t if the product exceeds it: std::size_t
/// has 32 bits in WebAssembly.
[[nodiscard]] constexpr std::size_t scaledBudget(std::uint32_t budget, std::size_t stepsPerUnit) {
  constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();
  return budget <= kUnlimited / stepsPerUnit ? stepsPerUnit * budget : kUnlimited;
}

}  // namespace tetrafront
