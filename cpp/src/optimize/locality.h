#pragma once

/// @file Puts elements that are close in space close in memory: the optimizer's sweeps spend most
/// of their time waiting for elements next to the current one.

#include <cstddef>

#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns the same mesh with its elements along a Morton curve and its nodes in the order in which
/// the elements use them. The first `boundaryNodes` nodes keep their indices. The mesh must outlive the task. O(n).
Task<VolumeMesh> alongMortonCurve(Work& work, const VolumeMesh& mesh, std::size_t boundaryNodes);

}  // namespace tetrafront
