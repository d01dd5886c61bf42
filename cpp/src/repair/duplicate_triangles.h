#pragma once

/// @file Triangles with the same nodes as another one, in any order.

#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Returns for each triangle the first one with the same nodes, or none if it is the first one itself. O(n log n) for n triangles.
[[nodiscard]] std::vector<TriangleId> findDuplicateTriangles(const SurfaceMesh& mesh);

}  // namespace tetrafront
