/// @file Threads that optimize tiles, in native builds.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "base/task.h"
#include "mesh_run.h"
#include "optimize/tile_runner.h"
#include "tetrafront/threads.h"

namespace tetrafront {
namespace {

/// Budget between two looks at whether the work was cancelled: some milliseconds.
constexpr std::uint32_t kBudgetOfThread = 2000;
constexpr std::chrono::milliseconds kWait{20};

/// Threads that work until all tiles are done, or until this is destroyed.
class TileThreads {
 public:
  /// The tiles stay as they are until takeResults(), so that others may read them meanwhile.
  TileThreads(std::span<Tile> tiles, const TileSteps& steps, unsigned count)
      : tiles_(tiles), steps_(steps), results_(tiles.size()) {
    const std::size_t useful = std::min<std::size_t>(count, tiles.size());
    for (std::size_t i = 0; i < useful; ++i) threads_.emplace_back([this] { work(); });
  }
  TileThreads(const TileThreads&) = delete;
  TileThreads& operator=(const TileThreads&) = delete;
  ~TileThreads() { join(); }

  /// Waits for some milliseconds; returns whether all tiles are done or one has failed.
  [[nodiscard]] bool wait() {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kWait, [this] { return isFinished(); });
  }
  [[nodiscard]] double fraction() {
    const std::scoped_lock lock(mutex_);
    return static_cast<double>(done_) / static_cast<double>(tiles_.size());
  }

  /// Puts the results into the tiles, or throws what a thread has thrown.
  void takeResults() {
    join();
    if (failure_) std::rethrow_exception(failure_);
    for (std::size_t i = 0; i < tiles_.size(); ++i) tiles_[i].mesh = std::move(results_[i]);
  }

 private:
  [[nodiscard]] bool isFinished() const { return done_ == tiles_.size() || failure_; }

  void join() {
    isStopped_ = true;
    threads_.clear();
  }

  void work() noexcept {
    for (std::size_t i = next_++; i < tiles_.size() && !isStopped_; i = next_++) {
      std::exception_ptr failure;
      try {
        optimize(i);
      } catch (...) {
        failure = std::current_exception();
      }
      if (isStopped_) return;
      const std::scoped_lock lock(mutex_);
      ++done_;
      if (failure) {
        failure_ = failure;
        isStopped_ = true;
      }
      if (isFinished()) changed_.notify_all();
    }
  }

  void optimize(std::size_t tile) {
    results_[tile] = tiles_[tile].mesh;
    Job job([&](Work& work) { return steps_.run(work, results_[tile]); });
    while (!isStopped_ && !job.advance(kBudgetOfThread)) {
    }
  }

  std::span<Tile> tiles_;
  const TileSteps& steps_;
  std::vector<TetMesh> results_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t done_ = 0;  ///< guarded by the mutex, as failure_ is
  std::exception_ptr failure_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> isStopped_ = false;
  std::vector<std::jthread> threads_;  ///< the last member: they use the others
};

class TilesOnThreads final : public TileRunner {
 public:
  explicit TilesOnThreads(unsigned count) : count_(count) {}

  Task<> run(Work& work, std::span<Tile> tiles, const TileSteps& steps) override {
    if (tiles.empty()) co_return;
    TileThreads threads(tiles, steps, count_);
    while (!threads.wait()) {
      work.setFraction(threads.fraction());
      co_await work.yield();
    }
    threads.takeResults();
  }

 private:
  unsigned count_;
};

}  // namespace

void useThreads(MeshRun& run, unsigned count) {
  if (count > 1) run.impl_->runTilesBy(std::make_unique<TilesOnThreads>(count));
}

}  // namespace tetrafront
