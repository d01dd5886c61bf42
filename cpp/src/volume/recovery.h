#pragma once

/// @file What is done about a stall. When no face can be completed under any rule, the pockets left are
/// closed one by one: by joining them to one interior point (star), else by reopening the position (Löhner's
/// practice), else by the exact fill. All budgets are counts, so the outcome never depends on the
/// machine's speed.

#include <cstdint>
#include <optional>
#include <vector>

#include "tetrafront/status.h"
#include "volume/element_index.h"
#include "volume/elements.h"
#include "volume/enlarged_pocket.h"
#include "volume/front.h"
#include "volume/front_advance.h"
#include "volume/local_remeshing.h"
#include "volume/pocket_filler.h"
#include "volume/pockets.h"

namespace tetrafront {

template <class Trace>
class Recovery {
 public:
  enum class State : std::uint8_t { kRunning, kClosed, kStalled };

  /// `fillOnly`: nothing but the exact fill is tried.
  Recovery(Front& front, Elements& elements, FrontAdvance<Trace>& advance, FrontOrder order,
           bool fillOnly);

  /// Works on for about `budget` steps of the front. To be called when nothing is queued.
  State advance(std::uint32_t budget);

  /// How far it is, and how far the exact fill is, both 0 to 1 and estimated.
  [[nodiscard]] double fraction() const;
  [[nodiscard]] double exactFillFraction() const { return filler_ ? filler_->fraction() : 0.0; }

  /// What the mesh as it is now has of each rung, without what a larger position has taken away again.
  /// O(elements).
  [[nodiscard]] RecoverySummary summary() const;

 private:
  enum class Stage : std::uint8_t {
    kFindPockets,
    kStar,           ///< each pocket from one point
    kFindRemaining,  ///< the pockets that are left
    kRemesh,
    kFill,
    kFinished
  };

  /// One piece of work; returns what it cost, in faces taken from the front.
  std::size_t work(std::uint32_t budget);
  [[nodiscard]] bool hasLiveElement(const IndexRange& made) const;
  std::size_t starNext();
  void beginFill();
  /// What looking at all active faces costs, in faces taken from the front.
  [[nodiscard]] std::size_t scanCost() const;

  Front& front_;
  Elements& elements_;
  bool fillOnly_;
  Stage stage_ = Stage::kFindPockets;
  std::vector<Pocket> pockets_;  ///< before any is starred
  std::size_t nextPocket_ = 0;
  std::vector<IndexRange> starred_;  ///< elements of each star
  std::optional<PocketSet> left_;    ///< the pockets that have no star
  ElementIndex index_;
  LocalRemeshing<Trace> remeshing_;
  std::optional<PocketFiller> filler_;
};

extern template class Recovery<NullTrace>;
extern template class Recovery<ClockTrace>;
extern template class Recovery<StepTrace>;

}  // namespace tetrafront
