#include "metric/metric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "geom/exponential.h"
#include "metric/principal_axes.h"

namespace tetrafront {
namespace {

/// Below this relative difference of two lengths, their logarithmic mean is a series; its next term is below 1e-16.
constexpr double kSimilarLengths = 0.1;
constexpr int kMeanTerms = 7;

/// Applies a function to the principal values. Not a template: one copy serves the logarithm and the exponential.
SymmetricTensor mapped(const SymmetricTensor& tensor, double (*function)(double)) {
  PrincipalAxes principal = principalAxes(tensor);
  for (double& value : principal.values) value = function(value);
  return composed(principal);
}

/// Returns the part of `vector` orthogonal to a unit vector, with length 1; any such direction if there is none.
Vec3 orthogonalTo(const Vec3& unit, const Vec3& vector) {
  Vec3 part = vector - glm::dot(vector, unit) * unit;
  const double square = glm::dot(part, part);
  if (square > 1e-20 * glm::dot(vector, vector)) return part / std::sqrt(square);
  const bool isAlongX = std::fabs(unit.x) > 0.7;
  const Vec3 other = isAlongX ? Vec3(0.0, 1.0, 0.0) : Vec3(1.0, 0.0, 0.0);
  part = other - glm::dot(other, unit) * unit;
  return part / std::sqrt(glm::dot(part, part));
}

}  // namespace

bool isMetric(const SymmetricTensor& tensor) {
  if (!areFinite(tensor)) return false;
  const auto values = principalAxes(tensor).values;
  const auto [least, most] = std::ranges::minmax(values);
  return least > 0.0 && most <= kMaxAspect * kMaxAspect * least;
}

double logarithmicMean(double a, double b) {
  if (!(a > 0.0 && b > 0.0)) return 0.0;
  // With u = (high - low) / (high + low), ln(high / low) = 2 artanh u.
  const auto [low, high] = std::minmax(a, b);
  const double u = (high - low) / (high + low);
  if (u > kSimilarLengths) return (high - low) / logarithm(high / low);
  const double square = u * u;
  double sum = 0.0;
  for (int k = kMeanTerms; k >= 1; --k) sum = square * (sum + 1.0 / (2 * k + 1));
  return 0.5 * (low + high) / (1.0 + sum);
}

double densityOf(const SymmetricTensor& metric) {
  const Cholesky lower(metric);
  const double density = lower.xx * lower.yy * lower.zz;
  return density > 0.0 ? density : 0.0;
}

SymmetricTensor logarithmOf(const SymmetricTensor& metric) { return mapped(metric, &logarithm); }

SymmetricTensor exponentialOf(const SymmetricTensor& tensor) {
  return mapped(tensor, &exponential);
}

SymmetricTensor meanOf(std::span<const SymmetricTensor> metrics, std::span<const double> weights) {
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (std::size_t i = 0; i < metrics.size(); ++i)
    sum.accumulate(logarithmOf(metrics[i]), weights[i]);
  return exponentialOf(sum);
}

SymmetricTensor intersectionOf(const SymmetricTensor& first, const SymmetricTensor& second) {
  if (isNowhereBelow(first, second, 0.0)) return first;
  const Cholesky lower(first);
  PrincipalAxes principal = principalAxes(lower.reduced(second));
  for (std::size_t i = 0; i < 3; ++i) {
    principal.values[i] = std::max(principal.values[i], 1.0);
    principal.axes[i] = lower.times(principal.axes[i]);
  }
  return composed(principal);
}

bool isNowhereBelow(const SymmetricTensor& metric, const SymmetricTensor& other, double slack) {
  const double factor = 1.0 + slack;
  const double xx = factor * metric.xx - other.xx;
  if (!(xx >= 0.0)) return false;
  const double xy = factor * metric.xy - other.xy;
  const double xz = factor * metric.xz - other.xz;
  const double yx = xx > 0.0 ? xy / xx : 0.0;
  const double zx = xx > 0.0 ? xz / xx : 0.0;
  if (xx == 0.0 && (xy != 0.0 || xz != 0.0)) return false;
  const double yy = factor * metric.yy - other.yy - yx * xy;
  if (!(yy >= 0.0)) return false;
  const double yz = factor * metric.yz - other.yz - yx * xz;
  if (yy == 0.0 && yz != 0.0) return false;
  const double zy = yy > 0.0 ? yz / yy : 0.0;
  return factor * metric.zz - other.zz - zx * xz - zy * yz >= 0.0;
}

SymmetricTensor bounded(const SymmetricTensor& metric, const MetricBounds& bounds) {
  PrincipalAxes principal = principalAxes(metric);
  const double least = 1.0 / (bounds.maxSize * bounds.maxSize);
  const double most = 1.0 / (bounds.minSize * bounds.minSize);
  std::array<double, 3> values = principal.values;
  for (double& value : values) value = std::clamp(value, least, most);
  const double aspect = bounds.maxAspect;
  const double fromAspect = std::ranges::max(values) / (aspect * aspect);
  for (double& value : values) value = std::max(value, fromAspect);
  if (values == principal.values) return metric;
  principal.values = values;
  return composed(principal);
}

SymmetricTensor metricOf(const StretchedSize& sizes) {
  const double square = glm::dot(sizes.direction, sizes.direction);
  const Vec3 first = square > 0.0 ? sizes.direction / std::sqrt(square) : Vec3(1.0, 0.0, 0.0);
  const Vec3 second = orthogonalTo(first, sizes.secondDirection);
  const double along = sizes.size * sizes.stretching;
  const double alongSecond = sizes.size * sizes.secondStretching;
  return composed(
      {{1.0 / (sizes.size * sizes.size), 1.0 / (alongSecond * alongSecond), 1.0 / (along * along)},
       {glm::cross(first, second), second, first}});
}

StretchedSize stretchedSizeOf(const SymmetricTensor& metric) {
  const auto [values, axes] = principalAxes(metric);
  std::array<std::size_t, 3> order{0, 1, 2};
  if (values[order[0]] < values[order[1]]) std::swap(order[0], order[1]);
  if (values[order[1]] < values[order[2]]) std::swap(order[1], order[2]);
  if (values[order[0]] < values[order[1]]) std::swap(order[0], order[1]);
  const double largest = values[order[0]];
  return {.size = 1.0 / std::sqrt(largest),
          .stretching = std::sqrt(largest / values[order[2]]),
          .direction = axes[order[2]],
          .secondStretching = std::sqrt(largest / values[order[1]]),
          .secondDirection = axes[order[1]]};
}

}  // namespace tetrafront
