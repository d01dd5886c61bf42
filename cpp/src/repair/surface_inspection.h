#pragma once

/// @file Inspects a given surface with the checks that a run begins with.

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Inspects the surface, which must outlive the task. The boundary check orients a valid `mesh` outward; the result
/// counts the triangles that it flipped. O(n log n) if triangles have few others near them.
Task<SurfaceInspection> inspectSurface(Work& work, SurfaceMesh& mesh, InspectionOptions options);

}  // namespace tetrafront
