#include "volume/pocket_filler.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/sort.h"

namespace tetrafront {
namespace {

struct FirstTry {
  std::uint32_t rings;
  unsigned order;
};
/// First tries of a pocket. A partial fill is accepted; the volume that it leaves open continues
/// with the next try.
constexpr std::array<FirstTry, 9> kFirstTries{{{.rings = 0, .order = 0},
                                               {.rings = 1, .order = 0},
                                               {.rings = 1, .order = 1},
                                               {.rings = 1, .order = 2},
                                               {.rings = 1, .order = 3},
                                               {.rings = 2, .order = 4},
                                               {.rings = 2, .order = 5},
                                               {.rings = 4, .order = 0},
                                               {.rings = 6, .order = 1}}};
/// Afterwards all orders are tried without a ring, with one ring, with twice as many and so on.
/// With more rings than this, only complete fills are accepted. If nothing succeeds, all orders are
/// tried once more without a cost limit.
constexpr std::uint32_t kMaxRingsForPartialFill = 6;
/// Maximum number of partial fills in total: a constant and a number per pocket.
constexpr std::uint32_t kMaxPartialFills = 100;
constexpr std::uint32_t kPartialFillsPerPocket = 4;
/// Cost limit of a try that may end in a partial fill, in units of ExactFill. Most tries need a
/// tenth of it. A try that exceeds it mostly costs much less with other elements around the pocket.
constexpr std::uint64_t kFillCostPerFace = 1000;
constexpr std::uint64_t kExtraFillCost = 20'000;
/// Cost limit of all tries together, in units of ExactFill, of about 2 microseconds. Surfaces of needles that no order of
/// the edges recovers took more than five minutes; they are left open.
constexpr std::uint64_t kCostOfAllTriesPerFace = 75;
constexpr std::uint64_t kExtraCostOfAllTries = 10'000'000;
/// Share of a pocket that remains to be done after a failed try, for the estimate of progress.
constexpr double kRemainingAfterFailure = 0.1;

}  // namespace

PocketFiller::PocketFiller(Front& front, Elements& elements, ElementIndex& index,
                           PocketSet& pockets, std::optional<std::uint64_t> maxCost)
    : front_(front), elements_(elements), index_(index), pockets_(pockets) {
  for (std::size_t i = pockets_.size(); i-- > 0;) push(PocketId(i));
  tries_.assign(pockets_.size(), {0, kFirstTries[0].rings, kFirstTries[0].order});
  partialFillsLeft_ =
      kMaxPartialFills + kPartialFillsPerPocket * static_cast<std::uint32_t>(pockets_.size());
  costLeft_ = maxCost.value_or(kExtraCostOfAllTries +
                               kCostOfAllTriesPerFace * static_cast<std::uint64_t>(totalFaces_));
}

void PocketFiller::push(PocketId pocket) {
  stack_.push_back(pocket);
  if (weights_.size() <= pocket.index()) weights_.resize(pocket.index() + 1);
  Weight& weight = weights_[pocket.index()];
  weight.faces = static_cast<double>(pockets_.faces(pocket).size());
  totalFaces_ += weight.faces;
  waitingFaces_ += weight.faces;
}

void PocketFiller::pop() {
  waitingFaces_ -= weights_[stack_.back().index()].faces;
  stack_.pop_back();
}

double PocketFiller::fraction() const {
  if (stack_.empty() || totalFaces_ == 0.0) return 1.0;
  const Weight& now = weights_[stack_.back().index()];
  const double tried = fill_ ? (1.0 - kRemainingAfterFailure) * fill_->fraction() : 0.0;
  const double done = now.faces * (1.0 - now.remaining * (1.0 - tried));
  return 1.0 - (waitingFaces_ - done) / totalFaces_;
}

std::size_t PocketFiller::work(std::uint32_t budget) {
  if (isDone()) return 1;
  if (!fill_) return begin();
  // Applying the result costs as much as the pocket is large, so it gets a slice of its own.
  if (fillState_ == ExactFill::State::kRunning) {
    fillState_ = fill_->advance(budget);
  } else {
    finish();
  }
  return budget;
}

/// Gives the next pocket to the exact fill, together with the elements around it.
std::size_t PocketFiller::begin() {
  const PocketId number = stack_.back();
  Try& now = tries_[number.index()];
  Pocket pocket{pockets_.faces(number), false};
  // The pocket was filled as part of another one.
  if (pocket.faces.empty()) {
    pop();
    return 1;
  }
  std::size_t touched = pocket.faces.size();
  if (now.rings > 0) {
    std::vector<TetId> around =
        index_.around(pockets_.nodes(number), now.rings, std::numeric_limits<std::size_t>::max());
    touched += around.size();
    now.isLargest = around.empty() || around.size() == now.removed;
    now.removed = around.size();
    if (now.isLargest) {
      if (!prepareNext(now)) pop();
      return 1 + touched / kTouchedPerStep;
    }
    enlarged_.emplace(front_, elements_, pockets_, number, std::move(around));
    pocket.faces = enlarged_->faces();
  }
  const std::uint64_t limit = canFillPartially(now) && !now.isLastRound
                                  ? kFillCostPerFace * pocket.faces.size() + kExtraFillCost
                                  : ExactFill::kNoLimit;
  fill_.emplace(front_, std::move(pocket), now.order, std::min(limit, costLeft_));
  return 1 + touched / kTouchedPerStep;
}

bool PocketFiller::canFillPartially(const Try& now) const {
  return now.rings <= kMaxRingsForPartialFill && partialFillsLeft_ > 0;
}

/// Returns false if everything has been tried.
bool PocketFiller::prepareNext(Try& now) const {
  const bool wasLater = now.triesMade >= kFirstTries.size();
  if (!wasLater && now.triesMade + 1 < kFirstTries.size() && partialFillsLeft_ > 0) {
    const FirstTry& first = kFirstTries[now.triesMade + 1];
    now = {now.triesMade + 1, first.rings, first.order};
  } else if (!wasLater) {
    now = {kFirstTries.size(), 0, 0};
  } else if (!now.isLargest) {
    now.rings = std::max(1U, 2 * now.rings);
  } else {
    now = {now.triesMade, 0, now.order + 1, {}, false, now.isLastRound};
    if (now.order == ExactFill::kOrders && !now.isLastRound) {
      now = {now.triesMade, 0, 0, {}, false, true};
    }
  }
  return now.order < ExactFill::kOrders;
}

void PocketFiller::finish() {
  const PocketId number = stack_.back();
  Try& now = tries_[number.index()];
  costLeft_ -= std::min(costLeft_, fill_->cost());
  if (fillState_ == ExactFill::State::kDone) {
    apply();
    pop();
  } else if (fillState_ == ExactFill::State::kPartial && canFillPartially(now)) {
    --partialFillsLeft_;
    std::vector<FaceId> open = apply();
    pop();
    queueOpen(std::move(open), now);
  } else {
    if (enlarged_) enlarged_->restore(front_, elements_, pockets_);
    weights_[number.index()].remaining *= kRemainingAfterFailure;
    if (costLeft_ == 0) {
      giveUp();
    } else if (!prepareNext(now)) {
      pop();
    }
  }
  enlarged_.reset();
  fill_.reset();
  fillState_ = ExactFill::State::kRunning;
}

/// Leaves all pockets open that still wait.
void PocketFiller::giveUp() {
  while (!stack_.empty()) pop();
}

/// Returns the faces around the volume left open.
std::vector<FaceId> PocketFiller::apply() {
  if (!enlarged_) pockets_.remove(stack_.back());
  const std::size_t elements = elements_.size();
  const std::size_t nodes = front_.nodes().size();
  std::vector<FaceId> open = fill_->apply(front_, elements_);
  made_.push_back({{elements, elements_.size()}, {nodes, front_.nodes().size()}});
  return open;
}

/// Queues the volume around points that doubles cannot hold. It is mostly small, so a ring of
/// elements around it is small too.
void PocketFiller::queueOpen(std::vector<FaceId> open, Try tried) {
  if (!prepareNext(tried)) return;
  stableSort(open);
  std::vector<Pocket> pockets = findPockets(front_, open);
  std::reverse(pockets.begin(), pockets.end());
  for (Pocket& pocket : pockets) {
    push(pockets_.add(std::move(pocket.faces)));
    tries_.push_back(tried);
  }
}

}  // namespace tetrafront
