#pragma once

/// @file Distances in plain doubles. They decide whether things are too close, never topology.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the point of the closed segment a b nearest to `p`.
[[nodiscard]] Vec3 nearestPointOfSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Returns the point of the closed triangle a b c nearest to `p`.
[[nodiscard]] Vec3 nearestPointOfTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                          const Vec3& c);

/// Returns the squared distance from `p` to the closed segment a b.
[[nodiscard]] double squaredDistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// Returns the squared distance from `p` to the closed triangle a b c.
[[nodiscard]] double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                               const Vec3& c);

/// Returns the length of the longest edge.
[[nodiscard]] double longestEdgeLengthOf(const std::array<Vec3, 3>& corners);

/// Returns a point that two intersecting triangles have in common, up to rounding: the mean of the
/// corners of their intersection. If they are only close to each other, the point is close to
/// both.
[[nodiscard]] Vec3 intersectionPosition(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace tetrafront
