#pragma once

/// @file Dihedral angles, computed without the engine's formulas.

#include <cmath>
#include <numbers>

#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// Returns the angle in degrees between the half-planes from edge a b through c and d, measured in
/// the plane across the edge.
inline double slowDihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 axis = glm::normalize(b - a);
  const Vec3 u = (c - a) - glm::dot(c - a, axis) * axis;
  const Vec3 v = (d - a) - glm::dot(d - a, axis) * axis;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180.0 / std::numbers::pi;
}

}  // namespace tetrafront::testing
