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

Recovery::Recovery(Front& front, Elements& elements, FrontAdvance& advance, FrontOrder order,
                   bool fillOnly)
    : front_(front),
      elements_(elements),
      advance_(advance),
      fillOnly_(fillOnly),
      index_(elements),
      remeshing_(front, elements, advance, order, index_) {}

Task<bool> Recovery::run(Work& work) {
  work.beginPart(kStarEnd);
  if (!fillOnly_) {
    const std::vector<Pocket> pockets = findPockets(front_);
    co_await work.spend(scanCost());
    for (const Pocket& pocket : pockets) {
      star(pocket);
      co_await work.spend(1 + pocket.faces.size());
    }
    if (front_.activeCount() == 0) co_return true;
  }
  remaining_.emplace(front_, findPockets(front_));
  co_await work.spend(scanCost());
  work.beginPart(kRemeshEnd);
  if (!fillOnly_) co_await remeshing_.run(work, *remaining_);
  work.beginPart(1.0);
  co_await fillExactly(work);
  co_return front_.activeCount() == 0;
}

std::size_t Recovery::scanCost() const {
  return 1 + front_.activeCount() / kTouchedPerStep + front_.slotCount() / kSlotsPerStep;
}

/// Joins a pocket to one point, if one sees all of it.
void Recovery::star(const Pocket& pocket) {
  const std::size_t first = elements_.size();
  if (!fillFromStarPoint(front_, elements_, pocket)) return;
  starred_.push_back({first, elements_.size()});
  advance_.recordChange(FrontChange::kStar);
}

Task<> Recovery::fillExactly(Work& work) {
  filler_.emplace(front_, elements_, index_, *remaining_);
  while (!filler_->isDone()) {
    const std::size_t made = filler_->made().size();
    const std::size_t cost = filler_->work(work.remaining());
    if (filler_->made().size() > made) advance_.recordChange(FrontChange::kExactFill);
    exactFill_ = std::max(exactFill_, filler_->fraction());
    work.setFraction(exactFill_);
    co_await work.spend(std::max<std::size_t>(cost, 1));
  }
}

bool Recovery::hasLiveElement(const IndexRange& made) const {
  const auto begin = elements_.removed.begin();
  const auto last = begin + static_cast<std::ptrdiff_t>(made.last);
  return std::find(begin + static_cast<std::ptrdiff_t>(made.first), last, 0) != last;
}

RecoverySummary Recovery::summary() const {
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

}  // namespace tetrafront
