#pragma once

/// @file Making a size tensor smaller where something else asks for less: an isotropic size, or
/// another tensor. Eigenvectors come from a fixed number of Jacobi sweeps, so that every machine
/// finds the same bits.

#include <array>

#include "field/size_tensor.h"

namespace tetrafront {

/// The matrix is the sum of values[i] axes[i] axes[i]^T.
struct PrincipalAxes {
  std::array<double, 3> values;
  std::array<Vec3, 3> axes;  ///< orthonormal
};
[[nodiscard]] PrincipalAxes principalAxes(const SymmetricTensor& tensor);
[[nodiscard]] SymmetricTensor composed(const PrincipalAxes& principal);

/// No principal value is above this.
[[nodiscard]] double largestPossible(const SymmetricTensor& tensor);

/// Every principal axis cut down to `size`; the tensor itself where none is longer.
[[nodiscard]] SymmetricTensor cappedTo(const SymmetricTensor& tensor, double size);

/// The largest tensor with the common conjugate axes of both that is nowhere above either; the
/// tensor itself, bit for bit, where it is nowhere above `limit`. Both positive definite.
[[nodiscard]] SymmetricTensor limitedBy(const SymmetricTensor& tensor,
                                        const SymmetricTensor& limit);

}  // namespace tetrafront
