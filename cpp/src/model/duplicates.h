#pragma once

/// @file Points and lines that were drawn twice.

#include <cstdint>
#include <span>
#include <vector>

#include "model/resolved_model.h"

namespace tetrafront {

/// Per entity the lowest one that is the same: itself where there is none before it.
struct Duplicates {
  std::vector<std::uint32_t> points;  ///< at one place
  std::vector<std::uint32_t> lines;   ///< between the same places, along the same course
};

/// Points that are not finite and lines that are not sound (one flag per line) are alone.
/// `samePlace`: the distance within which places are one. O(n log n) unless many lines join the
/// same two places and have one middle.
[[nodiscard]] Duplicates findDuplicates(const ResolvedModel& model,
                                        std::span<const std::uint8_t> usableLines,
                                        double samePlace);

}  // namespace tetrafront
