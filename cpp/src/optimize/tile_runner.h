#pragma once

/// @file Who optimizes the tiles of a mesh: the task that cut them, one after the other, with the help of other engines if their host
/// borrows tiles (tile_lender.h); or threads. The tiles do not depend on each other, so the order in which they are done changes
/// nothing.

#include <span>

#include "base/task.h"
#include "field/size_field.h"
#include "optimize/tiles.h"
#include "tetrafront/options.h"

namespace tetrafront {

/// What is done to each tile: the shape steps of a level.
struct TileSteps {
  const SizeField& field;
  Optimization level;

  /// Optimizes a mesh, which is valid at any time.
  Task<> run(Work& work, TetMesh& mesh) const;
};

/// Virtual calls cost nothing here: a tile takes tenths of a second.
class TileRunner {
 public:
  TileRunner() = default;
  TileRunner(const TileRunner&) = delete;
  TileRunner& operator=(const TileRunner&) = delete;
  virtual ~TileRunner() = default;

  /// Optimizes all tiles. They and the steps must outlive the task.
  virtual Task<> run(Work& work, std::span<Tile> tiles, const TileSteps& steps) = 0;
};

}  // namespace tetrafront
