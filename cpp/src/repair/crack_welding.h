#pragma once

/// @file Closes cracks of a surface: open edges beside each other whose nodes nearly coincide.

#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns for each node the node that it is welded to, or the node itself; empty if nothing is welded. Welds nodes of open edges only, within the
/// distance that leaves the fewest open edges; of those, within the smallest. Distances are powers of ten
/// from 1e-9 to 1e-4 times the diagonal of the surface. `mesh` must outlive the task. O(n log n).
Task<std::vector<NodeId>> weldCracks(Work& work, const SurfaceMesh& mesh);

}  // namespace tetrafront
