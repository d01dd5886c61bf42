#pragma once

/// @file Limits a size tensor by an isotropic size or by another tensor. Eigenvectors come from a
/// fixed number of Jacobi sweeps, so that all machines compute the same bits.

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

/// Returns an upper bound of the principal values.
[[nodiscard]] double largestPossible(const SymmetricTensor& tensor);

/// Caps every principal axis at `size`; returns the tensor itself if no axis is longer.
[[nodiscard]] SymmetricTensor cappedTo(const SymmetricTensor& tensor, double size);

/// Returns the largest tensor, with the common conjugate axes of both, that nowhere exceeds either;
/// the tensor itself, bit for bit, if it nowhere exceeds `limit`. Both must be positive definite.
[[nodiscard]] SymmetricTensor limitedBy(const SymmetricTensor& tensor,
                                        const SymmetricTensor& limit);

}  // namespace tetrafront
