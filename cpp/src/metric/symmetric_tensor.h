#pragma once

/// @file Symmetric 3 x 3 matrices: metrics, their logarithms, Hessians and size tensors.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// A symmetric 3 x 3 matrix.
struct SymmetricTensor {
  double xx = 1.0;
  double yy = 1.0;
  double zz = 1.0;
  double xy = 0.0;
  double xz = 0.0;
  double yz = 0.0;

  static SymmetricTensor isotropic(double size) { return {size, size, size, 0.0, 0.0, 0.0}; }

  [[nodiscard]] Vec3 row(int i) const {
    if (i == 0) return {xx, xy, xz};
    if (i == 1) return {xy, yy, yz};
    return {xz, yz, zz};
  }

  friend Vec3 operator*(const SymmetricTensor& m, const Vec3& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
  }

  [[nodiscard]] SymmetricTensor scaledBy(double factor) const {
    return {xx * factor, yy * factor, zz * factor, xy * factor, xz * factor, yz * factor};
  }

  /// Adds `weight` times `other`.
  void accumulate(const SymmetricTensor& other, double weight) {
    xx += weight * other.xx;
    yy += weight * other.yy;
    zz += weight * other.zz;
    xy += weight * other.xy;
    xz += weight * other.xz;
    yz += weight * other.yz;
  }

  [[nodiscard]] double determinant() const {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  }

  [[nodiscard]] SymmetricTensor squared() const {
    return {xx * xx + xy * xy + xz * xz, xy * xy + yy * yy + yz * yz, xz * xz + yz * yz + zz * zz,
            xx * xy + xy * yy + xz * yz, xx * xz + xy * yz + xz * zz, xy * xz + yy * yz + yz * zz};
  }

  /// Must be invertible.
  [[nodiscard]] SymmetricTensor inverse() const {
    const double scale = 1.0 / determinant();
    return {scale * (yy * zz - yz * yz), scale * (xx * zz - xz * xz), scale * (xx * yy - xy * xy),
            scale * (xz * yz - xy * zz), scale * (xy * yz - xz * yy), scale * (xy * xz - xx * yz)};
  }
};

/// Numbers per tensor in flat arrays, in the order xx, xy, xz, yy, yz, zz: the upper triangle by rows.
inline constexpr std::size_t kTensorNumbers = 6;

/// Returns tensor i of a flat array.
[[nodiscard]] inline SymmetricTensor tensorAt(std::span<const double> tensors, std::size_t i) {
  const auto t = tensors.subspan(kTensorNumbers * i, kTensorNumbers);
  return {.xx = t[0], .yy = t[3], .zz = t[5], .xy = t[1], .xz = t[2], .yz = t[4]};
}

/// Writes tensor i of a flat array.
inline void putTensor(std::span<double> tensors, std::size_t i, const SymmetricTensor& tensor) {
  const auto t = tensors.subspan(kTensorNumbers * i, kTensorNumbers);
  t[0] = tensor.xx;
  t[1] = tensor.xy;
  t[2] = tensor.xz;
  t[3] = tensor.yy;
  t[4] = tensor.yz;
  t[5] = tensor.zz;
}

/// Returns whether all six numbers are finite.
[[nodiscard]] inline bool areFinite(const SymmetricTensor& t) {
  return std::isfinite(t.xx) && std::isfinite(t.xy) && std::isfinite(t.xz) && std::isfinite(t.yy) &&
         std::isfinite(t.yz) && std::isfinite(t.zz);
}

}  // namespace tetrafront
