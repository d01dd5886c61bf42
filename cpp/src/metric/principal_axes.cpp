#include "metric/principal_axes.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace tetrafront {
namespace {

/// Sweeps of cyclic Jacobi. It converges quadratically: five sweeps diagonalize a 3 x 3 matrix.
constexpr int kJacobiSweeps = 6;

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix matrixOf(const SymmetricTensor& t) {
  return {{{t.xx, t.xy, t.xz}, {t.xy, t.yy, t.yz}, {t.xz, t.yz, t.zz}}};
}

/// Rotates axes p and q so that a[p][q] vanishes.
void rotateAxes(Matrix& a, std::array<Vec3, 3>& axes, std::size_t p, std::size_t q) {
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

}  // namespace

PrincipalAxes principalAxes(const SymmetricTensor& tensor) {
  Matrix a = matrixOf(tensor);
  PrincipalAxes principal{{}, {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}};
  for (int sweep = 0; sweep < kJacobiSweeps; ++sweep) {
    rotateAxes(a, principal.axes, 0, 1);
    rotateAxes(a, principal.axes, 0, 2);
    rotateAxes(a, principal.axes, 1, 2);
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

}  // namespace tetrafront
