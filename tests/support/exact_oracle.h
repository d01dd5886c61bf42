#pragma once

/// @file The signs of the engine's predicates, computed with integers of any size: the oracle of
/// their tests.

#include <array>

#include "support/big_integer.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

using ExactVec3 = std::array<BigInteger, 3>;

/// Returns the positions as whole numbers: all are multiplied by the same power of two.
template <std::size_t N>
std::array<ExactVec3, N> exactly(const std::array<Vec3, N>& positions) {
  int shift = 0;
  for (const Vec3& p : positions) {
    for (int a = 0; a < 3; ++a) {
      int exponent = 0;
      if (p[a] == 0.0) continue;
      std::frexp(p[a], &exponent);
      shift = std::max(shift, 53 - exponent);
    }
  }
  std::array<ExactVec3, N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      result[i][a] = BigInteger::scaled(positions[i][static_cast<int>(a)], shift);
    }
  }
  return result;
}

inline ExactVec3 operator-(const ExactVec3& a, const ExactVec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline BigInteger exactDot(const ExactVec3& a, const ExactVec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline ExactVec3 exactCross(const ExactVec3& a, const ExactVec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the sign of (b-a) x (c-a) . (d-a).
inline int oracleOrient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<ExactVec3, 4> p = exactly<4>({a, b, c, d});
  return exactDot(exactCross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]).sign();
}

/// Returns the orientation of a b c: +1 counter-clockwise, 0 collinear, -1 clockwise.
inline int oracleOrient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const std::array<ExactVec3, 3> p =
      exactly<3>({Vec3(a.x, a.y, 0.0), Vec3(b.x, b.y, 0.0), Vec3(c.x, c.y, 0.0)});
  return exactCross(p[1] - p[0], p[2] - p[0])[2].sign();
}

}  // namespace tetrafront::testing
