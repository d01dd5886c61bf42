#pragma once

/// @file Finds points and lines that were drawn twice.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/tolerance.h"
#include "model/resolved_model.h"

namespace tetrafront {

/// Per entity: the lowest entity that equals it, which may be itself.
struct Duplicates {
  std::vector<PointId> points;  ///< with the same position
  std::vector<LineId> lines;    ///< with the same ends and the same course
};

/// Finds the duplicates. Points that are not finite and unusable lines (one flag per line) equal
/// only themselves. `tolerance` is relative to the model: positions within its rounding() are equal. O(n log n)
/// unless many lines have the same ends and the same midpoint.
[[nodiscard]] Duplicates findDuplicates(const ResolvedModel& model,
                                        std::span<const std::uint8_t> usableLines,
                                        const Tolerance& tolerance);

}  // namespace tetrafront
