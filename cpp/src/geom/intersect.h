#pragma once

/// @file Do two triangles of a surface meet where they should not? Decided by exact signs only:
/// orient3d off the planes, and orient2d after dropping a coordinate inside them, which is exact
/// too. What two triangles share is told by node numbers, never by coordinates.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// A triangle with the numbers and the places of its nodes.
struct NumberedTriangle {
  std::array<std::uint32_t, 3> nodes;
  std::array<Vec3, 3> corners;
};

/// True if the closed triangles have a point in common that is not on a node or an edge named in
/// both: crossing, touching and overlapping in one plane all count. Two triangles with the same
/// three nodes always do. Neither may be degenerate.
[[nodiscard]] bool meetImproperly(const NumberedTriangle& a, const NumberedTriangle& b);

/// True if the closed triangles have a point in common. Neither may be degenerate.
[[nodiscard]] bool trianglesMeet(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace tetrafront
