#pragma once

/// @file The size field of a given surface: each surface node asks for the mean length of its
/// edges, and the wish grows with the distance from it, up to a cap. Held on an octree.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

class SizeOctree {
 public:
  /// h(x) = min(cap, min_i h_i + growth |x - x_i|), h_i the twice averaged mean edge at node i.
  /// `cap` 0: the 90th percentile of the h_i.
  SizeOctree(std::span<const Vec3> points, std::span<const std::uint32_t> triangles, double growth,
             double cap);

  /// Trilinear in the leaf that holds `place`; outside the box, the value at its nearest point.
  [[nodiscard]] double sizeAt(const Vec3& place) const;

 private:
  struct Node;
};

}  // namespace tetrafront
