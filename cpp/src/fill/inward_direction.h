#pragma once

/// @file The direction in which a point leaves the boundary.

#include <array>
#include <optional>
#include <span>

#include "fill/exact_points.h"
#include "geom/dyadic.h"

namespace tetrafront {

/// The mean of the planes' normals, of unit length or zero; in doubles. `planes`: triangles,
/// counter-clockwise seen from inside.
[[nodiscard]] Vec3 inwardDirection(const ExactPoints& points, std::span<const NodeTriple> planes);

/// A direction that leads inwardDirection from one plane or from two, by exact signs. None only where the two
/// lie on each other, with nothing between.
[[nodiscard]] std::optional<DyadicVec3> exactInwardDirection(const ExactPoints& points,
                                                             std::span<const NodeTriple> planes);

}  // namespace tetrafront
