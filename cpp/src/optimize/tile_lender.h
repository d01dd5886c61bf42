#pragma once

/// @file Optimizes one tile after the other, and lends tiles that wait to a host that has other engines. A lent tile stays as it is
/// until its result comes back, so the mesh is valid at any time; if it is withdrawn instead, it waits again.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/task.h"
#include "optimize/tile_runner.h"
#include "topology/tet_mesh.h"

namespace tetrafront {

class TileLender final : public TileRunner {
 public:
  /// Tiles of earlier runs, and of runs that were cancelled, have other ids.
  Task<> run(Work& work, std::span<Tile> tiles, const TileSteps& steps) override;

  /// What is done to tiles; none unless they are worked on.
  [[nodiscard]] const TileSteps* steps() const { return steps_; }
  /// Returns how many tiles could be lent.
  [[nodiscard]] std::size_t waitingCount() const { return waiting_; }
  /// Returns whether all tiles that are not done are lent.
  [[nodiscard]] bool isWaitingForLent() const { return lent_ > 0 && waiting_ == 0 && !isAtWork_; }

  /// Lends a tile: its id, above 0; none if no tile waits.
  [[nodiscard]] std::optional<std::uint32_t> lend();
  /// Returns a tile that is lent; null if none with this id is.
  [[nodiscard]] const Tile* lentTile(std::uint32_t id) const;
  /// Takes the result of a tile that is lent; it must have the same fixed nodes, in their order.
  void giveBack(std::uint32_t id, TetMesh mesh);
  /// The tile waits again. Does nothing unless it is lent.
  void withdraw(std::uint32_t id);

 private:
  enum class State : std::uint8_t { kWaiting, kAtWork, kLent, kDone };
  /// Ends the loans when the tiles are done or the run is cancelled.
  class Loans;

  /// Returns the first tile that waits, if any, and gives it another state.
  std::optional<std::size_t> take(State state);
  [[nodiscard]] std::optional<std::size_t> indexOfLent(std::uint32_t id) const;

  std::span<Tile> tiles_;
  const TileSteps* steps_ = nullptr;
  std::vector<State> states_;  ///< per tile
  std::size_t waiting_ = 0;
  std::size_t lent_ = 0;
  bool isAtWork_ = false;
  std::uint32_t firstId_ = 1;
};

}  // namespace tetrafront
