#pragma once

/// @file Statistics of one patch's triangulation, for the report.

#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Measures a complete triangulation of `patch`. O(triangles); evaluates the surface about five times for every
/// two triangles.
[[nodiscard]] PatchSummary summarizePatch(const PatchMetric& metric, const PlanarMesh& mesh,
                                          PatchId patch);

}  // namespace tetrafront
