#pragma once

/// @file Proves that a triangle is near a patch of the reference surface: everywhere, not only at samples.

#include <array>

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns true if every point of the triangle is proven to be within `tolerance` of the curved patch. The triangle is
/// divided until each part is proven in one of two ways:
///   - all its corners are near one triangle of the patch: the distance to a convex set is largest at a corner;
///   - it lies over one facet, but for what is near an edge of the facet. Where it reaches further, it is cut there.
/// Returns false also if that takes too many parts. `hint`: as of nearest().
[[nodiscard]] bool isWithin(const ReferenceSurface& reference, const std::array<Vec3, 3>& corners,
                            SmoothPatchId patch, double tolerance, TriangleId hint);

}  // namespace tetrafront
