#pragma once

/// @file Checks whether a line intersects itself or runs back over itself.

#include <optional>

#include "model/curve.h"

namespace tetrafront {

/// Returns a position at which the curve returns to itself within Tolerance::kCoincidence, relative to
/// its extent; the common end of a closed curve does not count. The test halves the control polygons of
/// the curve's cubic pieces until their hulls are disjoint or that small, so nothing between
/// samples is missed. It makes at most 50 000 comparisons and 200 per piece; a line that runs close
/// to itself for longer passes. O(n log n) in the pieces, for lines without near contacts.
[[nodiscard]] std::optional<Vec3> findSelfCrossing(const Curve& curve);

}  // namespace tetrafront
