#pragma once

/// @file Stops a front that would advance for ever, because its bookkeeping is broken or its
/// boundary is not closed. A valid front never reaches these limits.

#include <cstddef>
#include <cstdint>

#include "volume/rules.h"

namespace tetrafront {

class FrontProgress {
 public:
  /// Records one step and the number of active faces after it.
  void recordStep(bool hasMadeElement, std::uint32_t activeFaces) {
    stepsWithoutElement_ = hasMadeElement ? 0 : stepsWithoutElement_ + 1;
    activeFaces_ = activeFaces;
  }

  /// Returns true if too many consecutive steps have made no element: until the front changes, each
  /// face can fail only once under each rule class. Also returns true if the elements fill more
  /// than the boundary encloses. Both volumes are in the same unit; `extent` is the size of the
  /// model.
  [[nodiscard]] bool isStuck(double filledVolume, double enclosedVolume, double extent) const {
    // Far above the rounding errors of the sums, even if the elements are needles.
    constexpr double kExcess = 0.5;
    constexpr double kExcessPerBox = 1e-9;
    return stepsWithoutElement_ > kRuleClasses.size() * activeFaces_ ||
           filledVolume >
               (1.0 + kExcess) * enclosedVolume + kExcessPerBox * extent * extent * extent;
  }

 private:
  std::size_t stepsWithoutElement_ = 0;
  std::size_t activeFaces_ = 0;
};

}  // namespace tetrafront
