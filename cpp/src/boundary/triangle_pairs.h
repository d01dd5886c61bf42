#pragma once

/// @file Which triangles of a surface may meet though they have no node in common? The tree of
/// triangles against itself, told apart by axis-parallel boxes first, then by boxes that lie along
/// the triangles: thousands of needles side by side fill each other's axis-parallel boxes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geom/oriented_box.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// In slices. O(n log n) for surfaces whose triangles have few others near them, needles included; where
/// the tips of two fans nearly touch, which are nowhere thin, up to the product of their triangles.
class TrianglePairs {
 public:
  /// `tree`: of the triangles' boxes. Both must outlive this.
  TrianglePairs(const SurfaceMesh& mesh, const BoxTree& tree);

  /// Looks at about `budget` pairs of tree nodes and calls visit(a, b) for every pair of triangles
  /// that it cannot tell apart, each once, in an order that depends on the surface only. True when
  /// finished.
  template <class Visit>
  bool advance(std::size_t budget, Visit visit);

  [[nodiscard]] double fraction() const;

 private:
  /// Nodes that all triangles of a branch have in common; a fan's triangles share one.
  using CommonNodes = std::array<std::uint32_t, 3>;
  struct Branches {
    std::uint32_t a;
    std::uint32_t b;
  };

  [[nodiscard]] bool isEmpty(std::uint32_t branch) const {
    return tree_.boxOf(branch).low[0] > tree_.boxOf(branch).high[0];
  }
  [[nodiscard]] CommonNodes nodesOf(std::uint32_t triangle) const;
  static CommonNodes commonOf(const CommonNodes& a, const CommonNodes& b);
  static bool shareNode(const CommonNodes& a, const CommonNodes& b);

  [[nodiscard]] std::uint32_t leavesBelow(std::uint32_t branch) const;
  void describeLeaf(std::uint32_t leaf);
  void describeBranch(std::uint32_t branch);
  /// False if no triangle of the one meets one of the other but where both have a node.
  [[nodiscard]] bool mayIntersect(const Branches& pair) const;
  void descend(const Branches& pair);
  template <class Visit>
  void visitLeaves(const Branches& pair, Visit visit) const;

  const SurfaceMesh& mesh_;
  const BoxTree& tree_;
  /// Branches are described from the last one up to the root.
  std::uint32_t undescribed_;
  std::vector<OrientedBox> boxes_;
  std::vector<CommonNodes> common_;
  std::vector<Branches> waiting_;
  std::uint32_t leavesPassed_ = 0;
};

template <class Visit>
bool TrianglePairs::advance(std::size_t budget, Visit visit) {
  for (; budget > 0 && undescribed_ > 0; --budget) {
    const std::uint32_t branch = --undescribed_;
    if (isEmpty(branch)) continue;
    if (tree_.isLeaf(branch)) {
      describeLeaf(branch);
    } else {
      describeBranch(branch);
    }
  }
  for (; budget > 0 && !waiting_.empty(); --budget) {
    const Branches pair = waiting_.back();
    waiting_.pop_back();
    if (!mayIntersect(pair)) {
      if (pair.a == pair.b) leavesPassed_ += leavesBelow(pair.a);
    } else if (tree_.isLeaf(pair.a)) {
      visitLeaves(pair, visit);
      if (pair.a == pair.b) ++leavesPassed_;
    } else {
      descend(pair);
    }
  }
  return undescribed_ == 0 && waiting_.empty();
}

template <class Visit>
void TrianglePairs::visitLeaves(const Branches& pair, Visit visit) const {
  const std::span<const std::uint32_t> itemsA = tree_.itemsOf(pair.a);
  const std::span<const std::uint32_t> itemsB = tree_.itemsOf(pair.b);
  const std::span<const Box> boxesA = tree_.itemBoxesOf(pair.a);
  const std::span<const Box> boxesB = tree_.itemBoxesOf(pair.b);
  for (std::size_t i = 0; i < itemsA.size(); ++i) {
    for (std::size_t j = pair.a == pair.b ? i + 1 : 0; j < itemsB.size(); ++j) {
      if (!BoxTree::meets(boxesA[i], boxesB[j])) continue;
      if (!shareNode(nodesOf(itemsA[i]), nodesOf(itemsB[j]))) visit(itemsA[i], itemsB[j]);
    }
  }
}

}  // namespace tetrafront
