#pragma once

/// @file Finds the background tetrahedron that contains a position, and interpolates there. Walks
/// through face neighbours from the previous tetrahedron (Löhner & Parikh 1988, section 6 (d)); if
/// the walk fails, searches all tetrahedra.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "field/size_tensor.h"
#include "search/box_tree.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

class ByteReader;

class GridLocator {
 public:
  struct Location {
    GridTetId tetrahedron{0U};
    std::array<double, 4> weights{};  ///< weights of the four nodes, >= 0, sum 1
    bool inside = false;  ///< false if outside by more than rounding and the grid's coverageMargin
    std::uint32_t steps = 0;  ///< steps of the walk from one tetrahedron to the next
  };

  /// `grid` must have passed checkBackgroundGrid(); its sources are ignored. `growth` > 0 limits
  /// the sizes of its nodes (grid_gradation.h). Builds the locator in one call; O(n log n).
  explicit GridLocator(const BackgroundGrid& grid, double growth = 0.0);

  /// Returns the tetrahedron that contains `position`, the lowest one on a face of several, or the nearest one, with the weights of
  /// its nearest point. Only the number of steps depends on the start. A few steps from a near start, O(n^(1/3)) from a far one, O(log n) after a
  /// failed walk.
  [[nodiscard]] Location locate(const Vec3& position, GridTetId start) const;

  /// Interpolates the nodes' sizes linearly: the target edge length if nothing is stretched.
  [[nodiscard]] double sizeAt(const Location& location) const;

  /// Interpolates the nodes' size tensors H linearly; if any node has a second stretching, their logarithms
  /// (metric/metric.h). The linear mean of two thin elements of different directions is far thicker than both.
  [[nodiscard]] SymmetricTensor tensorAt(const Location& location) const;

  /// Whether any node has a stretching or a second one other than 1.
  [[nodiscard]] bool isStretched() const { return !tensors_.empty(); }

  [[nodiscard]] const BackgroundGrid& grid() const { return grid_; }

  template <class Self, class Visit>
  static void visitMembers(Self& self, Visit& visit) {
    visit(self.grid_.nodes, self.grid_.tetrahedra, self.grid_.coverageMargin, self.tensors_,
          self.isLogarithmic_, self.frames_, self.sizes_, self.tree_, self.maxSteps_, self.slack_);
  }

 private:
  /// The data of a tetrahedron that a walk needs, contiguous in memory: the linear functions that
  /// are the weights of nodes 1, 2 and 3 and vanish at node 0, and the neighbour across the face
  /// opposite to each node.
  struct Frame {
    Vec3 origin;
    std::array<Vec3, 3> gradients;
    std::array<GridTetId, 4> neighbours;  ///< none at the border
  };

  friend class GridLocatorBuilder;
  friend class ByteReader;
  GridLocator() = default;

  [[nodiscard]] std::array<double, 4> weightsAt(GridTetId tet, const Vec3& position) const;
  [[nodiscard]] Location lowestAround(GridTetId tet, const Vec3& position,
                                      const std::array<double, 4>& weights) const;
  [[nodiscard]] Location nearest(const Vec3& position, GridTetId guess) const;
  [[nodiscard]] double allowanceAt(GridTetId tet) const;

  BackgroundGrid grid_;
  std::vector<SymmetricTensor> tensors_;  ///< per node; empty if nothing is stretched
  bool isLogarithmic_ = false;            ///< `tensors_` are the logarithms of H
  std::vector<Frame> frames_;
  std::vector<double> sizes_;  ///< per node, contiguous for the cache
  BoxTree tree_;
  std::uint32_t maxSteps_ = 0;
  double slack_ = 0.0;  ///< distance outside the grid that counts as rounding
};

}  // namespace tetrafront
