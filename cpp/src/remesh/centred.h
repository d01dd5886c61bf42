#pragma once

/// @file Coordinates about the centre of a surface that is far from the origin. Distances, normals and planes computed there
/// lose no digits to the distance, and trees of boxes need no margin for it.

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/remesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Moves the nodes of a surface that is far from the origin, and returns the position that is the new origin; moves nothing
/// and returns 0 for another one. Every node stays exact: the centre added to it gives the same number again.
Vec3 moveToCentre(SurfaceMesh& mesh);

/// Returns the grid and its sources, moved with the surface. Its positions are rounded, as sizes may be.
[[nodiscard]] BackgroundGrid relativeTo(const Vec3& centre, const BackgroundGrid& grid);

/// Adds the centre to all positions of a result.
void moveBack(const Vec3& centre, SurfaceRemesh& result);

}  // namespace tetrafront
