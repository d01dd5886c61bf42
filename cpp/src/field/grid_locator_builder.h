#pragma once

/// @file Builds a GridLocator in slices.

#include <cstdint>
#include <memory>

#include "field/grid_locator.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

class GridLocatorBuilder {
 public:
  /// Parameters as of GridLocator.
  explicit GridLocatorBuilder(BackgroundGrid grid, double growth = 0.0);
  GridLocatorBuilder(GridLocatorBuilder&&) noexcept;
  GridLocatorBuilder& operator=(GridLocatorBuilder&&) noexcept;
  ~GridLocatorBuilder();

  /// Visits about `budget` tetrahedra and returns true when finished. Each is visited some tens of times.
  bool advance(std::uint32_t budget);

  /// Returns the locator, once finished.
  [[nodiscard]] GridLocator take();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
