#pragma once

/// @file Which points are inside a sphere: the question a Delaunay mesh is made by. Nothing valid
/// depends on the answer, but among needles, whose nodes are nearly on one sphere by the thousand,
/// plain doubles answer it by chance.

#include <array>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Is p inside the sphere around the tetrahedron, whose corners a b c d have d on the side from which
/// a b c is seen counter-clockwise? Computed to about 100 bits: what is nearer to the sphere than
/// that, as are all points on it but for exact arithmetic, counts as outside.
[[nodiscard]] bool isInsideSphere(const std::array<Vec3, 4>& corners, const Vec3& p);

}  // namespace tetrafront
