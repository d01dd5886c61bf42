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
    {.sizeFactor = 0.65, .newNodeWeight = 0.6},
    {.newNodeWeight = 0.6, .smallestFirst = true},
    {.sizeFactor = 1.1, .newNodeWeight = 0.6, .newNodes = false},
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

template <class Trace>
std::size_t LocalRemeshing<Trace>::work(std::uint32_t budget, PocketSet& pockets) {
  switch (stage_) {
    case Stage::kBeginPass:
      beginPass();
      return 1;
    case Stage::kIndex: {
      const std::size_t cost = index_.build(budget);
      if (index_.isBuilt()) stage_ = Stage::kRemesh;
      return cost;
    }
    case Stage::kRemesh:
      return enlargeNext(pockets);
    case Stage::kAdvance:
      return advanceFront(budget, pockets);
    case Stage::kDone:
      break;
  }
  return 1;
}

template <class Trace>
std::uint64_t LocalRemeshing<Trace>::costLimit() const {
  return kTotalCostPerElement * elements_.size() + kExtraTotalCost;
}

template <class Trace>
double LocalRemeshing<Trace>::fraction() const {
  const double passes = static_cast<double>(pass_) / kPasses;
  const double cost = static_cast<double>(cost_) / static_cast<double>(costLimit());
  return std::min(std::max(passes, cost), 1.0);
}

template <class Trace>
void LocalRemeshing<Trace>::beginPass() {
  nextPocket_ = 0;
  if (pass_ == kPasses || front_.activeCount() == 0) {
    stage_ = Stage::kDone;
  } else if (pass_ % kVariants.size() != 0) {
    stage_ = Stage::kRemesh;
  } else {
    index_.begin(front_.nodes().size());
    stage_ = Stage::kIndex;
  }
}

template <class Trace>
std::size_t LocalRemeshing<Trace>::enlargeNext(PocketSet& pockets) {
  while (nextPocket_ < pockets.size() && pockets.faces(PocketId(nextPocket_)).empty())
    ++nextPocket_;
  if (cost_ > costLimit()) {
    stage_ = Stage::kDone;
    return 1;
  }
  if (nextPocket_ == pockets.size()) {
    ++pass_;
    stage_ = Stage::kBeginPass;
    return 1;
  }
  const PocketId pocket(nextPocket_++);
  const auto rings = static_cast<std::uint32_t>(pass_ / kVariants.size() + 1);
  std::vector<TetId> around = index_.around(pockets.nodes(pocket), rings, kMaxRemovedElements);
  const std::size_t touched = around.size() + pockets.faces(pocket).size();
  if (around.size() <= kMaxRemovedElements) {
    costLeft_ = kAttemptCostPerElement * around.size() + kExtraAttemptCost;
    elementsBefore_ = elements_.size();
    nodesBefore_ = front_.nodes().size();
    enlarged_.emplace(front_, elements_, pockets, pocket, std::move(around));
    const RuleVariant& variant = kVariants[pass_ % kVariants.size()];
    advance_.setVariant(variant);
    front_.setOrder(variant.smallestFirst ? FrontOrder::kSmallestFirst : order_);
    for (const FaceId face : enlarged_->faces()) front_.requeue(face, 0);
    advance_.recordChange(FrontChange::kReopened);
    stage_ = Stage::kAdvance;
  }
  const std::size_t cost = 1 + touched / kTouchedPerStep;
  cost_ += cost;
  return cost;
}

template <class Trace>
std::size_t LocalRemeshing<Trace>::advanceFront(std::uint32_t budget, PocketSet& pockets) {
  std::uint64_t cost = 0;
  while (cost < budget && cost < costLeft_ && !front_.isQueueEmpty()) {
    cost += advance_.step();
  }
  costLeft_ -= std::min(cost, costLeft_);
  cost_ += cost;
  if (!front_.isQueueEmpty() && costLeft_ > 0) return cost;
  return cost + finish(pockets);
}

template <class Trace>
std::size_t LocalRemeshing<Trace>::finish(PocketSet& pockets) {
  front_.clearQueue();
  advance_.setVariant(RuleVariant{});
  front_.setOrder(order_);
  stage_ = Stage::kRemesh;
  const std::vector<FaceId> left = enlarged_->facesNow(front_, pockets);
  bool closed = true;
  for (const Pocket& pocket : findPockets(front_, left)) {
    if (!fillFromStarPoint(front_, elements_, pocket)) closed = false;
  }
  if (closed) {
    made_.push_back({elementsBefore_, elements_.size()});
  } else {
    // The index does not know these elements yet: it is queried only before an attempt.
    elements_.dropFrom(elementsBefore_);
    enlarged_->restore(front_, elements_, pockets);
    front_.dropNodesFrom(nodesBefore_);
  }
  advance_.recordChange(closed ? FrontChange::kClosed : FrontChange::kUndone);
  const std::size_t touched =
      enlarged_->faces().size() + enlarged_->removedElements() + left.size();
  enlarged_.reset();
  return 1 + touched / kTouchedPerStep;
}

template class LocalRemeshing<NullTrace>;
template class LocalRemeshing<ClockTrace>;
template class LocalRemeshing<RecordingTrace>;

}  // namespace tetrafront
