#pragma once

/// @file Builds a GridLocator in slices.

#include "base/task.h"
#include "field/grid_locator.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Parameters as of GridLocator; the grid must outlive the task. A unit of budget visits about eight tetrahedra. Each
/// is visited some tens of times.
[[nodiscard]] Task<GridLocator> buildGridLocator(Work& work, const BackgroundGrid& grid,
                                                 double growth = 0.0);

}  // namespace tetrafront
