#pragma once

/// @file Finds what to change if the sizes require too many elements.

#include <optional>

#include "tetrafront/background_grid.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Returns the source, or the node of the background grid, whose size requires the most elements; none if the size of
/// the options or the surface's own edges require more. `extent`: diagonal of the box around the model or surface;
/// `expected`: number of elements in all. The grid must be valid. The estimate counts the whole surroundings of a source
/// or node, also where nothing is meshed. O(sources + tetrahedra of the grid).
[[nodiscard]] std::optional<Entity> mostDemandingSize(const BackgroundGrid& grid,
                                                      const MeshOptions& options, double extent,
                                                      double expected);

}  // namespace tetrafront
