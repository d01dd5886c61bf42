#pragma once

/// @file What was made along walls.

#include <span>

#include "base/task.h"
#include "tetrafront/wall_layers.h"

namespace tetrafront {

/// Measures the elements of an adaptation and those at the walls. O(n log n).
Task<> describeLayers(Work& work, std::span<const PatchLayers> walls, LayeredMesh& made);

}  // namespace tetrafront
