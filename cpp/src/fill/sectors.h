#pragma once

/// @file Points at which the inside hangs together by no face.

#include <span>
#include <vector>

#include "fill/fill_mesh.h"

namespace tetrafront {

/// A point where pieces of the inside meet in an edge or at it alone becomes one point for each. Returns the
/// points there are now, by those they came from. O(tetrahedra).
std::vector<NodeId> separateSectors(FillMesh& mesh, std::span<const NodeId> boundaryPoints);

}  // namespace tetrafront
