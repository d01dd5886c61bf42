#pragma once

/// @file Gaps of the boundary that are too narrow for nodes.

#include "optimize/tet_complex.h"

namespace tetrafront {

/// Returns whether all corners of an element lie on the boundary and it connects two pieces of it
/// that are too close for a node between them, as in the quality report. O(elements at its edges).
template <class Space>
[[nodiscard]] bool isInNarrowGap(const TetComplex& complex, TetId tet);

}  // namespace tetrafront
