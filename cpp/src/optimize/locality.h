#pragma once

/// @file Elements that are near each other in space, near each other in memory: the sweeps of the
/// optimizer spend most of their time waiting for elements next to the one at hand.

#include <cstddef>

#include "tetrafront/mesh.h"

namespace tetrafront {

/// The same mesh with its elements along a Morton curve and its nodes in the order in which the
/// elements name them; the first `boundaryNodes` nodes stay. O(n log n).
[[nodiscard]] VolumeMesh alongMortonCurve(const VolumeMesh& mesh, std::size_t boundaryNodes);

}  // namespace tetrafront
