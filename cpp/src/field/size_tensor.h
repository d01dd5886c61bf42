#pragma once

/// @file The target size in all directions. A node of the background grid asks for size d across
/// and s times d along a direction a. The symmetric tensor
///
///     H = d (I + (s - 1) a a^T),    T = H^-1,
///
/// maps the unit sphere to the target edges; T maps space to the space where the target element is
/// regular with edge 1. H is interpolated: it stays positive definite and does not depend on the
/// sign of a.

#include <algorithm>
#include <cmath>

#include "metric/symmetric_tensor.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

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

/// Returns a multiple of a vector whose largest component is 1 or -1, so that its square neither vanishes nor overflows.
[[nodiscard]] inline Vec3 scaledToOne(const Vec3& v) {
  return v / std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// Returns H of one node with a second stretching s2 along b, orthogonal to a:
///
///     H = d (I + (s - 1) a a^T + (s2 - 1) b b^T).
[[nodiscard]] inline SymmetricTensor sizeTensor(const BackgroundNode& node,
                                                const SecondStretching& second) {
  SymmetricTensor tensor = sizeTensor(node);
  if (!(second.stretching > 1.0)) return tensor;
  Vec3 b = scaledToOne(second.direction);
  if (node.stretching > 1.0) {
    const Vec3 a = scaledToOne(node.direction);
    b -= (glm::dot(a, b) / glm::dot(a, a)) * a;
  }
  const double extra = node.size * (second.stretching - 1.0) / glm::dot(b, b);
  tensor.accumulate({b.x * b.x, b.y * b.y, b.z * b.z, b.x * b.y, b.x * b.z, b.y * b.z}, extra);
  return tensor;
}

}  // namespace tetrafront
