#pragma once

/// @file Local remeshing, Löhner's practice: removes the elements around a pocket and advances the
/// front there again under other rules. A pocket that does not close is restored exactly.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/task.h"
#include "volume/element_index.h"
#include "volume/elements.h"
#include "volume/enlarged_pocket.h"
#include "volume/front.h"
#include "volume/front_advance.h"

namespace tetrafront {

class LocalRemeshing {
 public:
  LocalRemeshing(Front& front, Elements& elements, FrontAdvance& advance, FrontOrder order,
                 ElementIndex& index)
      : front_(front), elements_(elements), advance_(advance), order_(order), index_(index) {}

  /// Tries all pockets, under each rule variant with each number of rings, until the attempts have cost too much.
  Task<> run(Work& work, PocketSet& pockets);
  /// The elements of each pocket that was closed.
  [[nodiscard]] std::span<const IndexRange> made() const { return made_; }

 private:
  struct Attempt;

  [[nodiscard]] std::uint64_t costLimit() const;
  std::optional<Attempt> open(PocketSet& pockets, PocketId pocket);
  std::size_t close(PocketSet& pockets, const Attempt& attempt);
  [[nodiscard]] double fraction() const;

  Front& front_;
  Elements& elements_;
  FrontAdvance& advance_;
  FrontOrder order_;
  ElementIndex& index_;
  std::uint32_t pass_ = 0;  ///< one pass per number of rings and rule variant
  std::uint64_t cost_ = 0;  ///< total cost of all attempts
  std::vector<IndexRange> made_;
};

}  // namespace tetrafront
