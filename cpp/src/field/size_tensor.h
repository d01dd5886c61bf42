#pragma once

/// @file The target size in all directions. A node of the background grid asks for size d across
/// and s times d along a direction a. The symmetric tensor
///
///     H = d (I + (s - 1) a a^T),    T = H^-1,
///
/// maps the unit sphere to the target edges; T maps space to the space where the target element is
/// regular with edge 1. H is interpolated: it stays positive definite and does not depend on the
/// sign of a.

#include <cmath>

#include "tetrafront/background_grid.h"
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

/// Returns the root mean square of the principal sizes: the size itself if nothing is stretched.
[[nodiscard]] inline double meanSizeOf(const SymmetricTensor& h) {
  const double crossed = h.xy * h.xy + h.xz * h.xz + h.yz * h.yz;
  return std::sqrt((h.xx * h.xx + h.yy * h.yy + h.zz * h.zz + 2.0 * crossed) / 3.0);
}

/// Returns H of one node.
[[nodiscard]] inline SymmetricTensor sizeTensor(const BackgroundNode& node) {
  const double square = glm::dot(node.direction, node.direction);
  const Vec3 a = square > 0.0 ? node.direction * (1.0 / std::sqrt(square)) : Vec3(0.0);
  const double extra = node.size * (node.stretching - 1.0);
  return {node.size + extra * a.x * a.x,
          node.size + extra * a.y * a.y,
          node.size + extra * a.z * a.z,
          extra * a.x * a.y,
          extra * a.x * a.z,
          extra * a.y * a.z};
}

}  // namespace tetrafront
