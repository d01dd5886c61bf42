#pragma once

/// @file Tests whether two triangles of a surface intersect outside of their shared nodes and
/// edges. All decisions use exact signs: orient3d off the planes, and orient2d inside them after
/// dropping a coordinate, which is exact too. Shared nodes are identified by their indices, never
/// by coordinates.

#include <array>
#include <cstddef>
#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// A triangle with the indices and positions of its nodes.
struct NumberedTriangle {
  std::array<std::uint32_t, 3> nodes;
  std::array<Vec3, 3> corners;
};

/// Returns true if the closed triangles have a point in common that is not on a shared node or
/// edge: crossing, touching and overlapping in one plane all count. Two triangles with the same
/// three nodes always intersect. Neither triangle may be degenerate.
[[nodiscard]] bool intersectImproperly(const NumberedTriangle& a, const NumberedTriangle& b);

/// Returns true if the closed triangles have a point in common. Neither may be degenerate.
[[nodiscard]] bool trianglesIntersect(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace tetrafront
