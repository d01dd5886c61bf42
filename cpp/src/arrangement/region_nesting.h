#pragma once

/// @file Regions of a surface whose components lie inside one another.

#include <vector>

#include "arrangement/part_shells.h"
#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Gives the lowest region around each component of a surface what lies in several regions, and removes the triangles that then have
/// one region on both sides. `mesh`: with triangleRegions, each component consistent on its own; no two triangles intersect. `origin`: per triangle, anything.
/// Returns what regions share with those around their component. O(n log n), and O(triangles near a ray) per component.
[[nodiscard]] std::vector<SharedCell> nestRegions(SurfaceMesh& mesh,
                                                  std::vector<TriangleId>& origin);

}  // namespace tetrafront
