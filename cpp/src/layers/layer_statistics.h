#pragma once

/// @file What was made along walls.

#include <span>

#include "tetrafront/wall_layers.h"

namespace tetrafront {

/// Measures the elements of an adaptation and those at the walls.
void describeLayers(std::span<const PatchLayers> walls, LayeredMesh& made);

}  // namespace tetrafront
