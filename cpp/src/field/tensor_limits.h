#pragma once

/// @file Limits a size tensor by an isotropic size or by another tensor.

#include "field/size_tensor.h"
#include "metric/principal_axes.h"

namespace tetrafront {

/// Returns an upper bound of the principal values.
[[nodiscard]] double largestPossible(const SymmetricTensor& tensor);

/// Caps every principal axis at `size`; returns the tensor itself if no axis is longer.
[[nodiscard]] SymmetricTensor cappedTo(const SymmetricTensor& tensor, double size);

/// Returns the largest tensor, with the common conjugate axes of both, that nowhere exceeds either;
/// the tensor itself, bit for bit, if it nowhere exceeds `limit`. Both must be positive definite.
[[nodiscard]] SymmetricTensor limitedBy(const SymmetricTensor& tensor,
                                        const SymmetricTensor& limit);

}  // namespace tetrafront
