#include "field/tensor_limits.h"

#include <algorithm>
#include <cmath>

#include "base/tolerance.h"

namespace tetrafront {
namespace {

/// Sweeps of cyclic Jacobi. It converges quadratically: five sweeps diagonalize a 3 x 3 matrix.
constexpr int kLimitSweeps = 6;

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix matrixOf(const SymmetricTensor& t) {
  return {{{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}}};
}

/// Rotates axes p and q so that a[p][q] vanishes.
void rotate(Matrix& a, std::array<Vec3, 3>& axes, std::size_t p, std::size_t q) {
  if (a[p][q] == 0.0) return;
  const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double root = std::fabs(theta) + std::sqrt(theta * theta + 1.0);
  const double t = (theta >= 0.0 ? 1.0 : -1.0) / root;
  const double c = 1.0 / std::sqrt(t * t + 1.0);
  const double s = t * c;
  const double apq = a[p][q];
  a[p][p] -= t * apq;
  a[q][q] += t * apq;
  a[p][q] = a[q][p] = 0.0;
  const std::size_t r = 3 - p - q;
  const double arp = a[r][p];
  const double arq = a[r][q];
  a[r][p] = a[p][r] = c * arp - s * arq;
  a[r][q] = a[q][r] = s * arp + c * arq;
  const Vec3 axis = axes[p];
  axes[p] = c * axis - s * axes[q];
  axes[q] = s * axis + c * axes[q];
}

/// Returns the lower triangle L of L L^T (Cholesky).
struct Cholesky {
  double xx, yx, yy, zx, zy, zz;

  explicit Cholesky(const SymmetricTensor& t)
      : xx(std::sqrt(t.xx)),
        yx(t.xy / xx),
        yy(std::sqrt(t.yy - yx * yx)),
        zx(t.xz / xx),
        zy((t.yz - zx * yx) / yy),
        zz(std::sqrt(t.zz - zx * zx - zy * zy)) {}

  [[nodiscard]] Vec3 times(const Vec3& v) const {
    return {xx * v.x, yx * v.x + yy * v.y, zx * v.x + zy * v.y + zz * v.z};
  }
  [[nodiscard]] Vec3 solve(const Vec3& v) const {
    const double x = v.x / xx;
    const double y = (v.y - yx * x) / yy;
    return {x, y, (v.z - zx * x - zy * y) / zz};
  }
  /// Returns L^-1 A L^-T.
  [[nodiscard]] SymmetricTensor reduced(const SymmetricTensor& a) const {
    const std::array<Vec3, 3> rows{solve(a.row(0)), solve(a.row(1)), solve(a.row(2))};
    const Vec3 first = solve({rows[0].x, rows[1].x, rows[2].x});
    const Vec3 second = solve({rows[0].y, rows[1].y, rows[2].y});
    const Vec3 third = solve({rows[0].z, rows[1].z, rows[2].z});
    return {first.x, second.y, third.z, first.y, first.z, second.z};
  }
};

/// Returns whether limit - tensor is positive semidefinite, up to rounding.
bool isNowhereAbove(const SymmetricTensor& tensor, const SymmetricTensor& limit) {
  const double slack = Tolerance(largestPossible(limit)).rounding();
  const double xx = limit.xx - tensor.xx + slack;
  const double yy = limit.yy - tensor.yy + slack;
  const double zz = limit.zz - tensor.zz + slack;
  const double xy = limit.xy - tensor.xy;
  const double xz = limit.xz - tensor.xz;
  const double yz = limit.yz - tensor.yz;
  if (!(xx > 0.0)) return false;
  const double y = yy - xy * xy / xx;
  if (!(y > 0.0)) return false;
  const double cross = yz - xy * xz / xx;
  return zz - xz * xz / xx - cross * cross / y > 0.0;
}

}  // namespace

PrincipalAxes principalAxes(const SymmetricTensor& tensor) {
  Matrix a = matrixOf(tensor);
  PrincipalAxes principal{{}, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}};
  for (int sweep = 0; sweep < kLimitSweeps; ++sweep) {
    rotate(a, principal.axes, 0, 1);
    rotate(a, principal.axes, 0, 2);
    rotate(a, principal.axes, 1, 2);
  }
  principal.values = {a[0][0], a[1][1], a[2][2]};
  return principal;
}

SymmetricTensor composed(const PrincipalAxes& principal) {
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& a = principal.axes[i];
    sum.accumulate({a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.x * a.z, a.y * a.z},
                   principal.values[i]);
  }
  return sum;
}

double largestPossible(const SymmetricTensor& t) {
  const double xy = std::fabs(t.xy);
  const double xz = std::fabs(t.xz);
  const double yz = std::fabs(t.yz);
  return std::max({t.xx + xy + xz, t.yy + xy + yz, t.zz + xz + yz});
}

SymmetricTensor cappedTo(const SymmetricTensor& tensor, double size) {
  if (largestPossible(tensor) <= size) return tensor;
  PrincipalAxes principal = principalAxes(tensor);
  bool cut = false;
  for (double& value : principal.values) {
    cut = cut || value > size;
    value = std::min(value, size);
  }
  return cut ? composed(principal) : tensor;
}

SymmetricTensor limitedBy(const SymmetricTensor& tensor, const SymmetricTensor& limit) {
  if (isNowhereAbove(tensor, limit)) return tensor;
  const Cholesky lower(limit);
  PrincipalAxes principal = principalAxes(lower.reduced(tensor));
  for (std::size_t i = 0; i < 3; ++i) {
    principal.values[i] = std::min(principal.values[i], 1.0);
    principal.axes[i] = lower.times(principal.axes[i]);
  }
  return composed(principal);
}

}  // namespace tetrafront
