#pragma once

/// @file Local remeshing, Löhner's practice: removes the elements around a pocket and advances the
/// front there again under other rules. A pocket that does not close is restored exactly.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "volume/element_index.h"
#include "volume/elements.h"
#include "volume/enlarged_pocket.h"
#include "volume/front.h"
#include "volume/front_advance.h"

namespace tetrafront {

template <class Trace>
class LocalRemeshing {
 public:
  LocalRemeshing(Front& front, Elements& elements, FrontAdvance<Trace>& advance, FrontOrder order,
                 ElementIndex& index)
      : front_(front), elements_(elements), advance_(advance), order_(order), index_(index) {}

  /// Does work that costs about `budget` steps of the front; returns the actual cost.
  std::size_t work(std::uint32_t budget, PocketSet& pockets);
  /// Returns true if everything has been tried, or if the attempts have cost too much.
  [[nodiscard]] bool isDone() const { return stage_ == Stage::kDone; }
  /// Estimated progress, 0 to 1: passes done, or cost used, whichever is more.
  [[nodiscard]] double fraction() const;
  /// The elements of each pocket that was closed.
  [[nodiscard]] std::span<const IndexRange> made() const { return made_; }

 private:
  enum class Stage : std::uint8_t {
    kBeginPass,
    kIndex,    ///< index the elements, once for each number of rings
    kRemesh,   ///< choose a pocket and enlarge it
    kAdvance,  ///< fill it again
    kDone
  };

  [[nodiscard]] std::uint64_t costLimit() const;
  void beginPass();
  std::size_t enlargeNext(PocketSet& pockets);
  std::size_t advanceFront(std::uint32_t budget, PocketSet& pockets);
  std::size_t finish(PocketSet& pockets);

  Front& front_;
  Elements& elements_;
  FrontAdvance<Trace>& advance_;
  FrontOrder order_;
  ElementIndex& index_;
  Stage stage_ = Stage::kBeginPass;
  std::uint32_t pass_ = 0;  ///< one pass per number of rings and rule variant
  std::size_t nextPocket_ = 0;
  std::uint64_t cost_ = 0;  ///< total cost of all attempts
  // State of the current attempt.
  std::optional<EnlargedPocket> enlarged_;
  std::size_t elementsBefore_ = 0;
  std::size_t nodesBefore_ = 0;
  std::uint64_t costLeft_ = 0;
  std::vector<IndexRange> made_;
};

extern template class LocalRemeshing<NullTrace>;
extern template class LocalRemeshing<ClockTrace>;
extern template class LocalRemeshing<RecordingTrace>;

}  // namespace tetrafront
