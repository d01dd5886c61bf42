#pragma once

/// @file The points of the given surface from which the remeshed one may not move away.

#include <vector>

#include "base/ids.h"
#include "remesh/reference_surface.h"
#include "remesh/surface_complex.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

using GuestId = Id<struct GuestTag>;

/// A point of a curved patch. A triangle near it must remain within the tolerance.
struct Guest {
  Vec3 position;
  TriangleId triangle;  ///< a given triangle that contains it
};

/// Returns the nodes inside curved patches, and points along tight bends. Between nodes, a surface within the tolerance of
/// a gentle bend has the bend within little more than the tolerance; but it could cut off a fillet whose radius is not
/// far above the tolerance. O(n log n).
[[nodiscard]] std::vector<Guest> findGuests(const ReferenceSurface& reference,
                                            const SurfaceComplex& given, double tolerance);

}  // namespace tetrafront
