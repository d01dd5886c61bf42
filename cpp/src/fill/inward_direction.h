#pragma once

/// @file The direction in which a point leaves the boundary.

#include <array>
#include <optional>
#include <span>

#include "fill/exact_points.h"
#include "geom/dyadic.h"

namespace tetrafront {

using NodeTripleSpan = std::span<const std::array<NodeId, 3>>;

/// The mean of the planes' normals, of unit length or zero; in doubles. `planes`: triangles,
/// counter-clockwise seen from inside.
[[nodiscard]] Vec3 inwards(const ExactPoints& points, NodeTripleSpan planes);

/// A direction that leads inwards from one plane or from two, by exact signs. None only where the two
/// lie on each other, with nothing between.
[[nodiscard]] std::optional<DyadicVec3> exactInwards(const ExactPoints& points,
                                                     NodeTripleSpan planes);

}  // namespace tetrafront
