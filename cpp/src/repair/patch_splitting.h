#pragma once

/// @file Splits a surface into patches at its sharp edges, and orders them by position.

#include <cstdint>
#include <span>

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Makes a patch of each set of triangles that are in one group and joined by edges that are not sharp. A line of sharp
/// edges that ends within a smooth face separates nothing. `angle`: largest angle of a smooth edge between the normals of
/// its triangles, in degrees. Everything must outlive the task. O(n log n).
Task<PatchSplit> splitPatches(Work& work, const SurfaceMesh& mesh,
                              std::span<const std::uint32_t> groups, double angle);

}  // namespace tetrafront
