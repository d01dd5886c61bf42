#pragma once

/// @file What moves with a surface that is remeshed in coordinates about its centre: boundary/centred_surface.h.

#include "tetrafront/background_grid.h"
#include "tetrafront/remesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the grid and its sources, moved with the surface. Its positions are rounded, as sizes may be.
[[nodiscard]] BackgroundGrid relativeTo(const Vec3& centre, const BackgroundGrid& grid);

/// Adds the centre to all positions of a result.
void moveBack(const Vec3& centre, SurfaceRemesh& result);

}  // namespace tetrafront
