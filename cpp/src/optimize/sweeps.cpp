#include "optimize/sweeps.h"

#include <algorithm>
#include <utility>

namespace tetrafront {
namespace {

/// Cost of one such operation, in elements of a sweep.
constexpr std::uint32_t kRepairWork = 64;
constexpr std::uint32_t kLastResortWork = 1000;

}  // namespace

template <class Space>
void Sweeps<Space>::measureBy(const ElementCost<Space>& cost, std::uint32_t since) {
  cost_ = cost;
  lastRun_.fill(since);
}

template <class Space>
void Sweeps<Space>::begin(Sweep sweep) {
  sweep_ = sweep;
  next_ = 0;
  end_ = size();
  complex_.beginPass();
  since_ = std::exchange(lastRun_[static_cast<std::size_t>(sweep)], complex_.pass());
  if (isDone()) end();
}

template <class Space>
std::size_t Sweeps<Space>::size() const {
  switch (sweep_) {
    case Sweep::kSwap:
    case Sweep::kCollectSplits:
    case Sweep::kCollectPoor:
    case Sweep::kScore:
      return complex_.slotCount();
    case Sweep::kMove:
    case Sweep::kNewton:
    case Sweep::kCollectCollapses:
      return complex_.nodeCount();
    case Sweep::kSplit:
      return splitter_.collected();
    case Sweep::kCollapse:
      return collapser_.collected();
    case Sweep::kImprove:
    case Sweep::kLastResort:
      return improvements_.collected();
  }
  return 0;
}

template <class Space>
std::size_t Sweeps<Space>::advance(std::uint32_t budget) {
  if (isDone()) return 0;
  std::size_t done = 0;
  if (sweep_ == Sweep::kLastResort) {
    done = tryLastResort();
  } else {
    const std::uint32_t each = sweep_ == Sweep::kImprove ? kRepairWork : 1;
    const std::size_t count = std::min<std::size_t>(end_ - next_, std::max(1U, budget / each));
    work(next_, next_ + count);
    next_ += count;
    done = count * each;
  }
  if (isDone()) end();
  return done;
}

template <class Space>
std::size_t Sweeps<Space>::takeChanges() {
  return std::exchange(changes_, 0);
}

template <class Space>
void Sweeps<Space>::work(std::size_t first, std::size_t last) {
  switch (sweep_) {
    case Sweep::kSwap:
      return swap(first, last);
    case Sweep::kMove:
      return move(first, last, MoveKind::kCircumcentres);
    case Sweep::kNewton:
      return move(first, last, MoveKind::kNewton);
    case Sweep::kCollectSplits:
      return splitter_.collect(first, last, since_);
    case Sweep::kCollectCollapses:
      return collapser_.collect(first, last, since_);
    case Sweep::kSplit:
      changes_ += splitter_.splitSome(first, last - first, cost_);
      return;
    case Sweep::kCollapse:
      changes_ += collapser_.collapseSome(first, last - first, cost_);
      return;
    case Sweep::kCollectPoor:
      return improvements_.collect(first, last);
    case Sweep::kImprove:
      changes_ += improvements_.improveSome(first, last, cost_);
      return;
    case Sweep::kLastResort:
      return;  // one try at a time
    case Sweep::kScore:
      return addToScore(first, last);
  }
}

template <class Space>
void Sweeps<Space>::end() {
  switch (sweep_) {
    case Sweep::kCollectSplits:
      return splitter_.sortCollected();
    case Sweep::kCollectCollapses:
      return collapser_.sortCollected();
    case Sweep::kSplit:
      return splitter_.clear();
    case Sweep::kCollapse:
      return collapser_.clear();
    case Sweep::kCollectPoor:
      return improvements_.rank();
    default:
      return;
  }
}

template <class Space>
void Sweeps<Space>::swap(std::size_t first, std::size_t last) {
  for (std::size_t t = first; t < last; ++t) {
    // After a swap another element may occupy this slot: visit all its edges.
    while (swapOneEdgeOf(TetId(t))) {
    }
  }
}

template <class Space>
bool Sweeps<Space>::swapOneEdgeOf(TetId tet) {
  constexpr std::size_t kBulkRing = 7;
  if (!complex_.isLive(tet) || complex_.changedIn(tet) < since_) return false;
  EdgeRing ring;
  for (std::size_t e = 0; e < kTetEdges.size(); ++e) {
    if (!findClosedRing(complex_, tet, e, kBulkRing, since_, ring)) continue;
    if (removal_.improve(ring, cost_, {})) return true;
  }
  return false;
}

template <class Space>
void Sweeps<Space>::move(std::size_t first, std::size_t last, MoveKind kind) {
  for (std::size_t i = first; i < last; ++i) {
    const NodeId node(i);
    if (!complex_.isFixed(node) && complex_.starChangedIn(node) >= since_)
      mover_.improve(node, kind, cost_);
  }
}

template <class Space>
void Sweeps<Space>::addToScore(std::size_t first, std::size_t last) {
  if (first == 0) score_ = {};
  for (std::size_t t = first; t < last; ++t) {
    if (complex_.isLive(TetId(t))) score_.template add<Space>(complex_, TetId(t));
  }
}

/// Makes one try on the current element, or advances to the next one.
template <class Space>
std::size_t Sweeps<Space>::tryLastResort() {
  using LastResort = typename ImprovementQueue<Space>::LastResort;
  const LastResort outcome = improvements_.tryLastResort(next_, cost_);
  if (outcome == LastResort::kTried) return kLastResortWork;
  changes_ += outcome == LastResort::kImproved ? 1 : 0;
  ++next_;
  return 1;
}

template class Sweeps<PlainSpace>;
template class Sweeps<StretchedSpace>;

}  // namespace tetrafront
