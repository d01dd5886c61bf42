#pragma once

/// @file Tests whether a point lies inside a sphere, which decides a Delaunay mesh. The validity
/// of a mesh does not depend on the answer. Among needles, however, thousands of nodes lie nearly
/// on one sphere, and plain doubles would give random answers.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Returns true if p is inside the circumsphere of the tetrahedron a b c d, where d is on the side
/// from which a b c is seen counter-clockwise. Computed to about 100 bits; a point that is closer
/// to the sphere than this precision counts as outside.
[[nodiscard]] bool isInsideSphere(const std::array<Vec3, 4>& corners, const Vec3& p);

}  // namespace tetrafront
