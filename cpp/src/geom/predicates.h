#pragma once

/// @file Exact signs. Each function first evaluates in double with a forward error bound; only
/// where that cannot decide, the sign is taken from an exact expansion (Shewchuk 1997). Needs
/// round-to-nearest, no contraction and no overflow: coordinates within 2^-100 .. 2^100, which
/// the input check guarantees.

#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Sign of (b-a) x (c-a) . (d-a): +1 if d lies on the side from which a b c is seen
/// counter-clockwise, -1 on the other, 0 if the four points are in one plane. Exact.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the turn a b c in the plane: +1 counter-clockwise, 0 collinear. Exact.
[[nodiscard]] int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

/// As orient3d, but straight to the exact stage; for callers whose own filter has failed, and
/// as the oracle of the tests.
[[nodiscard]] int orient3dExact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
[[nodiscard]] int orient2dExact(const Vec2& a, const Vec2& b, const Vec2& c);

/// True if a b c are on one line (as exact points, not within a tolerance).
[[nodiscard]] bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// How often the exact stage was needed since the program began; statistics only.
[[nodiscard]] std::uint64_t exactPredicateCount();

}  // namespace tetrafront
