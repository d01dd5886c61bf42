#pragma once

/// @file The metric that an adaptation follows: given at the nodes of a background mesh, and interpolated between them by the
/// logarithms.

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "base/task.h"
#include "field/grid_locator.h"
#include "metric/symmetric_tensor.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

class MetricBackground {
 public:
  /// `grid` must have passed checkBackgroundGrid(); its sizes are ignored. `metrics`: six numbers per node
  /// (symmetric_tensor.h), positive definite.
  static Task<MetricBackground> build(Work& work, const BackgroundGrid& grid,
                                      std::span<const double> metrics);

  /// Returns the metric at a position. `at`: the element to start from; becomes the one that holds the position, or the nearest.
  [[nodiscard]] SymmetricTensor at(const Vec3& position, GridTetId& at) const;

  /// Call when the adaptation begins with the background mesh, and this is nearly adapted to its metrics. From then on, the
  /// densities of nodes between those of the background mesh are in doubt, so that the same elements are poor if the metrics
  /// are given at all nodes.
  void setAdapted();

  /// Sets the metric of a node, and its density with its doubt, at its position.
  void measure(AdaptNode& node) const;

  /// Makes all sizes at least `size`; 0 for the given ones.
  void limitSizes(double size);

  [[nodiscard]] double minSize() const { return minSize_; }
  [[nodiscard]] double maxSize() const { return maxSize_; }

 private:
  explicit MetricBackground(GridLocator locator) : locator_(std::move(locator)) {}

  [[nodiscard]] SymmetricTensor metricAt(const GridLocator::Location& location) const;

  GridLocator locator_;
  std::vector<SymmetricTensor> given_;       ///< logarithms per node
  std::vector<SymmetricTensor> logarithms_;  ///< with limited sizes
  double doubt_ = 0.0;                       ///< of densities between the nodes
  double minSize_ = 0.0;
  double maxSize_ = 0.0;
};

}  // namespace tetrafront
