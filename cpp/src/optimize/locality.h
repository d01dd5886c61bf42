#pragma once

/// @file Puts elements that are close in space close in memory: the optimizer's sweeps spend most
/// of their time waiting for elements next to the current one.

#include "base/task.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

/// Orders the elements along a Morton curve and the nodes as the elements use them; leaves out nodes that no element uses. The
/// nodes of the boundary keep their indices. Until the task ends, the mesh keeps its order. O(n).
Task<> orderAlongMortonCurve(Work& work, TetMesh& mesh);

}  // namespace tetrafront
