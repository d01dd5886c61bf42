#include "volume/local_remeshing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace tetrafront {
namespace {

constexpr std::uint32_t kMaxRings = 3;
/// Rules tried, in this order, for each number of rings. The first two close nearly all pockets.
constexpr std::array<RuleVariant, 6> kVariants{{
    {},
    {.sizeFactor = 0.8, .smallestFirst = true},
    {.sizeFactor = 1.25},
    {.sizeFactor = 0.65, .newNodeWeight = kLowNewNodeWeight},
    {.newNodeWeight = kLowNewNodeWeight, .smallestFirst = true},
    {.sizeFactor = 1.1, .newNodeWeight = kLowNewNodeWeight, .newNodes = false},
}};
constexpr std::uint32_t kPasses = kMaxRings * kVariants.size();

/// Limits of one attempt. Costs are as FrontAdvance::step() returns them.
constexpr std::size_t kMaxRemovedElements = 4000;
constexpr std::uint64_t kAttemptCostPerElement = 30;
constexpr std::uint64_t kExtraAttemptCost = 2000;
/// Limits of all attempts together, per element of the mesh. If there are many pockets, or if
/// triangles are needles, the target sizes contradict the boundary, and trying everything
/// everywhere takes long without success. The exact fill follows, and the optimizer improves its
/// elements as well.
constexpr std::uint64_t kTotalCostPerElement = 2;
constexpr std::uint64_t kExtraTotalCost = 40'000;

}  // namespace

/// One pocket with the elements around it removed.
struct LocalRemeshing::Attempt {
  const RuleVariant& variant;
  std::size_t elementsBefore;
  std::size_t nodesBefore;
  EnlargedPocket enlarged;
};

Task<> LocalRemeshing::run(Work& work, PocketSet& pockets) {
  for (pass_ = 0; pass_ < kPasses && front_.activeCount() > 0; ++pass_) {
    if (pass_ % kVariants.size() == 0) {
      index_.begin(front_.nodes().size());
      while (!index_.isBuilt()) co_await work.spend(index_.build(work.remaining()));
    }
    for (const PocketId pocket : IdRange<PocketId>(pockets.size())) {
      if (pockets.faces(pocket).empty()) continue;
      if (cost_ > costLimit()) co_return;
      const std::uint64_t before = cost_;
      const std::optional<Attempt> attempt = open(pockets, pocket);
      co_await work.spend(static_cast<std::size_t>(cost_ - before));
      if (!attempt) continue;
      const std::size_t removed = attempt->enlarged.removedElements();
      std::uint64_t left = kAttemptCostPerElement * removed + kExtraAttemptCost;
      while (!front_.isQueueEmpty() && left > 0) {
        const std::uint64_t budget = std::min<std::uint64_t>(work.remaining(), left);
        const std::uint64_t cost = advance_.refill(budget, attempt->variant);
        left -= std::min(cost, left);
        cost_ += cost;
        work.setFraction(fraction());
        co_await work.spend(static_cast<std::size_t>(cost));
      }
      co_await work.spend(close(pockets, *attempt));
    }
    if (cost_ > costLimit()) co_return;
  }
}

std::uint64_t LocalRemeshing::costLimit() const {
  return kTotalCostPerElement * elements_.size() + kExtraTotalCost;
}

/// Returns the estimated progress: passes done, or cost used, whichever is more.
double LocalRemeshing::fraction() const {
  const double passes = static_cast<double>(pass_) / kPasses;
  const double cost = static_cast<double>(cost_) / static_cast<double>(costLimit());
  return std::min(std::max(passes, cost), 1.0);
}

/// Removes the elements around a pocket, unless they are too many, and queues its faces.
std::optional<LocalRemeshing::Attempt> LocalRemeshing::open(PocketSet& pockets, PocketId pocket) {
  const auto rings = static_cast<std::uint32_t>(pass_ / kVariants.size() + 1);
  std::vector<TetId> around = index_.around(pockets.nodes(pocket), rings, kMaxRemovedElements);
  cost_ += 1 + (around.size() + pockets.faces(pocket).size()) / kTouchedPerStep;
  if (around.size() > kMaxRemovedElements) return {};
  std::optional<Attempt> attempt(
      Attempt{.variant = kVariants[pass_ % kVariants.size()],
              .elementsBefore = elements_.size(),
              .nodesBefore = front_.nodes().size(),
              .enlarged{front_, elements_, pockets, pocket, std::move(around)}});
  front_.setOrder(attempt->variant.smallestFirst ? FrontOrder::kSmallestFirst : order_);
  for (const FaceId face : attempt->enlarged.faces()) front_.requeue(face, 0);
  advance_.recordChange(FrontChange::kReopened);
  return attempt;
}

/// Keeps the attempt if the pocket has closed, else restores what was before. Returns the cost in steps of the front.
std::size_t LocalRemeshing::close(PocketSet& pockets, const Attempt& attempt) {
  front_.clearQueue();
  front_.setOrder(order_);
  const std::vector<FaceId> left = attempt.enlarged.facesNow(front_, pockets);
  bool closed = true;
  for (const Pocket& pocket : findPockets(front_, left)) {
    if (!fillFromStarPoint(front_, elements_, pocket)) closed = false;
  }
  if (closed) {
    made_.push_back({attempt.elementsBefore, elements_.size()});
  } else {
    // The index does not know these elements yet: it is queried only before an attempt.
    elements_.dropFrom(attempt.elementsBefore);
    attempt.enlarged.restore(front_, elements_, pockets);
    front_.dropNodesFrom(attempt.nodesBefore);
  }
  advance_.recordChange(closed ? FrontChange::kClosed : FrontChange::kUndone);
  const EnlargedPocket& enlarged = attempt.enlarged;
  const std::size_t touched = enlarged.faces().size() + enlarged.removedElements() + left.size();
  return 1 + touched / kTouchedPerStep;
}

}  // namespace tetrafront
