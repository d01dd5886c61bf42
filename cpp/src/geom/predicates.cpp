#include "geom/predicates.h"

#include <array>
#include <cmath>

#include "geom/expansion.h"

namespace tetrafront {
namespace {

constexpr double kRoundoff = 1.1102230246251565e-16;  // 2^-53
// Forward error bounds of the plain evaluations below (Shewchuk 1997, section 4).
constexpr double kOrient2dBound = (3.0 + 16.0 * kRoundoff) * kRoundoff;
constexpr double kOrient3dBound = (7.0 + 56.0 * kRoundoff) * kRoundoff;

thread_local std::uint64_t exactCount = 0;

int signOf(double value) { return value > 0.0 ? 1 : (value < 0.0 ? -1 : 0); }

/// Returns true if all three differences vanish along one axis. A difference rounds to zero only
/// if it is zero, so the points lie exactly in one axis-parallel plane, which is common in drawn
/// boxes.
bool shareCoordinate(const Vec3& u, const Vec3& v, const Vec3& w) {
  return (u.x == 0.0 && v.x == 0.0 && w.x == 0.0) || (u.y == 0.0 && v.y == 0.0 && w.y == 0.0) ||
         (u.z == 0.0 && v.z == 0.0 && w.z == 0.0);
}

/// Returns a x d - b x c of exact differences.
Expansion<16> minor2(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c,
                     const Expansion<2>& d) {
  return (a * d) + (b * c).negated();
}

}  // namespace

int orient2dExact(const Vec2& a, const Vec2& b, const Vec2& c) {
  ++exactCount;
  return minor2(exactDifference(b.x, a.x), exactDifference(b.y, a.y), exactDifference(c.x, a.x),
                exactDifference(c.y, a.y))
      .sign();
}

int orient2d(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double det = left - right;
  const double bound = kOrient2dBound * (std::fabs(left) + std::fabs(right));
  if (std::fabs(det) > bound) return signOf(det);
  return orient2dExact(a, b, c);
}

int orient3dExact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ++exactCount;
  std::array<Expansion<2>, 3> u;
  std::array<Expansion<2>, 3> v;
  std::array<Expansion<2>, 3> w;
  for (int k = 0; k < 3; ++k) {
    u[k] = exactDifference(b[k], a[k]);
    v[k] = exactDifference(c[k], a[k]);
    w[k] = exactDifference(d[k], a[k]);
  }
  const Expansion<64> x = minor2(v[1], v[2], w[1], w[2]) * u[0];
  const Expansion<64> y = minor2(v[2], v[0], w[2], w[0]) * u[1];
  const Expansion<64> z = minor2(v[0], v[1], w[0], w[1]) * u[2];
  return ((x + y) + z).sign();
}

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a;
  const Vec3 v = c - a;
  const Vec3 w = d - a;
  const double vyWz = v.y * w.z;
  const double vzWy = v.z * w.y;
  const double vzWx = v.z * w.x;
  const double vxWz = v.x * w.z;
  const double vxWy = v.x * w.y;
  const double vyWx = v.y * w.x;
  const double det = u.x * (vyWz - vzWy) + u.y * (vzWx - vxWz) + u.z * (vxWy - vyWx);
  const double permanent = std::fabs(u.x) * (std::fabs(vyWz) + std::fabs(vzWy)) +
                           std::fabs(u.y) * (std::fabs(vzWx) + std::fabs(vxWz)) +
                           std::fabs(u.z) * (std::fabs(vxWy) + std::fabs(vyWx));
  if (std::fabs(det) > kOrient3dBound * permanent) return signOf(det);
  if (shareCoordinate(u, v, w)) return 0;
  return orient3dExact(a, b, c, d);
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Dropping a coordinate is exact. Points are collinear if they are collinear in all three
  // projections.
  const auto view = [](const Vec3& p, int i, int j) { return Vec2{p[i], p[j]}; };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    if (orient2d(view(a, i, j), view(b, i, j), view(c, i, j)) != 0) return false;
  }
  return true;
}

std::uint64_t exactPredicateCount() { return exactCount; }

}  // namespace tetrafront
