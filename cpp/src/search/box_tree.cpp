#include "search/box_tree.h"

#include <algorithm>
#include <limits>

#include "base/free_memory.h"

namespace tetrafront {
namespace {

/// A box that overlaps nothing.
Box emptyBox() {
  constexpr float kFar = std::numeric_limits<float>::max();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

Box hull(const Box& a, const Box& b) {
  Box result = a;
  result.include(b);
  return result;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  BoxTreeBuilder builder({boxes.begin(), boxes.end()});
  while (!builder.advance(boxes.size())) {
  }
  *this = builder.take();
}

BoxTreeBuilder::BoxTreeBuilder(std::vector<Box> boxes)
    : stage_(boxes.empty() ? Stage::kDone : Stage::kCentres),
      end_(boxes.size()),
      boxes_(std::move(boxes)),
      centres_(boxes_.size()),
      order_(centres_) {}

bool BoxTreeBuilder::advance(std::size_t budget) {
  if (stage_ == Stage::kDone) return true;
  if (stage_ == Stage::kOrder) {
    if (order_.advance(budget)) endStage();
    return false;
  }
  const std::size_t last = next_ + std::min(budget, end_ - next_);
  if (stage_ == Stage::kCentres) placeCentres(next_, last);
  if (stage_ == Stage::kLeaves) fillLeaves(next_, last);
  if (stage_ == Stage::kBranches) growBranches(next_, last);
  next_ = last;
  if (next_ == end_) endStage();
  return stage_ == Stage::kDone;
}

void BoxTreeBuilder::endStage() {
  next_ = 0;
  switch (stage_) {
    case Stage::kCentres:
      stage_ = Stage::kOrder;
      break;
    case Stage::kOrder: {
      tree_.items_ = order_.take();
      freeMemory(centres_);
      tree_.boxes_.reserve(tree_.items_.size());
      std::uint32_t leaves = 1;
      while (std::size_t{leaves} * BoxTree::kItemsPerLeaf < tree_.items_.size()) leaves *= 2;
      tree_.firstLeaf_ = leaves - 1;
      tree_.nodes_.assign(2 * std::size_t{leaves} - 1, emptyBox());
      stage_ = Stage::kLeaves;
      break;
    }
    case Stage::kLeaves:
      freeMemory(boxes_);
      end_ = tree_.firstLeaf_;
      stage_ = end_ > 0 ? Stage::kBranches : Stage::kDone;
      break;
    case Stage::kBranches:
    case Stage::kDone:
      stage_ = Stage::kDone;
      break;
  }
}

void BoxTreeBuilder::placeCentres(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      centres_[i][a] = 0.5 * (double{boxes_[i].low[k]} + double{boxes_[i].high[k]});
    }
  }
}

void BoxTreeBuilder::fillLeaves(std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    const Box& box = tree_.boxes_.emplace_back(boxes_[tree_.items_[i]]);
    Box& leaf = tree_.nodes_[tree_.firstLeaf_ + i / BoxTree::kItemsPerLeaf];
    leaf = hull(leaf, box);
  }
}

/// Bottom-up, so the last node first.
void BoxTreeBuilder::growBranches(std::size_t first, std::size_t last) {
  std::vector<Box>& nodes = tree_.nodes_;
  for (std::size_t i = first; i < last; ++i) {
    const std::size_t n = end_ - 1 - i;
    nodes[n] = hull(nodes[2 * n + 1], nodes[2 * n + 2]);
  }
}

std::uint32_t BoxTree::leafEnd(std::uint32_t node) const {
  return std::min(leafBegin(node) + kItemsPerLeaf, static_cast<std::uint32_t>(items_.size()));
}

}  // namespace tetrafront
