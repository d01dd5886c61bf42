#pragma once

/// @file Statistics of the current mesh that steer the optimizer. All cost O(elements).

#include <cstddef>
#include <cstdint>

#include "optimize/tet_complex.h"

namespace tetrafront {

/// Returns the mean of the elements' stored costs.
[[nodiscard]] double meanCostOf(const TetComplex& complex);

/// Returns the mean relative edge length over a sample of the elements.
template <class Space>
[[nodiscard]] double meanEdgeOf(const TetComplex& complex);

/// Returns the number of elements that changed in this pass or a later one.
[[nodiscard]] std::size_t changedSince(const TetComplex& complex, std::uint32_t pass);

}  // namespace tetrafront
