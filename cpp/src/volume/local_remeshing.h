#pragma once

/// @file LocalRemeshing, Löhner's practice: the elements around a pocket are taken away, and the front tries
/// again there under other rules. A position that does not close is put back exactly as it was.

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

  /// Works on for about `budget` steps of the front; returns what it took.
  std::size_t work(std::uint32_t budget, PocketSet& pockets);
  /// All has been tried, or trying has cost too much.
  [[nodiscard]] bool isDone() const { return stage_ == Stage::kDone; }
  /// How far it is, 0 to 1: in tries, or in what they may cost.
  [[nodiscard]] double fraction() const;
  /// The elements of each position that has closed.
  [[nodiscard]] std::span<const IndexRange> made() const { return made_; }

 private:
  enum class Stage : std::uint8_t {
    kBeginPass,
    kIndex,    ///< the elements, once for each number of rings
    kRemesh,   ///< choose a pocket and open the position
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
  std::uint32_t pass_ = 0;  ///< one per number of rings and variant of the rules
  std::size_t nextPocket_ = 0;
  std::uint64_t cost_ = 0;  ///< of all attempts
  // Of the attempt being made:
  std::optional<EnlargedPocket> enlarged_;
  std::size_t elementsBefore_ = 0;
  std::size_t nodesBefore_ = 0;
  std::uint64_t costLeft_ = 0;
  std::vector<IndexRange> made_;
};

extern template class LocalRemeshing<NullTrace>;
extern template class LocalRemeshing<ClockTrace>;
extern template class LocalRemeshing<StepTrace>;

}  // namespace tetrafront
