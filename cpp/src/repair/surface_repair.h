#pragma once

/// @file Repairs of a given surface that need no guessing: weld nodes, remove and split invalid triangles, fill small
/// holes, orient triangles.

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Makes the requested changes in the order of RepairOptions and lists all of them. `mesh` must outlive the task, which
/// leaves it empty. If coordinates or indices are invalid, the result is the given surface with diagnostics.
/// O(n log n), and O(edges^3) for each attempt to fill a hole.
Task<SurfaceRepair> repairSurface(Work& work, SurfaceMesh& mesh, RepairOptions options);

}  // namespace tetrafront
