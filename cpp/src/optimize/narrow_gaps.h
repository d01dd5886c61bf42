#pragma once

/// @file Where the boundary leaves no room for nodes.

#include "optimize/tet_complex.h"

namespace tetrafront {

/// Whether an element has all its corners on the boundary and joins two sheets of it between which
/// there is no room for a node, as the quality report sees it. O(elements at its edges).
template <class Space>
[[nodiscard]] bool isInNarrowGap(const TetComplex& complex, TetId tet);

}  // namespace tetrafront
