#pragma once

/// @file The surface of a mesh that did not come with one.

#include "tetrafront/mesh.h"

namespace tetrafront {

/// The faces that only one tetrahedron has, counter-clockwise seen from outside where elements are
/// positively turned, in the order of their elements; trianglePatch holds their regions. `points`
/// stays empty. Indices must be in range. O(n log n).
[[nodiscard]] SurfaceMesh boundaryOf(const VolumeMesh& mesh);

}  // namespace tetrafront
