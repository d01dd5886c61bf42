#pragma once

/// @file The direction in which a point leaves the boundary.

#include <array>
#include <optional>
#include <span>

#include "fill/exact_points.h"
#include "geom/dyadic.h"

namespace tetrafront {

/// Returns the mean of the planes' normals in doubles, of unit length or zero. `planes` are
/// triangles, counter-clockwise seen from inside.
[[nodiscard]] Vec3 inwardDirection(const ExactPoints& points, std::span<const NodeTriple> planes);

/// Returns a direction inwards from one plane or from two, by exact signs; none if the two planes
/// are folded onto each other.
[[nodiscard]] std::optional<DyadicVec3> exactInwardDirection(const ExactPoints& points,
                                                             std::span<const NodeTriple> planes);

}  // namespace tetrafront
