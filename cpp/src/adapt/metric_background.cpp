#include "adapt/metric_background.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "field/grid_access.h"
#include "field/grid_locator_builder.h"
#include "geom/exponential.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"

namespace tetrafront {

Task<MetricBackground> MetricBackground::build(Work& work, const BackgroundGrid& grid,
                                               std::span<const double> metrics) {
  work.beginPart(0.8);
  GridLocator locator = co_await buildGridLocator(work, grid);
  MetricBackground made(std::move(locator));
  made.given_.resize(grid.nodes.size());
  double low = 0.0;
  double high = 0.0;
  work.beginPart(1.0);
  co_await work.forEachBlock(grid.nodes.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      PrincipalAxes axes = principalAxes(tensorAt(metrics, i));
      for (double& value : axes.values) {
        if (high == 0.0) low = value;
        low = std::min(low, value);
        high = std::max(high, value);
        value = logarithm(value);
      }
      made.given_[i] = composed(axes);
    }
  });
  made.minSize_ = 1.0 / std::sqrt(high);
  made.maxSize_ = 1.0 / std::sqrt(low);
  made.logarithms_ = made.given_;
  co_return made;
}

void MetricBackground::setAdapted() {
  // A curved wall is inside the layer of thin elements between the chords of the background mesh: in one polar case of the
  // benchmark, densities there are 1 to 6 % off.
  constexpr double kDoubtBetweenNodes = 0.05;
  doubt_ = kDoubtBetweenNodes;
}

SymmetricTensor MetricBackground::metricAt(const GridLocator::Location& location) const {
  const GridNodeQuad nodes = nodesOf(locator_.grid(), location.tetrahedron);
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (std::size_t k = 0; k < 4; ++k)
    sum.accumulate(logarithms_[nodes[k].index()], location.weights[k]);
  return exponentialOf(sum);
}

SymmetricTensor MetricBackground::at(const Vec3& position, GridTetId& at) const {
  const GridLocator::Location found = locator_.locate(position, at);
  at = found.tetrahedron;
  return metricAt(found);
}

void MetricBackground::measure(AdaptNode& node) const {
  /// A node with this weight of a background node is at its place, up to rounding of the weights.
  constexpr double kAtNode = 1.0 - 1e-9;
  const GridLocator::Location found = locator_.locate(node.point, node.at);
  node.at = found.tetrahedron;
  node.metric = metricAt(found);
  node.density = std::sqrt(node.metric.determinant());
  node.doubt = std::ranges::max(found.weights) > kAtNode ? 0.0 : doubt_;
}

void MetricBackground::limitSizes(double size) {
  logarithms_ = given_;
  if (size <= minSize_) return;
  const double largest = -2.0 * logarithm(size);
  for (SymmetricTensor& tensor : logarithms_) {
    PrincipalAxes axes = principalAxes(tensor);
    for (double& value : axes.values) value = std::min(value, largest);
    tensor = composed(axes);
  }
}

}  // namespace tetrafront
