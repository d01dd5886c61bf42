#pragma once

/// @file Exact signs. Each function first evaluates in doubles with a forward error bound. If this
/// cannot decide, an exact expansion gives the sign (Shewchuk 1997). Requires round-to-nearest, no
/// contraction and no overflow: magnitudes from 2^-100 to 2^100, which the input check guarantees.

#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns the exact sign of (b-a) x (c-a) . (d-a): +1 if d is on the side from which a b c is
/// seen counter-clockwise, -1 if it is on the other side, 0 if the points are in one plane.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Returns the exact orientation of a b c in the plane: +1 counter-clockwise, -1 clockwise, 0
/// collinear.
[[nodiscard]] int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// Returns the same as orient3d() without its filter, for callers whose own filter has failed and
/// as the reference of the tests.
[[nodiscard]] int orient3dExact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
[[nodiscard]] int orient2dExact(const Vec2& a, const Vec2& b, const Vec2& c);

/// Returns true if a b c are exactly collinear, without a tolerance.
[[nodiscard]] bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// Number of evaluations of the exact stage since the program began, for statistics.
[[nodiscard]] std::uint64_t exactPredicateCount();

}  // namespace tetrafront
