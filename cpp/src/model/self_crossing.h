#pragma once

/// @file Does a line cross itself, or run back over itself?

#include <optional>

#include "model/curve.h"

namespace tetrafront {

/// A place where the curve comes back to where it has been, nearer than kSamePassage of its
/// extent; the end of a closed curve, where it meets its start, does not count. Decided on the
/// control points of the curve's cubic pieces, which are halved until the hulls part or are as
/// small as that, so that nothing is missed between samples; but the comparisons have a limit, 50 000
/// and 200 for each piece, after which a line that runs close to itself for long is let pass.
/// O(n log n) in the pieces, for lines that keep apart.
[[nodiscard]] std::optional<Vec3> findSelfCrossing(const Curve& curve);

/// A share of the curve's extent: far above the rounding of its coordinates, far below any element.
inline constexpr double kSamePassage = 1e-9;

}  // namespace tetrafront
