#pragma once

/// @file The elements that miss their target angles: collects them, orders them, and decides when
/// to give up.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "optimize/element_improver.h"
#include "optimize/last_resort_improver.h"
#include "optimize/schedule.h"

namespace tetrafront {

template <class Space = PlainSpace>
class ImprovementQueue {
 public:
  /// Number of elements that are worth a last-resort try, and always get another pass.
  static constexpr std::size_t kVeryFew = 40;

  ImprovementQueue(TetComplex& complex, EdgeRemoval<Space>& removal, EdgeSplitter<Space>& splitter,
                   NodeCollapser<Space>& collapser, NodeMover<Space>& mover)
      : complex_(complex),
        improver_(complex, removal, splitter, collapser, mover),
        lastResort_(complex, removal, splitter, collapser, mover, improver_) {}

  /// Starts with the step's targets; the elements' costs must use them from now on. Without
  /// includeNarrowGaps, elements in a narrow gap of the boundary are skipped: nodes inserted there
  /// would only make more elements that miss.
  void begin(const Step& step);

  /// Continues with the goal to improve the worst elements. Returns false if that is the goal
  /// already, or if no element misses.
  bool focusOnWorst();

  /// Returns the number of elements that miss. O(elements).
  [[nodiscard]] std::size_t missing() const;

  /// Collects the elements in [first, last) that miss. A pass begins with element 0.
  void collect(std::size_t first, std::size_t last);
  /// Sorts the collected elements, worst first, after the last one is collected. Drops all if the
  /// previous pass hardly helped.
  void rank();
  /// Returns whether the previous pass hardly helped and too many elements are left to continue.
  [[nodiscard]] bool canGiveUp() const { return isHopeless_; }
  [[nodiscard]] std::size_t collected() const { return poor_.size(); }

  /// Improves the collected elements in [first, last). Returns how many improved.
  std::size_t improveSome(std::size_t first, std::size_t last, const ElementCost<Space>& cost);

  /// Makes one last-resort try on the current element. The most promising elements come first,
  /// because tries are limited.
  enum class LastResort : std::uint8_t { kTried, kImproved, kFailed, kNotNeeded };
  LastResort tryLastResort(std::size_t turn, const ElementCost<Space>& cost);

 private:
  [[nodiscard]] bool needsImprovement(TetId tet) const;
  [[nodiscard]] bool hasFailedAsItIs(TetId tet);
  void aimAt(ImprovementGoal aim);

  TetComplex& complex_;
  ElementImprover<Space> improver_;
  LastResortImprover<Space> lastResort_;
  std::vector<TetId> poor_;
  Star star_;
  /// Per element slot: the pass in which its improvement failed for this goal; 0 for none.
  std::vector<std::uint32_t> failedIn_;
  std::size_t poorBefore_ = 0;  ///< elements that missed when the previous pass began
  double costOfMissing_ = 1.0;  ///< cost of an angle of 30 or 135 degrees, by the targets
  bool isFirstPass_ = true;     ///< of this goal
  bool isHopeless_ = false;
  bool betweenSheets_ = false;
  bool isPatient_ = false;
  bool isRescuing_ = false;
  ImprovementGoal aim_ = ImprovementGoal::kFewer;
};

}  // namespace tetrafront
