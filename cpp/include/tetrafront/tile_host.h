#pragma once

/// @file Lends the tiles of a large mesh to other engines while a run optimizes them: engines in other workers or processes, but of the
/// same build. A tile and its result are arrays. The mesh is the same, bit for bit, whichever tiles are lent: the run
/// does the others itself meanwhile.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/mesher.h"

namespace tetrafront {

/// The elements of a tile.
struct TileMesh {
  std::vector<double> points;             ///< x y z per node
  std::vector<std::uint32_t> tetrahedra;  ///< four nodes per element
  std::vector<std::uint32_t> regions;     ///< per element
  std::vector<std::uint8_t> isFixed;      ///< per node: 1 if it stays where it is
};

struct LentTile {
  std::uint32_t id = 0;  ///< 0 if no tile waits
  TileMesh mesh;
};

/// The run as the host sees it that lends its tiles. The run must outlive this; calls are for the time between two calls of
/// MeshRun::advance().
class TileHost {
 public:
  explicit TileHost(MeshRun& run) : run_(run) {}

  /// Returns how many tiles could be lent now; 0 unless the run optimizes tiles.
  [[nodiscard]] std::uint32_t waitingCount() const;
  /// Returns whether the run can only wait for tiles that are lent: calls of advance() do nothing until one comes back.
  [[nodiscard]] bool isWaiting() const;

  /// Returns what a TileOptimizer needs for all tiles of the run: the sizes, and the level of the optimization. Empty unless the run
  /// optimizes tiles. Copies the size field.
  [[nodiscard]] std::vector<std::uint8_t> steps() const;

  /// Lends a tile that waits.
  [[nodiscard]] LentTile lend();
  /// Takes the result of a tile. Returns false, and withdraws the tile, if that cannot be its result. Ignores tiles that are not
  /// lent, such as those of a run that was cancelled.
  bool giveBack(std::uint32_t id, const TileMesh& result);
  /// The run does the tile itself or lends it again: the engine that had it has failed. Ignores tiles that are not lent.
  void withdraw(std::uint32_t id);

 private:
  MeshRun& run_;
};

/// Optimizes tiles of a run, one after the other.
class TileOptimizer {
 public:
  /// `steps`: of a TileHost. Throws std::out_of_range if they are incomplete.
  explicit TileOptimizer(std::span<const std::uint8_t> steps);
  TileOptimizer(TileOptimizer&&) noexcept;
  TileOptimizer& operator=(TileOptimizer&&) noexcept;
  ~TileOptimizer();

  /// Begins a tile; one that was begun before is forgotten.
  void begin(const TileMesh& tile);
  /// Does about `budget` units of work, as MeshRun::advance(); true when the tile is done, or none has begun.
  bool advance(std::uint32_t budget);
  /// Returns the tile as it is now; a valid mesh at any time.
  [[nodiscard]] TileMesh result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
