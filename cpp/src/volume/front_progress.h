#pragma once

/// @file Stops a front whose bookkeeping is broken, or whose boundary is not closed: such a front would
/// advance for ever. A valid front never exceeds these bounds.

#include <cstddef>
#include <cstdint>

#include "volume/rules.h"

namespace tetrafront {

class FrontProgress {
 public:
  /// Records one step, after which the front has `activeFaces`.
  void recordStep(bool hasMadeElement, std::uint32_t activeFaces) {
    stepsWithoutElement_ = hasMadeElement ? 0 : stepsWithoutElement_ + 1;
    activeFaces_ = activeFaces;
  }

  /// True if more steps in a row have made no element than there are faces and rule classes: until the
  /// front changes, each face can fail once under each class. Also true if the elements have more volume
  /// than the boundary encloses; `extent` is the size of the model along its longest axis. All volumes are
  /// in the same unit.
  [[nodiscard]] bool isStuck(double filledVolume, double enclosedVolume, double extent) const {
    // Far above the rounding of the sums, even if the elements are needles.
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
