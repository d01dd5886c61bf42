#pragma once

/// @file Finds what to change if the sizes require too many elements.

#include "tetrafront/background_grid.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "topology/surface_access.h"

namespace tetrafront {

/// Adds to a diagnostic about too many elements the source, or the node of the background grid,
/// whose size requires the most; nothing if the size of the options or the surface's own edges
/// require more. `bounds`: of the model or surface; only elements within them count. The grid must
/// be valid, and the first value of `tooMany` the number of elements in all. O(sources + tetrahedra
/// of the grid).
void nameMostDemanding(Diagnostic& tooMany, const BackgroundGrid& grid, const MeshOptions& options,
                       const Bounds& bounds);

}  // namespace tetrafront
