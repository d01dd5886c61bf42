#include "search/box_tree.h"

#include <algorithm>
#include <limits>

#include "base/free_memory.h"
#include "search/morton.h"

namespace tetrafront {
namespace {

/// A box that overlaps nothing.
Box emptyBox() {
  constexpr float kFar = std::numeric_limits<float>::max();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

Vec3 centreOf(const Box& box) {
  Vec3 centre;
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    centre[a] = 0.5 * (double{box.low[k]} + double{box.high[k]});
  }
  return centre;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes)
    : BoxTree(Job([boxes](Work& work) {
                return build(work, {boxes.begin(), boxes.end()}, 1);
              }).finish()) {}

Task<BoxTree> BoxTree::build(Work& work, std::vector<Box> boxes, std::size_t visitsPerUnit) {
  BoxTree tree;
  const std::size_t count = boxes.size();
  if (count == 0) co_return tree;
  work.beginPart(0.1);
  std::vector<Vec3> centres(count);
  co_await work.forEachId<std::size_t>(
      count, [&](std::size_t i) { centres[i] = centreOf(boxes[i]); }, visitsPerUnit);
  work.beginPart(0.85);
  tree.items_ = co_await mortonOrder(work, centres, visitsPerUnit);
  freeMemory(centres);

  std::uint32_t leaves = 1;
  while (std::size_t{leaves} * kItemsPerLeaf < count) leaves *= 2;
  tree.firstLeaf_ = leaves - 1;
  tree.nodes_.assign(2 * std::size_t{leaves} - 1, emptyBox());
  tree.boxes_.reserve(count);
  work.beginPart(0.95);
  co_await work.forEachId<std::size_t>(
      count,
      [&](std::size_t i) {
        tree.boxes_.push_back(boxes[tree.items_[i]]);
        tree.nodes_[tree.firstLeaf_ + i / kItemsPerLeaf].include(tree.boxes_.back());
      },
      visitsPerUnit);
  freeMemory(boxes);
  work.beginPart(1.0);
  co_await work.forEachId<std::size_t>(
      tree.firstLeaf_,
      [&](std::size_t i) {
        // Bottom-up.
        const std::size_t n = tree.firstLeaf_ - 1 - i;
        tree.nodes_[n].include(tree.nodes_[2 * n + 1]);
        tree.nodes_[n].include(tree.nodes_[2 * n + 2]);
      },
      visitsPerUnit);
  co_return tree;
}

std::uint32_t BoxTree::leafEnd(std::uint32_t node) const {
  return std::min(leafBegin(node) + kItemsPerLeaf, static_cast<std::uint32_t>(items_.size()));
}

}  // namespace tetrafront
