#pragma once

/// @file The order of the optimizer's operations, as data: a list of steps that optimizer.cpp
/// executes. A step measures elements in one way and repeats its sweeps as its rule says.
///
/// shape      remove edges and move nodes until the sum of costs settles; then rounds of splits
///            and collapses while they gain; then shapes once more
/// improve    improve the few elements that miss their angles, for targets that rise from 18 to 30
///            degrees (below 18 only if those fail); then those that still miss 12 or 22; then the
///            last few with more patience; then shapes of all that changed, with no angle worse
/// thorough   rounds with no angle worse than the worst; 35 degrees; shapes; and back to the mesh
///            of the improvement if the result is worse in any respect or equal, or if the first round
///            shows that it cannot be better
/// cautious   improve; then as thorough, and every change is kept

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "optimize/element_cost.h"
#include "tetrafront/options.h"

namespace tetrafront {

/// One pass over elements or nodes.
enum class Sweep : std::uint8_t {
  kSwap,              ///< remove edges
  kMove,              ///< move nodes to the mean of their elements' circumcentres
  kNewton,            ///< move nodes by a Newton step
  kCollectSplits,     ///< collect long edges, longest first
  kSplit,             ///< split them
  kCollectCollapses,  ///< collect free nodes, most crowded first
  kCollapse,          ///< collapse them
  kCollectPoor,       ///< collect elements that miss the target, worst first
  kImprove,           ///< those elements
  kLastResort,        ///< last-resort tries on them, best element first, one at a time
  kScore,             ///< score the whole mesh
};
inline constexpr std::size_t kSweepKinds = 11;

/// How a step measures elements.
enum class CostBasis : std::uint8_t {
  kAsBefore,
  kBulk,
  kFinish,
  kTargets,       ///< angles, by the targets of the step
  kWithinAngles,  ///< shapes, with no angle worse than the worst of the last score
};

/// When a step is executed.
enum class Entry : std::uint8_t {
  kAlways,
  kIfGivenUp,  ///< if the target of the last improvement was given up
  kIfBefore,   ///< if the previous step was executed
  kIfGaining,  ///< if the last round gained
  kIfFewMiss,  ///< if some elements, but very few, miss the step's target and it was not given up
};

/// When a step repeats its sweeps, up to Step::maxRepeats times in all.
enum class Again : std::uint8_t {
  kAlways,
  kWhileItGains,     ///< while a round makes enough changes and lowers the mean cost enough
  kWhileItImproves,  ///< while any element improves; then once more with the goal to improve the worst
  kWhileLastResortHelps,  ///< while last-resort tries improve any element
  kIfMuchChanged,         ///< if much of the mesh has changed since improvements began
};

/// What a step does besides its sweeps.
enum class Purpose : std::uint8_t {
  kSweeps,
  kSeeIfSparse,  ///< finds out whether the mesh has too few interior nodes
  kKeep,         ///< keeps this mesh and its score for comparison
  kGiveUp,       ///< restores the kept mesh and ends if this one cannot become as good
  kCompare,      ///< restores the kept mesh unless this one is better
};

struct Step {
  std::span<const Sweep> sweeps;
  CostBasis costBasis = CostBasis::kAsBefore;
  DihedralTargets targets = kTargets30And135;
  Entry entry = Entry::kAlways;
  /// Fraction of all elements above which the target is given up: if so many miss, as with a
  /// boundary that is coarse for its shape, improving them would only add elements. The second is
  /// for small meshes, with up to some hundreds of elements that miss.
  double many = 1.0;
  double manyOfFew = 0.0;
  bool includeNarrowGaps =
      false;  ///< also improve elements in narrow gaps of the boundary, which have no room for a node
  bool isPatient = false;    ///< continue even if a pass hardly helped
  bool changedOnly = false;  ///< visit only what has changed since improvements began
  Again again = Again::kAlways;
  int maxRepeats = 1;
  double minChanges = 0.0;  ///< minimum of a round, relative to the free nodes
  double minGain = 0.0;     ///< minimum of a round, relative to the mean cost
  Purpose purpose = Purpose::kSweeps;
  /// Typical time beside that of the other steps, for the estimate of the progress. Without a value, that of a step which
  /// visits few elements.
  double work = 1.0;
};

/// The steps of a level: all, those that change shapes everywhere, and those after them, which change the few poor elements.
enum class StepPart : std::uint8_t { kAll, kShapes, kAfterShapes };

/// Returns the steps of a level; none for Optimization::kNone. The spans in the steps are valid for
/// ever.
[[nodiscard]] std::vector<Step> scheduleOf(Optimization level, StepPart part = StepPart::kAll);

/// Returns steps that hardly ever make the worst angles of a mesh worse.
[[nodiscard]] std::vector<Step> cautiousSchedule();

}  // namespace tetrafront
