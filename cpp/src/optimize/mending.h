#pragma once

/// @file The elements that miss the angles aimed at: which they are, in which order they are mended,
/// and when that is hopeless.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "optimize/repair.h"
#include "optimize/rescue.h"
#include "optimize/schedule.h"

namespace tetrafront {

template <class Space = PlainSpace>
class Mending {
 public:
  /// So many elements are worth a rescue, and always gone through once more.
  static constexpr std::size_t kVeryFew = 40;

  Mending(TetComplex& complex, EdgeRemoval<Space>& removal, EdgeSplitter<Space>& splitter,
          NodeCollapser<Space>& collapser, NodeMover<Space>& mover)
      : complex_(complex),
        repair_(complex, removal, splitter, collapser, mover),
        rescue_(complex, removal, splitter, collapser, mover, repair_) {}

  /// Turns to the step's targets, which the elements' costs are by from now on. If it does not mend
  /// between sheets, elements between two of the boundary that leave no room for a node are left
  /// alone: nodes put there would only make more elements that miss.
  void begin(const Step& step);

  /// Goes on with an eye on how bad the worst are. False where that is so already, or nothing is left.
  bool turnToTheWorst();

  /// How many elements miss. O(elements).
  [[nodiscard]] std::size_t missing() const;

  /// Among the elements from `first` to `last`. The first of a pass is element 0.
  void collect(std::size_t first, std::size_t last);
  /// After the last. Worst first; none where the last pass has hardly helped.
  void rank();
  /// Whether it has, and they are too many to go on for.
  [[nodiscard]] bool isHopeless() const { return isHopeless_; }
  [[nodiscard]] std::size_t collected() const { return bad_.size(); }

  /// Repairs those collected from `first` to `last`; how many could be.
  std::size_t repairSome(std::size_t first, std::size_t last, const ElementCost<Space>& cost);

  /// One try to save the element whose turn it is. Those likeliest to be saved come first, as tries
  /// are few.
  enum class Rescued : std::uint8_t { kTried, kSaved, kLost, kNotNeeded };
  Rescued rescue(std::size_t turn, const ElementCost<Space>& cost);

 private:
  [[nodiscard]] bool isToBeMended(TetId tet) const;
  [[nodiscard]] bool hasFailedAsItIs(TetId tet);
  void aimAt(RepairAim aim);

  TetComplex& complex_;
  ElementRepair<Space> repair_;
  ElementRescue<Space> rescue_;
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
  RepairAim aim_ = RepairAim::kFewer;
};

}  // namespace tetrafront
