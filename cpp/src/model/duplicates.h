#pragma once

/// @file Finds points and lines that were drawn twice.

#include <cstdint>
#include <span>
#include <vector>

#include "model/resolved_model.h"

namespace tetrafront {

/// Per entity: the lowest entity that equals it, which may be itself.
struct Duplicates {
  std::vector<std::uint32_t> points;  ///< with the same position
  std::vector<std::uint32_t> lines;   ///< with the same ends and the same course
};

/// Finds the duplicates. Points that are not finite and unusable lines (one flag per line) equal
/// only themselves. `samePlace` is the distance within which positions count as equal. O(n log n)
/// unless many lines have the same ends and the same midpoint.
[[nodiscard]] Duplicates findDuplicates(const ResolvedModel& model,
                                        std::span<const std::uint8_t> usableLines,
                                        double samePlace);

}  // namespace tetrafront
