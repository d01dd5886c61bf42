#pragma once

/// @file Closes the pockets that a stalled front leaves. Each is joined to one interior point
/// (star). If that fails, the elements around it are removed and the front advances again (local
/// remeshing, Löhner's practice). The exact fill comes last. All budgets are counts, so the result
/// does not depend on the speed of the machine.

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

  /// With `fillOnly`, only the exact fill is used.
  Recovery(Front& front, Elements& elements, FrontAdvance<Trace>& advance, FrontOrder order,
           bool fillOnly);

  /// Does work that costs about `budget` steps of the front. Call it when the queue of the front is
  /// empty.
  State advance(std::uint32_t budget);

  /// Estimated progress of the recovery and of the exact fill, 0 to 1.
  [[nodiscard]] double fraction() const;
  [[nodiscard]] double exactFillFraction() const { return filler_ ? filler_->fraction() : 0.0; }

  /// Counts what each method contributes to the mesh as it is now; elements that were removed again
  /// do not count. O(elements).
  [[nodiscard]] RecoverySummary summary() const;

 private:
  enum class Stage : std::uint8_t {
    kFindPockets,
    kStar,           ///< join each pocket to one point
    kFindRemaining,  ///< find the pockets that are left
    kRemesh,
    kFill,
    kFinished
  };

  /// Does one piece of work; returns its cost in steps of the front.
  std::size_t work(std::uint32_t budget);
  [[nodiscard]] bool hasLiveElement(const IndexRange& made) const;
  std::size_t starNext();
  void beginFill();
  /// Cost of visiting all active faces, in steps of the front.
  [[nodiscard]] std::size_t scanCost() const;

  Front& front_;
  Elements& elements_;
  FrontAdvance<Trace>& advance_;
  bool fillOnly_;
  Stage stage_ = Stage::kFindPockets;
  std::vector<Pocket> pockets_;  ///< before the stars
  std::size_t nextPocket_ = 0;
  std::vector<IndexRange> starred_;     ///< elements of each star
  std::optional<PocketSet> remaining_;  ///< pockets without a star
  ElementIndex index_;
  LocalRemeshing<Trace> remeshing_;
  std::optional<PocketFiller> filler_;
};

extern template class Recovery<NullTrace>;
extern template class Recovery<ClockTrace>;
extern template class Recovery<RecordingTrace>;

}  // namespace tetrafront
