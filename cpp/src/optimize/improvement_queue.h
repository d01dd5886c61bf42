#pragma once

/// @file The elements that miss the angles aimed at: which they are, in which order they are mended,
/// and when that is hopeless.

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
  /// So many elements are worth a rescue, and always gone through once more.
  static constexpr std::size_t kVeryFew = 40;

  ImprovementQueue(TetComplex& complex, EdgeRemoval<Space>& removal, EdgeSplitter<Space>& splitter,
                   NodeCollapser<Space>& collapser, NodeMover<Space>& mover)
      : complex_(complex),
        improver_(complex, removal, splitter, collapser, mover),
        lastResort_(complex, removal, splitter, collapser, mover, improver_) {}

  /// Turns to the step's targets, which the elements' costs are by from now on. If it does not mend
  /// between sheets, elements between two of the boundary that leave no room for a node are left
  /// alone: nodes put there would only make more elements that miss.
  void begin(const Step& step);

  /// Goes on with an eye on how bad the worst are. False where that is so already, or nothing is left.
  bool focusOnWorst();

  /// How many elements miss. O(elements).
  [[nodiscard]] std::size_t missing() const;

  /// Among the elements from `first` to `last`. The first of a pass is element 0.
  void collect(std::size_t first, std::size_t last);
  /// After the last. Worst first; none where the last pass has hardly helped.
  void rank();
  /// Whether it has, and they are too many to go on for.
  [[nodiscard]] bool canGiveUp() const { return isHopeless_; }
  [[nodiscard]] std::size_t collected() const { return bad_.size(); }

  /// Repairs those collected from `first` to `last`; how many could be.
  std::size_t improveSome(std::size_t first, std::size_t last, const ElementCost<Space>& cost);

  /// One try to save the element whose turn it is. Those likeliest to be saved come first, as tries
  /// are few.
  enum class LastResort : std::uint8_t { kTried, kImproved, kFailed, kNotNeeded };
  LastResort tryLastResort(std::size_t turn, const ElementCost<Space>& cost);

 private:
  [[nodiscard]] bool isToBeMended(TetId tet) const;
  [[nodiscard]] bool hasFailedAsItIs(TetId tet);
  void aimAt(ImprovementGoal aim);

  TetComplex& complex_;
  ElementImprover<Space> improver_;
  LastResortImprover<Space> lastResort_;
  std::vector<TetId> bad_;
  Star star_;
  /// Per element's slot: the pass in which its repair has failed, for this aim; 0: none.
  std::vector<std::uint32_t> failedIn_;
  std::size_t badBefore_ = 0;   ///< when the last pass began
  double costOfMissing_ = 1.0;  ///< 30 or 135 degrees, by the targets
  bool isFirstPass_ = true;     ///< for this aim
  bool isHopeless_ = false;
  bool betweenSheets_ = false;
  bool isPatient_ = false;
  bool isRescuing_ = false;
  ImprovementGoal aim_ = ImprovementGoal::kFewer;
};

}  // namespace tetrafront
