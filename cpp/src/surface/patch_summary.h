#pragma once

/// @file Statistics of the triangulation of patches, for the report.

#include <cstdint>
#include <vector>

#include "field/size_field.h"
#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Measures a complete triangulation of `patch`. O(triangles); evaluates the surface about five times for every
/// two triangles.
[[nodiscard]] PatchSummary summarizePatch(const PatchMetric& metric, const PlanarMesh& mesh,
                                          PatchId patch);

/// Measures the triangles of all patches from `first` to `end`, which are given: their deviation is 0. O(triangles).
[[nodiscard]] std::vector<PatchSummary> summarizeGivenPatches(const SurfaceMesh& surface,
                                                              const SizeField& field,
                                                              std::uint32_t first,
                                                              std::uint32_t end);

}  // namespace tetrafront
