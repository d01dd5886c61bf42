#pragma once

/// @file Closes the pockets that a stalled front leaves. Each is joined to one interior point
/// (star). If that fails, the elements around it are removed and the front advances again (local
/// remeshing, Löhner's practice). The exact fill comes last. All budgets are counts, so the result
/// does not depend on the speed of the machine.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/task.h"
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

class Recovery {
 public:
  /// With `fillOnly`, only the exact fill is used.
  Recovery(Front& front, Elements& elements, FrontAdvance& advance, FrontOrder order,
           bool fillOnly);

  /// Closes the front, whose queue must be empty; returns false if faces are left.
  Task<bool> run(Work& work);

  /// Estimated progress of the exact fill, 0 to 1; never decreases, although a failed try lowers the filler's own estimate.
  [[nodiscard]] double exactFillFraction() const { return exactFill_; }

  /// Counts what each method contributes to the mesh as it is now; elements that were removed again
  /// do not count. O(elements).
  [[nodiscard]] RecoverySummary summary() const;

 private:
  void star(const Pocket& pocket);
  Task<> fillExactly(Work& work);
  [[nodiscard]] bool hasLiveElement(const IndexRange& made) const;
  /// Cost of visiting all active faces, in steps of the front.
  [[nodiscard]] std::size_t scanCost() const;

  Front& front_;
  Elements& elements_;
  FrontAdvance& advance_;
  bool fillOnly_;
  std::vector<IndexRange> starred_;     ///< elements of each star
  std::optional<PocketSet> remaining_;  ///< pockets without a star
  ElementIndex index_;
  LocalRemeshing remeshing_;
  std::optional<PocketFiller> filler_;
  double exactFill_ = 0.0;
};

}  // namespace tetrafront
