#include "adapt/metric_background.h"

#include <cmath>

#include "field/grid_access.h"
#include "field/grid_locator_builder.h"
#include "geom/exponential.h"
#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "metric/principal_axes.h"
#include "solution/recovered_hessian.h"
#include "tetrafront/mesh.h"

namespace tetrafront {
namespace {

VolumeMesh meshOf(const BackgroundGrid& grid) {
  VolumeMesh mesh;
  mesh.points.reserve(3 * grid.nodes.size());
  for (const BackgroundNode& node : grid.nodes) {
    for (const double x : {node.position.x, node.position.y, node.position.z})
      mesh.points.push_back(x);
  }
  mesh.tetrahedra.reserve(4 * grid.tetrahedra.size());
  for (const auto& nodes : grid.tetrahedra)
    mesh.tetrahedra.insert(mesh.tetrahedra.end(), nodes.begin(), nodes.end());
  return mesh;
}

}  // namespace

Task<MetricBackground> MetricBackground::build(Work& work, const BackgroundGrid& grid,
                                               std::span<const double> metrics) {
  work.beginPart(0.3);
  GridLocator locator = co_await buildGridLocator(work, grid);
  MetricBackground made(std::move(locator));
  work.beginPart(0.4);
  co_await work.forEachBlock(grid.nodes.size(), [&](std::size_t first, std::size_t last) {
    made.readLogarithms(metrics, first, last);
  });
  made.limitSizes(0.0);
  work.beginPart(1.0);
  co_await made.findBends(work);
  co_return made;
}

void MetricBackground::readLogarithms(std::span<const double> metrics, std::size_t first,
                                      std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    PrincipalAxes axes = principalAxes(tensorAt(metrics, i));
    for (double& value : axes.values) {
      const double size = 1.0 / std::sqrt(value);
      minSize_ = minSize_ == 0.0 ? size : std::min(minSize_, size);
      maxSize_ = std::max(maxSize_, size);
      value = logarithm(value);
    }
    logarithms_.push_back(composed(axes));
  }
}

/// A linear function between the nodes differs from a quadratic one with the Hessian H by -d H d / 2, summed over the nodes with
/// their weights, where d is the offset from the node.
Task<> MetricBackground::findBends(Work& work) {
  const VolumeMesh mesh = meshOf(locator_.grid());
  const std::size_t nodes = logarithms_.size();
  std::vector<double> values(kTensorNumbers * nodes);
  for (std::size_t i = 0; i < nodes; ++i) putTensor(values, i, logarithms_[i]);
  work.beginPart(0.2);
  const MeshEdges edges = co_await edgesOf(work, mesh);
  work.beginPart(0.95);
  const SampledValues samples{values, kTensorNumbers, false};
  const std::vector<double> hessians = co_await recoverHessians(work, mesh, edges, samples);
  work.beginPart(1.0);
  bends_.resize(nodes);
  co_await work.forEachBlock(nodes, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      // One Hessian per number of the tensor; the numbers of a bend are those of the tensor, per number of the Hessian.
      std::array<SymmetricTensor, kTensorNumbers> own;
      for (std::size_t c = 0; c < kTensorNumbers; ++c) own[c] = tensorAt(hessians, nodes * c + i);
      const auto bend = [&](double SymmetricTensor::* number, double factor) {
        std::array<double, kTensorNumbers> parts{};
        for (std::size_t c = 0; c < kTensorNumbers; ++c) parts[c] = factor * own[c].*number;
        return tensorAt(parts, 0);
      };
      bends_[i] = {bend(&SymmetricTensor::xx, -0.5), bend(&SymmetricTensor::yy, -0.5),
                   bend(&SymmetricTensor::zz, -0.5), bend(&SymmetricTensor::xy, -1.0),
                   bend(&SymmetricTensor::xz, -1.0), bend(&SymmetricTensor::yz, -1.0)};
    }
  });
}

SymmetricTensor MetricBackground::at(const Vec3& position, GridTetId& at) const {
  const GridLocator::Location found = locator_.locate(position, at);
  at = found.tetrahedron;
  const BackgroundGrid& grid = locator_.grid();
  const GridNodeQuad nodes = nodesOf(grid, at);
  std::array<Vec3, 4> corners{};
  Vec3 foot(0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    corners[k] = positionOf(grid, nodes[k]);
    foot += found.weights[k] * corners[k];
  }
  SymmetricTensor sum = SymmetricTensor::isotropic(0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const double weight = found.weights[k];
    if (weight == 0.0) continue;
    sum.accumulate(logarithms_[nodes[k].index()], weight);
    const Vec3 d = foot - corners[k];
    const std::array products{d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z};
    const Bend& bend = bends_[nodes[k].index()];
    for (std::size_t m = 0; m < products.size(); ++m) sum.accumulate(bend[m], weight * products[m]);
  }
  PrincipalAxes axes = principalAxes(sum);
  const double low = 1.0 / (maxSize_ * maxSize_);
  const double high = 1.0 / (least_ * least_);
  for (double& value : axes.values)
    value = std::clamp(exponential(value), std::min(low, high), high);
  return composed(axes);
}

}  // namespace tetrafront
