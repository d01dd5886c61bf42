#pragma once

/// @file Finds the nodes that are close enough to be merged.

#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"

namespace tetrafront {

/// Returns for each node the node that it is welded to, or the node itself. Nodes are visited in ascending order.
/// Each is welded to the lowest kept node within `distance`, which is kept itself; a chain therefore does not collapse
/// into one node. `points`: finite coordinates x y z of each node; they must outlive the task. `distance` >= 0;
/// 0 welds nodes with equal positions. O(n log n) unless many kept nodes are close to each other.
Task<std::vector<NodeId>> findWeldTargets(Work& work, std::span<const double> points,
                                          double distance);

}  // namespace tetrafront
