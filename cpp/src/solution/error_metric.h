#pragma once

/// @file The metric that makes the interpolation error of a field smallest among all metrics with the same number of
/// elements (Loseille & Alauzet 2011, Continuous mesh framework, part I, section 4).
///
/// On a regular element whose edges have length 1 in the metric M, a function with the Hessian H differs from its linear
/// interpolant by at most c trace(M^-1 |H|) / 3 in the mean of the norm, with equality if |H| is a multiple of M; c is
/// the error of |x|^2 / 2. Among all M of one complexity, the norm over the mesh is smallest for
///
///     M = K det(|H|)^(-1 / (2p + 3)) |H|;   error = c / K (integral of det(|H|)^(p / (2p + 3)))^(1 / p).

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/solution.h"

namespace tetrafront {

/// The optimal metric of one field.
struct FieldMetric {
  std::vector<double> hessians;  ///< six numbers per node: |H|, positive definite
  std::vector<double> metrics;   ///< six numbers per node, for K = 1
  double complexity =
      0.0;  ///< of `metrics`, each constant over a quarter of the elements around its node
  bool hasVariation = false;  ///< false: the Hessians are rounding, and `metrics` are 1
};

/// Returns the metric of a field with the given Hessians, `components` times six numbers per node as from
/// recoverHessians(). `noise` per node: largest second derivative that is rounding. Components are combined as the
/// square root of the sum of their squared Hessians, which does not depend on the axes.
[[nodiscard]] FieldMetric fieldMetric(const VolumeMesh& mesh, std::span<const double> hessians,
                                      std::span<const double> noise,
                                      const SolutionMetricOptions& options);

/// Returns the factor K with which the error is `error`.
[[nodiscard]] double scaleForError(const FieldMetric& field, ErrorNorm norm, double error);

/// Returns the error of a field on a mesh of regular elements that follows the metrics.
[[nodiscard]] double expectedError(const VolumeMesh& mesh, const FieldMetric& field,
                                   std::span<const double> metrics, ErrorNorm norm);

}  // namespace tetrafront
