#pragma once

/// @file Refines a given surface until its triangles fit the target sizes.

#include "base/task.h"
#include "sizing/region_sizes.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Bisects the edges of the surface that are too long (edge_bisection.h). Everything must outlive the task, which
/// changes `mesh` and moves it into the result. `regions`: sizes of the given triangles. `volume`: enclosed volume, from which
/// the task estimates the number of tetrahedra, without the sizes of regions, before it changes anything; 0 if unknown. O(n log n) for n triangles of the result.
Task<SurfaceRefinement> refineSurface(Work& work, SurfaceMesh& mesh, const BackgroundGrid& grid,
                                      const MeshOptions& options, const RegionSizes& regions,
                                      double volume);

}  // namespace tetrafront
