#pragma once

/// @file Finds the background tetrahedron of a place and interpolates there: a visibility walk
/// through face neighbours from the last tetrahedron hit (Löhner & Parikh 1988, section 6 (d)),
/// with a search over all of them where the walk fails.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "field/size_tensor.h"
#include "search/box_tree.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

class GridLocator {
 public:
  struct Location {
    std::uint32_t tetrahedron = 0;
    std::array<double, 4> weights{};  ///< of the four nodes; sum 1, all >= 0
    bool inside = false;  ///< false if outside by more than rounding and the grid's coverageMargin
    std::uint32_t steps = 0;  ///< of the walk, from one tetrahedron to the next
  };

  /// `grid` must have passed checkBackgroundGrid(); its sources are not looked at. `growth` > 0
  /// limits the sizes of its nodes (grid_gradation.h). O(n log n), all at once.
  explicit GridLocator(BackgroundGrid grid, double growth = 0.0);

  /// The tetrahedron that holds `place`, or the nearest one with the weights of its nearest point.
  /// A few steps from a near start; O(n^(1/3)) from a far one; O(log n) after a failed walk.
  [[nodiscard]] Location locate(const Vec3& place, std::uint32_t startTetrahedron) const;

  /// Linear interpolation of the nodes' sizes: the wanted edge length where nothing is stretched.
  [[nodiscard]] double sizeAt(const Location& location) const;

  /// Linear interpolation of the nodes' size tensors H.
  [[nodiscard]] SymmetricTensor tensorAt(const Location& location) const;

  /// Whether any node asks for a stretching other than 1.
  [[nodiscard]] bool isStretched() const { return !tensors_.empty(); }

  [[nodiscard]] const BackgroundGrid& grid() const { return grid_; }

 private:
  /// What a walk needs of a tetrahedron, side by side in memory: the linear functions that are the
  /// weights of nodes 1, 2, 3, which vanish at node 0; what is across the face opposite to node i.
  struct Frame {
    Vec3 origin;
    std::array<Vec3, 3> gradients;
    std::array<std::uint32_t, 4> neighbours;
  };

  friend class GridLocatorBuilder;
  GridLocator() = default;

  [[nodiscard]] std::array<double, 4> weightsAt(std::uint32_t tetrahedron, const Vec3& place) const;
  [[nodiscard]] Location nearest(const Vec3& place, std::uint32_t guess) const;
  [[nodiscard]] double allowanceAt(std::uint32_t tetrahedron) const;

  BackgroundGrid grid_;
  std::vector<SymmetricTensor> tensors_;  ///< per node; empty where nothing is stretched
  std::vector<Frame> frames_;
  std::vector<double> sizes_;  ///< per node, close together
  BoxTree tree_;
  std::uint32_t maxSteps_ = 0;
  double slack_ = 0.0;  ///< how far outside counts as rounding
};

}  // namespace tetrafront
