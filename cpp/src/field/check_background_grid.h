#pragma once

/// @file Checks a background grid and its sources before a run uses them.

#include <cstdint>
#include <vector>

#include "base/task.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// The part of a background grid that is checked.
enum class GridPart : std::uint8_t { kWhole, kSources };

/// Finds all problems of a background grid and its sources; none if it can be used. O(n) if few tetrahedra share a
/// node. `grid` must outlive the task.
[[nodiscard]] Task<std::vector<Diagnostic>> checkBackgroundGrid(Work& work,
                                                                const BackgroundGrid& grid,
                                                                GridPart part = GridPart::kWhole);

/// Checks the whole grid in one call.
[[nodiscard]] std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid);

}  // namespace tetrafront
