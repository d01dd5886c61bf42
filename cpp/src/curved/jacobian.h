#pragma once

/// @file The Jacobian of a ten-node tetrahedron: its Bezier coefficients, and proven bounds on its values.

#include <array>
#include <cstddef>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// The nodes of a ten-node tetrahedron.
struct QuadraticTet {
  std::array<Vec3, 4> corners;
  std::array<Vec3, 6> middles;  ///< in the order of kTetEdges
};

inline constexpr std::size_t kJacobianCoefficients = 20;

/// det J as a cubic polynomial in Bezier form, where J is the derivative of the position by the reference coordinates: six
/// times the volume, everywhere, if the edges are straight.
struct JacobianPolynomial {
  std::array<double, kJacobianCoefficients> coefficients{};
  /// Bound on the rounding errors of the coefficients, here and in pieces of the element.
  double error = 0.0;
};

[[nodiscard]] JacobianPolynomial jacobianOf(const QuadraticTet& tet);

/// Returns the least value of det J divided by the largest magnitude, from -1 to 1. A positive value is a lower bound: det J
/// is proven to be positive in the whole element. See SecondOrderMesh.
[[nodiscard]] double scaledJacobian(const QuadraticTet& tet);

}  // namespace tetrafront
