#pragma once

/// @file Proves that every point of a triangle, not only a sample of points, is near a patch of the
/// reference surface.

#include <array>
#include <span>

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// What the proof of a triangle has found.
struct EnvelopeProof {
  bool isProven = false;
  PatchFacetId over{};  ///< the facet over which the whole triangle is known to lie, or none
};

/// Tries to prove that every point of the triangle is within `tolerance` of the
/// curved patch. Divides the triangle until each part is proven in one of two ways:
///   - all its corners are near one triangle of the patch (the distance to a convex set is largest at
///     a corner);
///   - it lies over one facet, except for points near an edge of the facet; if the part extends too
///     far beyond an edge, it is cut there.
/// Fails if this needs too many parts. `below`: the point of the patch nearest to the centroid.
[[nodiscard]] EnvelopeProof proveWithin(const ReferenceSurface& reference,
                                        const std::array<Vec3, 3>& corners, SmoothPatchId patch,
                                        double tolerance, const NearestPoint& below);

/// Returns true if every point of a convex polygon that lies over the facet is within `tolerance` of it.
[[nodiscard]] bool isNearFacet(const Facet& facet, std::span<const Vec3> corners, double tolerance);

}  // namespace tetrafront
