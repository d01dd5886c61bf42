#include "optimize/improvement_queue.h"

#include <algorithm>

#include "base/sort.h"
#include "optimize/narrow_gaps.h"
#include "optimize/rules.h"

namespace tetrafront {
namespace {

/// Returns the cost, by these targets, of an element with an angle of just 30 or 135 degrees. If
/// many elements are to be improved, or as few as possible should remain, all elements that miss
/// those angles count when a change is weighed. Otherwise one element would improve at the expense
/// of many.
double costOfMissing(const DihedralTargets& targets) {
  return std::min(1.0, std::max(targets.least / kTargets30And135.least,
                                targets.greatest / kTargets30And135.greatest));
}

}  // namespace

template <class Space>
void ImprovementQueue<Space>::begin(const Step& step) {
  betweenSheets_ = step.includeNarrowGaps;
  isPatient_ = step.isPatient;
  isHopeless_ = false;
  isRescuing_ = false;
  const std::size_t elements = complex_.elementCount();
  costOfMissing_ = costOfMissing(step.targets);
  improver_.allowCompounds(kMinCompounds + elements / kElementsPerCompound);
  lastResort_.allow(kMinLastResortTries + elements / kElementsPerLastResortTry);
  aimAt(ImprovementGoal::kFewer);
}

template <class Space>
void ImprovementQueue<Space>::aimAt(ImprovementGoal aim) {
  aim_ = aim;
  isFirstPass_ = true;
  failedIn_.clear();
  improver_.aimAt(aim);
}

template <class Space>
bool ImprovementQueue<Space>::focusOnWorst() {
  if (poor_.empty() || aim_ == ImprovementGoal::kLessPoor) return false;
  aimAt(ImprovementGoal::kLessPoor);
  return true;
}

template <class Space>
bool ImprovementQueue<Space>::needsImprovement(TetId tet) const {
  if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) return false;
  return betweenSheets_ || !isInNarrowGap<Space>(complex_, tet);
}

template <class Space>
std::size_t ImprovementQueue<Space>::missing() const {
  std::size_t count = 0;
  for (std::size_t t = 0; t < complex_.slotCount(); ++t)
    count += needsImprovement(TetId(t)) ? 1 : 0;
  return count;
}

template <class Space>
void ImprovementQueue<Space>::collect(std::size_t first, std::size_t last) {
  if (first == 0) poor_.clear();
  for (std::size_t t = first; t < last; ++t) {
    if (needsImprovement(TetId(t))) poor_.emplace_back(t);
  }
}

template <class Space>
void ImprovementQueue<Space>::rank() {
  const auto count = static_cast<double>(poor_.size());
  const bool helped = isFirstPass_ || poor_.size() <= kVeryFew ||
                      count <= kMaxLeft * static_cast<double>(poorBefore_);
  isFirstPass_ = false;
  poorBefore_ = poor_.size();
  const bool areFew = count <= kFewPoor * static_cast<double>(complex_.elementCount());
  isHopeless_ = !helped && !areFew && !isPatient_;
  improver_.countAbove(areFew && aim_ == ImprovementGoal::kLessPoor ? 1.0 : costOfMissing_);
  if (isHopeless_) poor_.clear();
  stableSort(poor_, [&](TetId p, TetId q) { return complex_.cost(p) > complex_.cost(q); });
}

/// Returns whether improving the element failed before and no element that shares a node with it
/// has changed since: it would fail again. O(elements around), whereas a failing attempt takes
/// milliseconds.
template <class Space>
bool ImprovementQueue<Space>::hasFailedAsItIs(TetId tet) {
  const std::uint32_t failed = failedIn_[tet.index()];
  if (failed == 0) return false;
  return std::ranges::all_of(complex_.element(tet).nodes, [&](NodeId node) {
    if (!complex_.findStar(node, star_)) return false;
    return std::all_of(star_.elements.begin(),
                       star_.elements.begin() + static_cast<std::ptrdiff_t>(star_.size),
                       [&](TetId near) { return complex_.changedIn(near) < failed; });
  });
}

template <class Space>
std::size_t ImprovementQueue<Space>::improveSome(std::size_t first, std::size_t last,
                                                 const ElementCost<Space>& cost) {
  std::size_t done = 0;
  for (std::size_t i = first; i < last; ++i) {
    const TetId tet = poor_[i];
    if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) continue;
    if (complex_.changedIn(tet) == complex_.pass())
      continue;  // made in this pass: leave it to the next
    failedIn_.resize(complex_.slotCount(), 0);
    if (hasFailedAsItIs(tet)) continue;
    const bool isImproved = improver_.improve(tet, cost);
    failedIn_[tet.index()] = isImproved ? 0 : complex_.pass();
    done += isImproved ? 1 : 0;
  }
  return done;
}

template <class Space>
typename ImprovementQueue<Space>::LastResort ImprovementQueue<Space>::tryLastResort(
    std::size_t turn, const ElementCost<Space>& cost) {
  const TetId tet = poor_[poor_.size() - 1 - turn];
  if (!isRescuing_) {
    if (!needsImprovement(tet)) return LastResort::kNotNeeded;
    lastResort_.begin(tet);
    isRescuing_ = true;
  }
  if (lastResort_.tryOne(cost)) return LastResort::kTried;
  isRescuing_ = false;
  return lastResort_.hasImproved() ? LastResort::kImproved : LastResort::kFailed;
}

template class ImprovementQueue<PlainSpace>;
template class ImprovementQueue<StretchedSpace>;

}  // namespace tetrafront
