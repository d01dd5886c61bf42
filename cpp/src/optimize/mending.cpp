#include "optimize/mending.h"

#include <algorithm>

#include "base/sort.h"
#include "optimize/near_sheets.h"

namespace tetrafront {
namespace {

/// Mending also ends when a pass has left more than this part of the bad elements that it met, and
/// more than that part of all: in a gap or a wedge without room for nodes, what mends one spoils
/// others.
constexpr double kMaxLeft = 0.8;
constexpr double kFewBad = 0.005;
/// Compound changes in one repair: so many, and one for so many elements.
constexpr std::size_t kLeastCompounds = 100;
constexpr std::size_t kElementsPerCompound = 200;
/// Changes tried in one rescue: so many, and one for so many elements.
constexpr std::size_t kLeastRescueTries = 60;
constexpr std::size_t kElementsPerRescueTry = 1000;

/// The cost, by these targets, of an element that just misses 30 or 135 degrees. Where many are to be
/// mended, or as few as possible are to be left, all that miss those count when a repair is weighed, or
/// one element would be paid for with many that are hardly better.
double costOfMissing(const DihedralTargets& targets) {
  return std::min(1.0, std::max(targets.least / kTargets30And135.least,
                                targets.greatest / kTargets30And135.greatest));
}

}  // namespace

template <class Space>
void Mending<Space>::begin(const Step& step) {
  betweenSheets_ = step.mendsBetweenSheets;
  isPatient_ = step.isPatient;
  isHopeless_ = false;
  isRescuing_ = false;
  const std::size_t elements = complex_.elementCount();
  costOfMissing_ = costOfMissing(step.targets);
  repair_.allowCompounds(kLeastCompounds + elements / kElementsPerCompound);
  rescue_.allow(kLeastRescueTries + elements / kElementsPerRescueTry);
  aimAt(RepairAim::kFewer);
}

template <class Space>
void Mending<Space>::aimAt(RepairAim aim) {
  aim_ = aim;
  isFirstPass_ = true;
  failedIn_.clear();
  repair_.aimAt(aim);
}

template <class Space>
bool Mending<Space>::turnToTheWorst() {
  if (bad_.empty() || aim_ == RepairAim::kLessBad) return false;
  aimAt(RepairAim::kLessBad);
  return true;
}

template <class Space>
bool Mending<Space>::isToBeMended(TetId tet) const {
  if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) return false;
  return betweenSheets_ || !isBetweenNearSheets<Space>(complex_, tet);
}

template <class Space>
std::size_t Mending<Space>::missing() const {
  std::size_t count = 0;
  for (std::size_t t = 0; t < complex_.slotCount(); ++t) count += isToBeMended(TetId(t)) ? 1 : 0;
  return count;
}

template <class Space>
void Mending<Space>::collect(std::size_t first, std::size_t last) {
  if (first == 0) bad_.clear();
  for (std::size_t t = first; t < last; ++t) {
    if (isToBeMended(TetId(t))) bad_.emplace_back(t);
  }
}

template <class Space>
void Mending<Space>::rank() {
  const auto count = static_cast<double>(bad_.size());
  const bool helped = isFirstPass_ || bad_.size() <= kVeryFew ||
                      count <= kMaxLeft * static_cast<double>(badBefore_);
  isFirstPass_ = false;
  badBefore_ = bad_.size();
  const bool areFew = count <= kFewBad * static_cast<double>(complex_.elementCount());
  isHopeless_ = !helped && !areFew && !isPatient_;
  repair_.countAbove(areFew && aim_ == RepairAim::kLessBad ? 1.0 : costOfMissing_);
  if (isHopeless_) bad_.clear();
  stableSort(bad_, [&](TetId p, TetId q) { return complex_.cost(p) > complex_.cost(q); });
}

/// Whether its repair has failed and no element that shares a node with it has changed since: it would
/// fail again. O(elements around), where a repair that fails takes milliseconds.
template <class Space>
bool Mending<Space>::hasFailedAsItIs(TetId tet) {
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
std::size_t Mending<Space>::repairSome(std::size_t first, std::size_t last,
                                       const ElementCost<Space>& cost) {
  std::size_t done = 0;
  for (std::size_t i = first; i < last; ++i) {
    const TetId tet = bad_[i];
    if (!complex_.isLive(tet) || complex_.cost(tet) <= 1.0) continue;
    if (complex_.changedIn(tet) == complex_.pass()) continue;  // made in this pass: in the next
    failedIn_.resize(complex_.slotCount(), 0);
    if (hasFailedAsItIs(tet)) continue;
    const bool isMended = repair_.repair(tet, cost);
    failedIn_[tet.index()] = isMended ? 0 : complex_.pass();
    done += isMended ? 1 : 0;
  }
  return done;
}

template <class Space>
typename Mending<Space>::Rescued Mending<Space>::rescue(std::size_t turn,
                                                        const ElementCost<Space>& cost) {
  const TetId tet = bad_[bad_.size() - 1 - turn];
  if (!isRescuing_) {
    if (!isToBeMended(tet)) return Rescued::kNotNeeded;
    rescue_.begin(tet);
    isRescuing_ = true;
  }
  if (rescue_.tryOne(cost)) return Rescued::kTried;
  isRescuing_ = false;
  return rescue_.isSaved() ? Rescued::kSaved : Rescued::kLost;
}

template class Mending<PlainSpace>;
template class Mending<StretchedSpace>;

}  // namespace tetrafront
