#pragma once

/// @file A tree over fixed boxes, which finds triangles or tetrahedra near a box or a position.
/// Leaves are runs along a Morton curve. The tree above them is complete, so it needs no pointers.
/// FaceGrid does the same for the front, which changes.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "geom/box.h"
#include "geom/ray.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// A node of a tree, with everything below it.
using BranchId = Id<struct BranchTag>;

class BoxTree {
 public:
  BoxTree() = default;

  /// O(n). The indices of the boxes are the items below.
  explicit BoxTree(std::span<const Box> boxes);
  /// The same in slices; visits each box about fourteen times.
  static Task<BoxTree> build(Work& work, std::vector<Box> boxes, std::size_t visitsPerUnit);

  /// Calls visit(item) for every item whose box overlaps or touches `box`. The order depends on the
  /// boxes only. A `visit` that returns a bool ends the search by returning false.
  template <class Visit>
  void visitOverlaps(const Box& box, Visit visit) const;

  /// Calls visit(item) for every item whose squared distance from `position` is below `squaredLimit`,
  /// near branches first. `visit` may lower `squaredLimit`.
  template <class Visit>
  void visitNear(const Vec3& position, const double& squaredLimit, Visit visit) const;

  /// Calls visit(item) for every item whose box the ray enters at a distance below `limit`, near
  /// branches first. `visit` may lower `limit`.
  template <class Visit>
  void visitAlong(const Ray& ray, const double& limit, Visit visit) const;

  // ---- direct traversal: branch 0 is the root, children have larger ids, and all leaves have the
  // same depth; the last ones are empty ----

  [[nodiscard]] std::uint32_t nodeCount() const {
    return static_cast<std::uint32_t>(nodes_.size());
  }
  [[nodiscard]] static BranchId leftOf(BranchId branch) { return BranchId(2 * branch.value + 1); }
  [[nodiscard]] static BranchId rightOf(BranchId branch) { return BranchId(2 * branch.value + 2); }
  [[nodiscard]] bool isLeaf(BranchId branch) const { return branch.value >= firstLeaf_; }
  [[nodiscard]] const Box& boxOf(BranchId branch) const { return nodes_[branch.index()]; }
  [[nodiscard]] std::span<const std::uint32_t> itemsOf(BranchId leaf) const {
    return ofLeaf(std::span(items_), leaf);
  }
  /// Returns the boxes of itemsOf(), in the same order.
  [[nodiscard]] std::span<const Box> itemBoxesOf(BranchId leaf) const {
    return ofLeaf(std::span(boxes_), leaf);
  }

  template <class Self, class Visit>
  static void visitMembers(Self& self, Visit& visit) {
    visit(self.nodes_, self.firstLeaf_, self.items_, self.boxes_);
  }

  static bool overlaps(const Box& a, const Box& b) {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
           b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
  }

 private:
  static constexpr std::uint32_t kItemsPerLeaf = 4;
  /// At most one entry per level; 2^32 items make 32 levels.
  static constexpr std::size_t kStack = 40;

  [[nodiscard]] std::uint32_t leafBegin(std::uint32_t node) const {
    return std::min((node - firstLeaf_) * kItemsPerLeaf, static_cast<std::uint32_t>(items_.size()));
  }
  [[nodiscard]] std::uint32_t leafEnd(std::uint32_t node) const;
  template <class T>
  [[nodiscard]] std::span<const T> ofLeaf(std::span<const T> ofItems, BranchId leaf) const {
    const std::uint32_t begin = leafBegin(leaf.value);
    return ofItems.subspan(begin, leafEnd(leaf.value) - begin);
  }

  std::vector<Box> nodes_;
  std::uint32_t firstLeaf_ = 0;
  std::vector<std::uint32_t> items_;  ///< in the order of the leaves
  std::vector<Box> boxes_;            ///< boxes of items_, in the same order
};

template <class Visit>
void BoxTree::visitOverlaps(const Box& box, Visit visit) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const std::uint32_t node = stack[--waiting];
    if (!overlaps(nodes_[node], box)) continue;
    if (node < firstLeaf_) {
      stack[waiting++] = 2 * node + 2;
      stack[waiting++] = 2 * node + 1;
      continue;
    }
    for (std::uint32_t i = leafBegin(node); i < leafEnd(node); ++i) {
      if (!overlaps(boxes_[i], box)) continue;
      if constexpr (std::is_same_v<std::invoke_result_t<Visit&, std::uint32_t>, bool>) {
        if (!visit(items_[i])) return;
      } else {
        visit(items_[i]);
      }
    }
  }
}

template <class Visit>
void BoxTree::visitNear(const Vec3& position, const double& squaredLimit, Visit visit) const {
  if (nodes_.empty()) return;
  struct Open {
    std::uint32_t node;
    double squared;
  };
  std::array<Open, kStack> stack;
  std::size_t waiting = 0;
  stack[waiting++] = {0, nodes_[0].squaredDistance(position)};
  while (waiting > 0) {
    const Open open = stack[--waiting];
    if (open.squared >= squaredLimit) continue;
    if (open.node < firstLeaf_) {
      const std::uint32_t child = 2 * open.node + 1;
      const Open left{child, nodes_[child].squaredDistance(position)};
      const Open right{child + 1, nodes_[child + 1].squaredDistance(position)};
      const bool leftFirst = left.squared <= right.squared;
      stack[waiting++] = leftFirst ? right : left;
      stack[waiting++] = leftFirst ? left : right;
      continue;
    }
    for (std::uint32_t i = leafBegin(open.node); i < leafEnd(open.node); ++i) {
      if (boxes_[i].squaredDistance(position) < squaredLimit) visit(items_[i]);
    }
  }
}

template <class Visit>
void BoxTree::visitAlong(const Ray& ray, const double& limit, Visit visit) const {
  if (nodes_.empty()) return;
  struct Open {
    std::uint32_t node;
    double entry;
  };
  std::array<Open, kStack> stack;
  std::size_t waiting = 0;
  const auto open = [&](std::uint32_t node) {
    const double entry = ray.entryInto(nodes_[node], limit);
    if (entry < limit) stack[waiting++] = {node, entry};
  };
  open(0);
  while (waiting > 0) {
    const auto [node, entry] = stack[--waiting];
    if (entry >= limit) continue;
    if (node < firstLeaf_) {
      const std::size_t before = waiting;
      open(2 * node + 1);
      open(2 * node + 2);
      const bool areBoth = waiting == before + 2;
      if (areBoth && stack[before].entry < stack[before + 1].entry)
        std::swap(stack[before], stack[before + 1]);
      continue;
    }
    for (std::uint32_t i = leafBegin(node); i < leafEnd(node); ++i) {
      if (ray.entryInto(boxes_[i], limit) < limit) visit(items_[i]);
    }
  }
}

}  // namespace tetrafront
