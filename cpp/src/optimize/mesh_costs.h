#pragma once

/// @file Figures of the mesh as it stands, by which the optimizer finds its way. All are O(elements).

#include <cstddef>
#include <cstdint>

#include "optimize/tet_complex.h"

namespace tetrafront {

/// Mean cost of the elements, as last computed.
[[nodiscard]] double meanCostOf(const TetComplex& complex);

/// Mean length of edges, by wanted lengths, of one element in so many.
template <class Space>
[[nodiscard]] double meanEdgeOf(const TetComplex& complex);

/// How many elements have changed in this pass or a later one.
[[nodiscard]] std::size_t changedSince(const TetComplex& complex, std::uint32_t pass);

}  // namespace tetrafront
