#pragma once

/// @file Budgets of work in slices.

#include <cstddef>
#include <cstdint>
#include <limits>

namespace tetrafront {

/// `budget` steps of which each is worth `each` of another kind, > 0; without bounds where the product
/// exceeds what positions can be, which have 32 bits in WebAssembly.
[[nodiscard]] constexpr std::size_t scaledBudget(std::uint32_t budget, std::size_t each) {
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  return budget <= kMost / each ? each * budget : kMost;
}

}  // namespace tetrafront
