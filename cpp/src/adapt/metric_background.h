#pragma once

/// @file The metric that an adaptation follows: given at the nodes of a background mesh. Between them, the logarithms are
/// interpolated: linearly, less the error that their second derivatives predict. On a curved boundary, an edge of unit length can
/// leave the layer of thin elements at the boundary, so linear interpolation alone would take the sizes of other layers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

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

  /// Makes all sizes at least `size`; 0 for the given ones.
  void limitSizes(double size) { least_ = std::max(size, minSize_); }

  [[nodiscard]] double minSize() const { return minSize_; }
  [[nodiscard]] double maxSize() const { return maxSize_; }

 private:
  /// Per product x x, y y, z z, x y, x z, y z of the offset from a node: what the logarithm loses there by linear interpolation.
  using Bend = std::array<SymmetricTensor, 6>;

  explicit MetricBackground(GridLocator locator) : locator_(std::move(locator)) {}
  void readLogarithms(std::span<const double> metrics, std::size_t first, std::size_t last);
  Task<> findBends(Work& work);

  GridLocator locator_;
  std::vector<SymmetricTensor> logarithms_;  ///< per node
  std::vector<Bend> bends_;                  ///< per node
  double minSize_ = 0.0;
  double maxSize_ = 0.0;
  double least_ = 0.0;  ///< the limit of all sizes
};

}  // namespace tetrafront
