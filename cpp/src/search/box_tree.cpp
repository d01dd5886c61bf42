#include "search/box_tree.h"

#include <algorithm>
#include <limits>

#include "search/morton.h"

namespace tetrafront {
namespace {

/// Meets nothing.
Box emptyBox() {
  constexpr float kFar = std::numeric_limits<float>::max();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

Box hull(const Box& a, const Box& b) {
  Box result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.low[k] = std::min(a.low[k], b.low[k]);
    result.high[k] = std::max(a.high[k], b.high[k]);
  }
  return result;
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  std::vector<Vec3> centres(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int a = 0; a < 3; ++a) {
      const auto k = static_cast<std::size_t>(a);
      centres[i][a] = 0.5 * (double{boxes[i].low[k]} + double{boxes[i].high[k]});
    }
  }
  items_ = mortonOrder(centres);
  boxes_.reserve(items_.size());
  for (const std::uint32_t item : items_) boxes_.push_back(boxes[item]);
  std::uint32_t leaves = 1;
  while (std::size_t{leaves} * kItemsPerLeaf < items_.size()) leaves *= 2;
  firstLeaf_ = leaves - 1;
  nodes_.assign(2 * std::size_t{leaves} - 1, emptyBox());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    Box& leaf = nodes_[firstLeaf_ + i / kItemsPerLeaf];
    leaf = hull(leaf, boxes_[i]);
  }
  for (std::size_t n = firstLeaf_; n-- > 0;) nodes_[n] = hull(nodes_[2 * n + 1], nodes_[2 * n + 2]);
}

std::uint32_t BoxTree::leafEnd(std::uint32_t node) const {
  return std::min(leafBegin(node) + kItemsPerLeaf, static_cast<std::uint32_t>(items_.size()));
}

double BoxTree::squaredDistance(const Box& box, const Vec3& place) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double gap = std::max({box.low[k] - place[a], place[a] - box.high[k], 0.0});
    sum += gap * gap;
  }
  return sum;
}

}  // namespace tetrafront
