#include "optimize/tile_lender.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

class TileLender::Loans {
 public:
  Loans(TileLender& lender, std::span<Tile> tiles, const TileSteps& steps) : lender_(lender) {
    lender_.tiles_ = tiles;
    lender_.steps_ = &steps;
    lender_.states_.assign(tiles.size(), State::kWaiting);
    lender_.waiting_ = tiles.size();
  }
  Loans(const Loans&) = delete;
  Loans& operator=(const Loans&) = delete;
  ~Loans() {
    lender_.firstId_ += static_cast<std::uint32_t>(lender_.tiles_.size());
    lender_.tiles_ = {};
    lender_.steps_ = nullptr;
    lender_.states_.clear();
    lender_.waiting_ = 0;
    lender_.lent_ = 0;
    lender_.isAtWork_ = false;
  }

 private:
  TileLender& lender_;
};

Task<> TileLender::run(Work& work, std::span<Tile> tiles, const TileSteps& steps) {
  const Loans loans(*this, tiles, steps);
  const auto count = static_cast<double>(tiles.size());
  while (waiting_ + lent_ > 0) {
    const std::optional<std::size_t> tile = take(State::kAtWork);
    if (!tile) {
      co_await work.yield();
      continue;
    }
    isAtWork_ = true;
    work.beginPart((count - static_cast<double>(waiting_ + lent_)) / count);
    co_await steps.run(work, tiles[*tile].mesh);
    states_[*tile] = State::kDone;
    isAtWork_ = false;
  }
}

std::optional<std::size_t> TileLender::take(State state) {
  if (waiting_ == 0) return {};
  const auto found = std::ranges::find(states_, State::kWaiting);
  *found = state;
  --waiting_;
  return static_cast<std::size_t>(found - states_.begin());
}

std::optional<std::uint32_t> TileLender::lend() {
  const std::optional<std::size_t> tile = take(State::kLent);
  if (!tile) return {};
  ++lent_;
  return firstId_ + static_cast<std::uint32_t>(*tile);
}

std::optional<std::size_t> TileLender::indexOfLent(std::uint32_t id) const {
  if (id < firstId_ || id - firstId_ >= states_.size()) return {};
  if (states_[id - firstId_] != State::kLent) return {};
  return id - firstId_;
}

const Tile* TileLender::lentTile(std::uint32_t id) const {
  const std::optional<std::size_t> tile = indexOfLent(id);
  return tile ? &tiles_[*tile] : nullptr;
}

void TileLender::giveBack(std::uint32_t id, TetMesh mesh) {
  const std::optional<std::size_t> tile = indexOfLent(id);
  if (!tile) return;
  tiles_[*tile].mesh = std::move(mesh);
  states_[*tile] = State::kDone;
  --lent_;
}

void TileLender::withdraw(std::uint32_t id) {
  const std::optional<std::size_t> tile = indexOfLent(id);
  if (!tile) return;
  states_[*tile] = State::kWaiting;
  --lent_;
  ++waiting_;
}

}  // namespace tetrafront
