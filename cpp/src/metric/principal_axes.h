#pragma once

/// @file Eigenvalues and eigenvectors of symmetric tensors, from a fixed number of Jacobi sweeps, so that all machines
/// compute the same bits; and the Cholesky factor, with which two tensors are reduced simultaneously.

#include <array>
#include <cmath>

#include "metric/symmetric_tensor.h"

namespace tetrafront {

/// The matrix is the sum of values[i] axes[i] axes[i]^T.
struct PrincipalAxes {
  std::array<double, 3> values;
  std::array<Vec3, 3> axes;  ///< orthonormal
};
[[nodiscard]] PrincipalAxes principalAxes(const SymmetricTensor& tensor);
[[nodiscard]] SymmetricTensor composed(const PrincipalAxes& principal);

/// The lower triangle L of a positive definite matrix L L^T.
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

}  // namespace tetrafront
