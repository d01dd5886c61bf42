#include "volume/recovery.h"

#include <algorithm>

namespace tetrafront {
namespace {

/// Skipping this many free slots of faces costs about as much as one step of the front.
constexpr std::size_t kSlotsPerStep = 1000;

/// Progress at the start and at the end of local remeshing, 0 to 1.
constexpr double kStarEnd = 0.05;
constexpr double kRemeshEnd = 0.2;

}  // namespace

template <class Trace>
Recovery<Trace>::Recovery(Front& front, Elements& elements, FrontAdvance<Trace>& advance,
                          FrontOrder order, bool fillOnly)
    : front_(front),
      elements_(elements),
      advance_(advance),
      fillOnly_(fillOnly),
      index_(elements),
      remeshing_(front, elements, advance, order, index_) {}

template <class Trace>
typename Recovery<Trace>::State Recovery<Trace>::advance(std::uint32_t budget) {
  while (budget > 0) {
    if (stage_ == Stage::kFinished) {
      return front_.activeCount() == 0 ? State::kClosed : State::kStalled;
    }
    const std::size_t cost = std::max<std::size_t>(work(budget), 1);
    budget -= static_cast<std::uint32_t>(std::min<std::size_t>(cost, budget));
  }
  return State::kRunning;
}

template <class Trace>
std::size_t Recovery<Trace>::work(std::uint32_t budget) {
  switch (stage_) {
    case Stage::kFindPockets:
      pockets_ = findPockets(front_);
      stage_ = fillOnly_ ? Stage::kFindRemaining : Stage::kStar;
      return scanCost();
    case Stage::kStar:
      return starNext();
    case Stage::kFindRemaining:
      remaining_.emplace(front_, findPockets(front_));
      stage_ = Stage::kRemesh;
      if (fillOnly_) beginFill();
      return scanCost();
    case Stage::kRemesh: {
      const std::size_t cost = remeshing_.work(budget, *remaining_);
      if (remeshing_.isDone()) beginFill();
      return cost;
    }
    case Stage::kFill: {
      const std::size_t made = filler_->made().size();
      const std::size_t cost = filler_->work(budget);
      if (filler_->made().size() > made) advance_.recordChange(FrontChange::kExactFill);
      if (filler_->isDone()) stage_ = Stage::kFinished;
      return cost;
    }
    case Stage::kFinished:
      break;
  }
  return 1;
}

template <class Trace>
double Recovery<Trace>::fraction() const {
  switch (stage_) {
    case Stage::kFindPockets:
      return 0.0;
    case Stage::kStar:
      if (pockets_.empty()) return kStarEnd;
      return kStarEnd * static_cast<double>(nextPocket_) / static_cast<double>(pockets_.size());
    case Stage::kFindRemaining:
      return kStarEnd;
    case Stage::kRemesh:
      return kStarEnd + (kRemeshEnd - kStarEnd) * remeshing_.fraction();
    case Stage::kFill:
      return kRemeshEnd + (1.0 - kRemeshEnd) * exactFillFraction();
    case Stage::kFinished:
      break;
  }
  return 1.0;
}

template <class Trace>
std::size_t Recovery<Trace>::scanCost() const {
  return 1 + front_.activeCount() / kTouchedPerStep + front_.slotCount() / kSlotsPerStep;
}

template <class Trace>
std::size_t Recovery<Trace>::starNext() {
  if (nextPocket_ == pockets_.size()) {
    pockets_.clear();
    stage_ = front_.activeCount() == 0 ? Stage::kFinished : Stage::kFindRemaining;
    return 1;
  }
  const Pocket& pocket = pockets_[nextPocket_++];
  const std::size_t first = elements_.size();
  if (fillFromStarPoint(front_, elements_, pocket)) {
    starred_.push_back({first, elements_.size()});
    advance_.recordChange(FrontChange::kStar);
  }
  return 1 + pocket.faces.size();
}

template <class Trace>
void Recovery<Trace>::beginFill() {
  filler_.emplace(front_, elements_, index_, *remaining_);
  stage_ = Stage::kFill;
}

template <class Trace>
bool Recovery<Trace>::hasLiveElement(const IndexRange& made) const {
  const auto begin = elements_.removed.begin();
  const auto last = begin + static_cast<std::ptrdiff_t>(made.last);
  return std::find(begin + static_cast<std::ptrdiff_t>(made.first), last, 0) != last;
}

template <class Trace>
RecoverySummary Recovery<Trace>::summary() const {
  std::vector<std::uint8_t> used(front_.nodes().size(), 0);
  for (std::size_t element = 0; element < elements_.size(); ++element) {
    if (elements_.removed[element] != 0) continue;
    for (const NodeId node : elements_.nodes[element]) used[node.index()] = 1;
  }
  RecoverySummary counts;
  for (const IndexRange& made : starred_) counts.starred += hasLiveElement(made) ? 1 : 0;
  for (const IndexRange& made : remeshing_.made()) counts.remeshed += hasLiveElement(made) ? 1 : 0;
  if (!filler_) return counts;
  for (const PocketFiller::Made& made : filler_->made()) {
    counts.filled += hasLiveElement(made.elements) ? 1 : 0;
    for (std::size_t node = made.nodes.first; node < made.nodes.last; ++node) {
      counts.steinerPoints += used[node];
    }
  }
  return counts;
}

template class Recovery<NullTrace>;
template class Recovery<ClockTrace>;
template class Recovery<RecordingTrace>;

}  // namespace tetrafront
