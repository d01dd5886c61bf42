#include "solution/indicator_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/ids.h"
#include "geom/cube_root.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"
#include "solution/power.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Returns the factor that makes the product of `count` sizes larger by `ratio`.
double commonFactor(double ratio, std::size_t count) {
  if (count == 3) return cubeRoot(ratio);
  return count == 2 ? std::sqrt(ratio) : ratio;
}

}  // namespace

IndicatorDensity indicatorDensity(const VolumeMesh& mesh, const SampledValues& values,
                                  double order) {
  IndicatorDensity result;
  result.densities.assign(countNodes(mesh), 0.0);
  const auto valueAt = [&](std::uint32_t tet, NodeId node) {
    return values.values[values.isPerElement ? tet : node.index()];
  };
  for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t) {
    for (const NodeId node : nodesOf(mesh, TetId(t)))
      result.largest = std::max(result.largest, valueAt(t, node));
  }
  if (!(result.largest > 0.0)) return result;
  std::vector<double> volumes(countNodes(mesh), 0.0);
  for (std::uint32_t t = 0; t < countTetrahedra(mesh); ++t) {
    const auto [a, b, c, d] = cornersOf(mesh, TetId(t));
    const double volume = std::fabs(glm::dot(glm::cross(b - a, c - a), d - a)) / 6.0;
    for (const NodeId node : nodesOf(mesh, TetId(t))) {
      const double share = 0.25 * powerOf(valueAt(t, node) / result.largest, 3.0 / order);
      result.densities[node.index()] += share;
      result.elements += share;
      volumes[node.index()] += 0.25 * volume;
    }
  }
  for (std::size_t i = 0; i < volumes.size(); ++i)
    if (volumes[i] > 0.0) result.densities[i] /= kElementsPerComplexity * volumes[i];
  return result;
}

SymmetricTensor withDensity(const SymmetricTensor& shape, double density,
                            const MetricBounds& bounds) {
  if (!(density > 0.0)) return SymmetricTensor::isotropic(0.0);
  PrincipalAxes principal = principalAxes(shape);
  const double aspect = bounds.maxAspect;
  const double least = std::ranges::max(principal.values) / (aspect * aspect);
  std::array<double, 3> sizes{};
  for (std::size_t i = 0; i < 3; ++i)
    sizes[i] = 1.0 / std::sqrt(std::max(principal.values[i], least));
  std::array<std::size_t, 3> order{0, 1, 2};
  if (sizes[order[0]] < sizes[order[1]]) std::swap(order[0], order[1]);
  if (sizes[order[1]] < sizes[order[2]]) std::swap(order[1], order[2]);
  if (sizes[order[0]] < sizes[order[1]]) std::swap(order[0], order[1]);
  double ratio = 1.0 / (density * sizes[0] * sizes[1] * sizes[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    // The sizes before, which are larger, have reached the limit; those from here on share the rest.
    double& size = sizes[order[k]];
    const double grown = size * commonFactor(ratio, 3 - k);
    const double limited = std::min(grown, bounds.maxSize);
    ratio *= size / limited;
    size = limited;
  }
  for (std::size_t i = 0; i < 3; ++i) principal.values[i] = 1.0 / (sizes[i] * sizes[i]);
  return composed(principal);
}

double largestIndicator(const IndicatorDensity& indicator, double order,
                        std::span<const double> metrics) {
  double largest = 0.0;
  for (std::size_t i = 0; i < indicator.densities.size(); ++i) {
    const double density = densityOf(tensorAt(metrics, i));
    if (density > 0.0) largest = std::max(largest, indicator.densities[i] / density);
  }
  return indicator.largest * powerOf(largest, order / 3.0);
}

}  // namespace tetrafront
