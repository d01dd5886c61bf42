#pragma once

/// @file Checks of what an adaptation is given.

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh_adaptation.h"

namespace tetrafront {

/// Returns whether array lengths, indices, coordinates and metrics are valid, and there is an element.
[[nodiscard]] bool isUsable(const AdaptInput& mesh);
[[nodiscard]] bool isUsable(const MetricMesh& background);
[[nodiscard]] bool isUsable(const AdaptOptions& options);

/// Returns a mesh as a grid that only locates positions.
[[nodiscard]] BackgroundGrid locatorGridOf(const MetricMesh& mesh);

}  // namespace tetrafront
