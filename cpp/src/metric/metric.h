#pragma once

/// @file Metrics: symmetric positive definite tensors M that measure an edge e by sqrt(e^T M e). An edge of metric
/// length 1 has the target size in its direction, so a principal value m stands for the size 1 / sqrt(m). Means and
/// interpolation are those of the logarithms (Arsigny et al. 2006, log-Euclidean metrics); two metrics are intersected
/// by simultaneous reduction (Alauzet 2010, Size gradation control of anisotropic meshes, section 2). All functions
/// give the same bits on every machine.

#include <limits>
#include <span>

#include "metric/symmetric_tensor.h"

namespace tetrafront {

/// Largest ratio of two principal sizes with which a metric is accepted: beyond, rounding would decide the smallest
/// principal value.
inline constexpr double kMaxAspect = 1e6;

/// Returns whether the tensor is finite and positive definite, with an aspect of at most kMaxAspect.
[[nodiscard]] bool isMetric(const SymmetricTensor& tensor);

/// Returns the length of an edge in one metric.
[[nodiscard]] inline double metricLength(const SymmetricTensor& metric, const Vec3& edge) {
  return std::sqrt(glm::dot(edge, metric * edge));
}

/// Returns (a - b) / ln(a / b) of two numbers > 0, and their value if they are equal; 0 if one is 0.
[[nodiscard]] double logarithmicMean(double a, double b);

/// Returns the length of an edge between two nodes with metrics: the integral of the length over the edge, where its
/// logarithm is interpolated.
[[nodiscard]] inline double metricLength(const SymmetricTensor& from, const SymmetricTensor& to,
                                         const Vec3& edge) {
  return logarithmicMean(metricLength(from, edge), metricLength(to, edge));
}

/// Returns the square root of the determinant: unit cubes per volume. 0 if the tensor is not positive definite.
[[nodiscard]] double densityOf(const SymmetricTensor& metric);

/// Returns the logarithm of a metric; means of metrics are the exponentials of means of their logarithms.
[[nodiscard]] SymmetricTensor logarithmOf(const SymmetricTensor& metric);
/// Returns the exponential of any symmetric tensor, which is a metric.
[[nodiscard]] SymmetricTensor exponentialOf(const SymmetricTensor& tensor);
/// Returns the log-Euclidean mean; one weight per metric, sum 1.
[[nodiscard]] SymmetricTensor meanOf(std::span<const SymmetricTensor> metrics,
                                     std::span<const double> weights);

/// Returns the smallest metric, with the common conjugate axes of both, that is nowhere below either: it asks for the
/// smaller size in every direction. Returns `first` itself, bit for bit, if that is nowhere below `second`.
[[nodiscard]] SymmetricTensor intersectionOf(const SymmetricTensor& first,
                                             const SymmetricTensor& second);

/// Returns whether `metric`, enlarged by the factor 1 + slack, is nowhere below `other`.
[[nodiscard]] bool isNowhereBelow(const SymmetricTensor& metric, const SymmetricTensor& other,
                                  double slack);

/// Limits of the principal sizes.
struct MetricBounds {
  double minSize = 0.0;                                      ///< >= 0
  double maxSize = std::numeric_limits<double>::infinity();  ///< >= minSize
  double maxAspect = kMaxAspect;                             ///< largest size / smallest size, >= 1
};

/// Returns the metric with its sizes in the bounds: first the sizes, then the aspect, by making large sizes smaller.
/// Accepts tensors whose principal values are 0 or, by rounding, below. The tensor itself if it is in the bounds.
[[nodiscard]] SymmetricTensor bounded(const SymmetricTensor& metric, const MetricBounds& bounds);

/// Sizes along three orthogonal directions: `size` across both directions, `stretching` times that along `direction`,
/// `secondStretching` times that along the part of `secondDirection` that is orthogonal to `direction`.
struct StretchedSize {
  double size = 1.0;              ///< > 0
  double stretching = 1.0;        ///< >= 1
  Vec3 direction{1.0, 0.0, 0.0};  ///< of any length > 0
  double secondStretching = 1.0;  ///< >= 1
  Vec3 secondDirection{0.0, 1.0,
                       0.0};  ///< not parallel to `direction`, unless secondStretching is 1
};

[[nodiscard]] SymmetricTensor metricOf(const StretchedSize& sizes);
/// Returns the sizes of a metric, with stretching >= secondStretching and unit directions.
[[nodiscard]] StretchedSize stretchedSizeOf(const SymmetricTensor& metric);

}  // namespace tetrafront
