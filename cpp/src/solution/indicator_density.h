#pragma once

/// @file Sizes from an indicator of the error that the user gives, for example a residual or the estimate of a goal. An
/// indicator that falls with the power p of the size is the same in all elements, t, if each element with the value eta
/// is divided into (eta / t)^(3/p) elements: its size times (t / eta)^(1/p). The number of elements on each part of the
/// mesh is thus given as a density, sqrt(det M); the shape of the metric is free.

#include <span>
#include <vector>

#include "metric/metric.h"
#include "solution/recovered_hessian.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// The densities with which no element has more than the largest value of the indicator on the given mesh.
struct IndicatorDensity {
  std::vector<double> densities;  ///< per node, >= 0
  double largest = 0.0;           ///< value of the indicator; 0 if it is 0 everywhere
  double elements = 0.0;          ///< number that the densities ask for
};

/// Returns the densities for an indicator with values >= 0 and one component. Values of elements are spread to their
/// nodes so that the number of elements is kept.
[[nodiscard]] IndicatorDensity indicatorDensity(const VolumeMesh& mesh, const SampledValues& values,
                                                double order);

/// Returns the metric with a density and the axes of `shape`, which is positive definite. The ratios of the sizes are
/// those of `shape` as far as `maxAspect` and `maxSize` permit: where a size reaches the largest one, the others grow
/// in its place. The zero tensor if the density is 0.
[[nodiscard]] SymmetricTensor withDensity(const SymmetricTensor& shape, double density,
                                          const MetricBounds& bounds);

/// Returns the largest value of the indicator on a mesh that follows the metrics.
[[nodiscard]] double largestIndicator(const IndicatorDensity& indicator, double order,
                                      std::span<const double> metrics);

}  // namespace tetrafront
