#pragma once

/// @file Prepares a damaged surface for encloseSurface(): agreeing orientation, and triangles over its holes, which may intersect
/// others.

#include <vector>

#include "repair/hole_filling.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Makes the triangles of each patch agree in orientation with most of its area; a patch is connected over edges of two triangles. Then
/// closes the holes of each component, unless the new triangles would have more than 0.8 times its area: such a component is a
/// sheet rather than a body with holes. At last flips the components that face inward, except those inside
/// another one. Appends the new triangles to `mesh`, and for long rims a node, and returns the closed holes. There must be no degenerate triangles and
/// no two used nodes at one position. O(n log n), and O(edges^3) for a hole of up to 400 edges.
std::vector<FilledHole> closeSurface(SurfaceMesh& mesh);

}  // namespace tetrafront
