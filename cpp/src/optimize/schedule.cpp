#include "optimize/schedule.h"

#include <array>

#include "optimize/rules.h"

namespace tetrafront {
namespace {

/// Splits and collapses need a settled mesh between them: one after the other, they undo each
/// other.
constexpr std::array kFirst{Sweep::kSwap, Sweep::kMove, Sweep::kMove};
constexpr std::array kRound{
    Sweep::kCollectSplits,    Sweep::kSplit,    Sweep::kSwap, Sweep::kMove, Sweep::kMove,
    Sweep::kCollectCollapses, Sweep::kCollapse, Sweep::kSwap, Sweep::kMove, Sweep::kMove};
constexpr std::array kFinish{Sweep::kSwap, Sweep::kNewton, Sweep::kNewton, Sweep::kSwap};
constexpr std::array kFast{Sweep::kSwap, Sweep::kNewton, Sweep::kSwap, Sweep::kNewton,
                           Sweep::kSwap};
constexpr std::array kImprove{Sweep::kCollectPoor, Sweep::kImprove};
constexpr std::array kLastResort{Sweep::kCollectPoor, Sweep::kLastResort};
/// Improvements insert nodes, and some of these are in the way once their surroundings have
/// settled.
constexpr std::array kEase{Sweep::kSwap, Sweep::kMove, Sweep::kNewton, Sweep::kCollectCollapses,
                           Sweep::kCollapse};
constexpr std::array kPolish{Sweep::kSwap, Sweep::kMove, Sweep::kNewton};
constexpr std::array kScore{Sweep::kScore};

constexpr Step repairLow(const DihedralTargets& targets, Entry entry = Entry::kIfGivenUp) {
  return {.sweeps = kImprove,
          .costBasis = CostBasis::kTargets,
          .targets = targets,
          .entry = entry,
          .many = kManyLow,
          .includeNarrowGaps = true,
          .again = Again::kWhileItImproves,
          .maxRepeats = kImprovementPasses};
}

/// Flat elements are useless, and hardly any of them is necessary. `many`: fraction above which they are left alone.
constexpr Step repairFlat(double many) {
  Step step = repairLow(kTargets2And175);
  step.many = many;
  step.isPatient = true;
  step.maxRepeats = kPatientPasses;
  return step;
}

constexpr Step kLastResortStep{.sweeps = kLastResort,
                               .costBasis = CostBasis::kTargets,
                               .entry = Entry::kIfFewMiss,
                               .again = Again::kWhileLastResortHelps,
                               .maxRepeats = kImprovementPasses};

constexpr Step lastResort(const DihedralTargets& targets) {
  Step step = kLastResortStep;
  step.targets = targets;
  return step;
}

constexpr Step ease(Entry entry) {
  return {.sweeps = kEase,
          .costBasis = CostBasis::kWithinAngles,
          .entry = entry,
          .changedOnly = true,
          .again = Again::kIfMuchChanged,
          .maxRepeats = kPolishPasses};
}

/// Typical shares of the time of the steps that visit all elements, in percent of the shape steps.
constexpr double kFirstWork = 20.0;
constexpr double kRoundsWork = 65.0;
constexpr double kFinishWork = 15.0;
constexpr double kFastWork = 50.0;
constexpr double kThoroughRoundWork = 15.0;
constexpr double kLaterRoundsWork = 25.0;
constexpr double kPolishWork = 15.0;

constexpr std::array kShapeSteps{
    Step{.sweeps = kFirst,
         .costBasis = CostBasis::kBulk,
         .purpose = Purpose::kSeeIfSparse,
         .work = kFirstWork},
    Step{.sweeps = kRound,
         .again = Again::kWhileItGains,
         .maxRepeats = kMaxRounds,
         .minChanges = kQuietRound,
         .minGain = kMinRoundGain,
         .work = kRoundsWork},
    Step{.sweeps = kFinish, .costBasis = CostBasis::kBulk, .work = kFinishWork},
};

constexpr std::array kFastSteps{
    Step{.sweeps = kFast, .costBasis = CostBasis::kFinish, .work = kFastWork}};

constexpr auto improveSteps(double manyFlat) {
  return std::array{
      repairLow(kTargets18And150, Entry::kAlways),
      repairLow(kTargets8And165),
      repairFlat(manyFlat),
      // A few needles of the boundary leave elements around them that miss 12 degrees ...
      lastResort(kTargets12And160),
      Step{.sweeps = kImprove,
           .costBasis = CostBasis::kTargets,
           .many = kManyHigh,
           .manyOfFew = kManyOfFew,
           .again = Again::kWhileItImproves,
           .maxRepeats = kImprovementPasses},
      // ... which the steps for 30 may have brought back, or 22.
      repairLow(kTargets12And160, Entry::kAlways),
      lastResort(kTargets12And160),
      repairLow(kTargets22And145, Entry::kAlways),
      lastResort(kTargets22And145),
      kLastResortStep,
      Step{.sweeps = kScore},
      ease(Entry::kAlways),
      // Shape sweeps have changed the surroundings of the last few elements, so another try may
      // succeed.
      lastResort(kTargets12And160),
      lastResort(kTargets22And145),
      kLastResortStep,
      Step{.sweeps = kScore, .entry = Entry::kIfBefore},
      ease(Entry::kIfBefore),
  };
}

constexpr Step thoroughRounds(CostBasis costBasis, int maxRepeats) {
  return {.sweeps = kRound,
          .costBasis = costBasis,
          .again = Again::kWhileItGains,
          .maxRepeats = maxRepeats,
          .minGain = kMinThoroughGain,
          .work = kThoroughRoundWork};
}

/// The later rounds, which continue the first one.
constexpr Step laterRounds() {
  Step step = thoroughRounds(CostBasis::kAsBefore, kMaxThoroughRounds - 1);
  step.entry = Entry::kIfGaining;
  step.work = kLaterRoundsWork;
  return step;
}

constexpr std::array kThoroughSteps{
    Step{.sweeps = kScore, .purpose = Purpose::kKeep},
    thoroughRounds(CostBasis::kWithinAngles, 1),
    Step{.sweeps = kScore, .purpose = Purpose::kGiveUp},
    laterRounds(),
    Step{.sweeps = kImprove,
         .costBasis = CostBasis::kTargets,
         .targets = kTargets35And130,
         .many = kManyThorough,
         .again = Again::kWhileItImproves,
         .maxRepeats = kImprovementPasses},
    Step{.sweeps = kScore},
    Step{.sweeps = kPolish,
         .costBasis = CostBasis::kWithinAngles,
         .maxRepeats = kPolishPasses,
         .work = kPolishWork},
    Step{.sweeps = kScore, .purpose = Purpose::kCompare},
};

/// Without the steps that compare meshes.
constexpr std::array kCautiousSteps{
    Step{.sweeps = kScore},
    thoroughRounds(CostBasis::kWithinAngles, kMaxThoroughRounds),
    Step{.sweeps = kScore},
    Step{.sweeps = kPolish,
         .costBasis = CostBasis::kWithinAngles,
         .maxRepeats = kPolishPasses,
         .work = kPolishWork},
};

}  // namespace

std::vector<Step> cautiousSchedule() {
  // No shape sweep has come before, so elements may be flat although the boundary is good.
  constexpr std::array kSteps = improveSteps(1.0);
  std::vector<Step> steps(kSteps.begin(), kSteps.end());
  steps.insert(steps.end(), kCautiousSteps.begin(), kCautiousSteps.end());
  return steps;
}

std::vector<Step> scheduleOf(Optimization level, StepPart part) {
  std::vector<Step> steps;
  const auto add = [&](std::span<const Step> more) {
    for (const Step& step : more) steps.push_back(step);
  };
  if (level == Optimization::kNone) return steps;
  if (part == StepPart::kAfterShapes) {
    steps.push_back({.sweeps = {}, .purpose = Purpose::kSeeIfSparse});
  } else {
    add(level == Optimization::kFast ? std::span<const Step>(kFastSteps) : kShapeSteps);
  }
  if (part == StepPart::kShapes) return steps;
  constexpr std::array kSteps = improveSteps(kManyFlat);
  add(kSteps);
  if (level == Optimization::kThorough) add(kThoroughSteps);
  return steps;
}

}  // namespace tetrafront
