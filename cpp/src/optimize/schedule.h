#pragma once

/// @file What the optimizer does, and in which order, as data: a list of steps, which optimizer.cpp
/// goes through. A step judges elements by one measure and makes its sweeps, over and over as long as
/// its rule says so.
///
///   shape    edges are removed and nodes move until elements are cheap in the sum; then rounds of
///            splits and collapses, as long as they gain; then shapes once more
///   mend     the few elements that miss their angles, by targets that rise from 18 to 30 degrees;
///            below 18 only where those cannot be had; the last few with much patience; then shapes
///            of what all that has changed, with no angle worse
///   strive   rounds with no angle worse than the worst; 35 degrees; shapes; and back to the mesh that
///            mending has left, should the result not be at least as good in every respect

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "optimize/element_cost.h"
#include "tetrafront/options.h"

namespace tetrafront {

/// One pass over elements or nodes.
enum class Sweep : std::uint8_t {
  kSwap,              ///< edge removal
  kMove,              ///< nodes to the mean of their circumcentres
  kNewton,            ///< nodes by a Newton step
  kCollectSplits,     ///< long edges, the longest first
  kSplit,             ///< those edges
  kCollectCollapses,  ///< free nodes, the most crowded first
  kCollapse,          ///< those nodes
  kCollectPoor,       ///< elements beyond the target, worst first
  kImprove,           ///< those elements
  kLastResort,        ///< those elements, the best first, one try at a time
  kScore,             ///< the mesh as a whole
};
inline constexpr std::size_t kSweepKinds = 11;

/// By what a step judges elements.
enum class CostBasis : std::uint8_t {
  kAsBefore,
  kBulk,
  kFinish,
  kTargets,       ///< angles: those of the step
  kWithinAngles,  ///< shapes, and no angle worse than the worst at the last judgement
};

/// What must be so for a step not to be left out.
enum class Entry : std::uint8_t {
  kAlways,
  kIfGivenUp,  ///< the target of the last repair was
  kIfBefore,   ///< the step before was not left out
  kIfFewMiss,  ///< the step's target, which was not given up: some elements, but very few
};

/// When a step makes its sweeps again, up to Step::maxRepeats times in all.
enum class Again : std::uint8_t {
  kAlways,
  kWhileItGains,          ///< rounds: enough changes, and the mean cost falls by enough
  kWhileItImproves,       ///< any element; then, from the beginning, with an eye on the worst
  kWhileLastResortHelps,  ///< any element
  kIfMuchChanged,         ///< much of the mesh has changed since repairs began
};

/// What a step is for besides the sweeps.
enum class Purpose : std::uint8_t {
  kSweeps,
  kSeeIfSparse,  ///< whether the mesh has too few nodes inside
  kKeep,         ///< this mesh and its judgement, to be compared with
  kCompare,      ///< and go back to the mesh kept unless this one is no worse
};

struct Step {
  std::span<const Sweep> sweeps;
  CostBasis costBasis = CostBasis::kAsBefore;
  DihedralTargets targets = kTargets30And135;
  Entry entry = Entry::kAlways;
  /// With more than this part of all elements missing the target, chasing it would only add elements:
  /// it is given up. Where the boundary is coarse for its shape many do. The second is for small
  /// meshes, up to some hundreds of elements that miss.
  double many = 1.0;
  double manyOfFew = 0.0;
  bool includeNarrowGaps = false;  ///< of the boundary, even where they leave no room for a node
  bool isPatient = false;          ///< goes on though a pass of repairs has hardly helped
  bool changedOnly = false;        ///< what has changed since repairs began
  Again again = Again::kAlways;
  int maxRepeats = 1;
  double minChanges = 0.0;  ///< of a round, by free nodes
  double minGain = 0.0;     ///< of a round, by the mean cost
  Purpose purpose = Purpose::kSweeps;
};

/// The steps of a level; none for Optimization::kNone. What they point to lives forever.
[[nodiscard]] std::vector<Step> scheduleOf(Optimization level);

}  // namespace tetrafront
