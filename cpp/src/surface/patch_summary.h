#pragma once

/// @file How good one patch's triangulation is, for the report.

#include <cstdint>

#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Measures a complete triangulation of patch number `patch`. O(triangles), five places of the
/// surface evaluated for every two triangles.
[[nodiscard]] PatchSummary summarizePatch(const PatchMetric& metric, const PlanarMesh& mesh,
                                          std::uint32_t patch);

}  // namespace tetrafront
