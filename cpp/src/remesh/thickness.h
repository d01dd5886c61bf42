#pragma once

/// @file Thickness of a region: the distance from its surface, along the inward normal, to where this ray leaves the region.

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Smallest cosine of the angle between a ray and the outward normal where it leaves the region: through faces that it grazes more,
/// it does not measure a distance between faces.
inline constexpr double kMinFacing = 0.5;

struct Thickness {
  double distance;      ///< infinity if it is not below the limit
  TriangleId across{};  ///< the triangle on the opposite side; none if the distance is infinite
};

/// Returns the distance from a position on the surface to the opposite surface of the region, along the unit vector `inward`,
/// if it is below `limit`. `reference` must be prepared. O(log n) for n triangles, unless the ray grazes very many of them.
[[nodiscard]] Thickness findThickness(const ReferenceSurface& reference, const Vec3& position,
                                      const Vec3& inward, double limit);

}  // namespace tetrafront
