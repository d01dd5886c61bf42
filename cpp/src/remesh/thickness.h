#pragma once

/// @file Thickness of a body: the distance from its surface, along the inward normal, to where this line leaves the body.

#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the distance from a position on the surface to the opposite side of the body, in the unit vector `inward`; infinity
/// if it is not below `limit`. O(log n) for n triangles, unless the ray grazes very many of them.
double findThickness(const ReferenceSurface& reference, const Vec3& position, const Vec3& inward,
                     double limit);

}  // namespace tetrafront
