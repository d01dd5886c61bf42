#pragma once

/// @file Finds the background tetrahedron of a place and interpolates there: a visibility walk
/// through face neighbours from the last tetrahedron hit (Löhner & Parikh 1988, section 6 (d)),
/// with a search over all of them where the walk fails.

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/status.h"

namespace tetrafront {

class GridLocator {
 public:
  struct Location {
    std::uint32_t tetrahedron = 0;
    std::array<double, 4> weights{};  ///< of the four nodes; sum 1, all >= 0
    bool inside = false;  ///< false if the place is outside the grid by more than rounding
  };

  /// `grid` must have passed checkBackgroundGrid().
  explicit GridLocator(BackgroundGrid grid);

  /// The tetrahedron that holds `place`, or the nearest one with the weights of its nearest point.
  [[nodiscard]] Location locate(const Vec3& place, std::uint32_t startTetrahedron) const;

  /// Wanted edge length: linear interpolation of the nodes' sizes.
  [[nodiscard]] double sizeAt(const Location& location) const;

  [[nodiscard]] const BackgroundGrid& grid() const { return grid_; }

 private:
  BackgroundGrid grid_;
};

/// Everything wrong with the grid itself, all at once; empty if it can be used.
[[nodiscard]] std::vector<Diagnostic> checkBackgroundGrid(const BackgroundGrid& grid);

}  // namespace tetrafront
