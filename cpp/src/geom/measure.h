#pragma once

/// @file Distances, in plain double: for "too close" questions, never for topology.

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Square of the distance from `p` to the closed segment a b.
[[nodiscard]] double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Square of the distance from `p` to the closed triangle a b c.
[[nodiscard]] double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                               const Vec3& c);

}  // namespace tetrafront
