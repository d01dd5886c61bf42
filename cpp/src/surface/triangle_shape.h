#pragma once

/// @file Measures of triangles in space by which a patch's triangulation is improved.

#include <algorithm>
#include <cmath>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Shape of a triangle: 4 sqrt(3) area / sum of squared edges; 1 if equilateral, 0 if degenerate.
[[nodiscard]] inline double triangleShape(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kTwoRootThree = 3.4641016151377544;
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double squares = glm::dot(ab, ab) + glm::dot(bc, bc) + glm::dot(ca, ca);
  return squares > 0.0 ? kTwoRootThree * glm::length(glm::cross(ab, ca)) / squares : 0.0;
}

/// Cost of a triangle's shape in a sum over triangles: 1 if equilateral, 1e12 if degenerate. A bad triangle
/// outweighs small gains elsewhere.
[[nodiscard]] inline double shapeCost(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kMinShape = 1e-6;
  const double shape = std::max(triangleShape(a, b, c), kMinShape);
  return 1.0 / (shape * shape);
}

/// Sine of a triangle's smallest angle: twice the area / product of the two longest edges.
[[nodiscard]] inline double triangleSine(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const Vec3 ca = a - c;
  const double first = glm::dot(ab, ab);
  const double second = glm::dot(bc, bc);
  const double third = glm::dot(ca, ca);
  const double shortest = std::min({first, second, third});
  // Do not divide the product of all three by the shortest edge, which may have no length.
  const double product = shortest == first    ? second * third
                         : shortest == second ? first * third
                                              : first * second;
  return product > 0.0 ? glm::length(glm::cross(ab, ca)) / std::sqrt(product) : 0.0;
}

/// Cosine of the angle between the normals of the triangles a b c and b a d; 1 if one is degenerate.
[[nodiscard]] inline double foldCosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = glm::cross(b - a, c - a);
  const Vec3 second = glm::cross(d - a, b - a);
  const double product = glm::length(first) * glm::length(second);
  return product > 0.0 ? glm::dot(first, second) / product : 1.0;
}

}  // namespace tetrafront
