#pragma once

/// @file Distances, in plain double: for "too close" questions, never for topology.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Square of the distance from `p` to the closed segment a b.
[[nodiscard]] double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Square of the distance from `p` to the closed triangle a b c.
[[nodiscard]] double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                               const Vec3& c);

/// A point that two triangles have in common, up to rounding, if they meet: the mean of the corners
/// of what they share. Near both, if they are only near each other.
[[nodiscard]] Vec3 meetingPlace(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace tetrafront
