#pragma once

/// @file What moves with a surface that is remeshed in coordinates about its centre: boundary/centred_surface.h.

#include "tetrafront/background_grid.h"
#include "tetrafront/remesh.h"
#include "tetrafront/trimmed_model.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the grid and its sources, moved with the surface. Its positions are rounded, as sizes may be.
[[nodiscard]] BackgroundGrid relativeTo(const Vec3& centre, const BackgroundGrid& grid);

/// Returns the model, moved with the surface. Its positions are rounded, by far less than the distance between edges and faces
/// in files.
[[nodiscard]] TrimmedModel relativeTo(const Vec3& centre, TrimmedModel model);

/// Adds the centre to all positions of a result.
void moveBack(const Vec3& centre, SurfaceRemesh& result);

}  // namespace tetrafront
