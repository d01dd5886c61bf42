#pragma once

/// @file The one place that names GLM. Engine coordinates are double throughout.

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tetrafront {

/// Position or direction in space: three doubles, x y z in memory.
using Vec3 = glm::dvec3;
/// Position in the parameter plane of a patch.
using Vec2 = glm::dvec2;

static_assert(sizeof(Vec3) == 3 * sizeof(double), "points cross the border as packed x y z");

}  // namespace tetrafront
