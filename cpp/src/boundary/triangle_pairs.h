#pragma once

/// @file The pairs of triangles that may intersect although they have no common node. Traverses the tree of triangles
/// against itself. Branches are separated by their axis-parallel boxes first, and then by boxes along the triangles:
/// the axis-parallel boxes of thousands of needles side by side all overlap.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/resumable.h"
#include "geom/oriented_box.h"
#include "search/box_tree.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Finds the pairs in slices. O(n log n) for surfaces, needles included, whose triangles have few others near them.
/// Where the tips of two fans nearly touch, up to the product of their triangle counts: a fan is nowhere thin.
class TrianglePairs : public Resumable {
 public:
  /// `tree`: tree of triangleBoxes(). Both must outlive this object.
  TrianglePairs(const SurfaceMesh& mesh, const BoxTree& tree);

  /// Processes about `budget` pairs of branches and calls visit(a, b) once for each pair of triangles that the boxes
  /// do not separate. The order depends on the surface only. Returns true when finished.
  template <class Visit>
  bool advance(std::size_t budget, Visit visit);

 private:
  /// Nodes that all triangles of a branch share, as those of a fan do; the rest is none.
  using CommonNodes = NodeTriple;

  struct BranchPair {
    BranchId a;
    BranchId b;
  };

  [[nodiscard]] bool isEmpty(BranchId branch) const {
    return tree_.boxOf(branch).low[0] > tree_.boxOf(branch).high[0];
  }
  static CommonNodes commonOf(const CommonNodes& a, const CommonNodes& b);
  [[nodiscard]] static bool shareNode(const CommonNodes& a, const CommonNodes& b);
  [[nodiscard]] bool shareNode(TriangleId triangle, TriangleId other) const;

  [[nodiscard]] std::uint32_t leavesBelow(BranchId branch) const;
  void describe(BranchId branch);
  void describeLeaf(BranchId leaf);
  void describeInner(BranchId branch);
  /// Returns false if no two triangles of the branches intersect, other than at common nodes.
  [[nodiscard]] bool mayIntersect(const BranchPair& pair) const;
  void pushChildren(const BranchPair& pair);
  template <class Visit>
  void visitLeaves(const BranchPair& pair, Visit visit) const;

  const SurfaceMesh& mesh_;
  const BoxTree& tree_;
  std::vector<OrientedBox> boxes_;   ///< per branch
  std::vector<CommonNodes> common_;  ///< per branch
  bool areBranchesDescribed_ = false;
  std::vector<BranchPair> waiting_;  ///< a stack
};

template <class Visit>
bool TrianglePairs::advance(std::size_t budget, Visit visit) {
  if (!areBranchesDescribed_) {
    // From the last branch up to the root: a branch needs its children.
    const auto [first, last] = take(budget);
    for (std::size_t i = first; i < last; ++i) {
      describe(BranchId(boxes_.size() - 1 - i));
    }
    if (!isPassDone()) return false;
    areBranchesDescribed_ = true;
    beginPass((tree_.nodeCount() + std::size_t{1}) / 2, 1.0);
    budget -= last - first;
  }
  for (; budget > 0 && !waiting_.empty(); --budget) {
    const BranchPair pair = waiting_.back();
    waiting_.pop_back();
    if (!mayIntersect(pair)) {
      if (pair.a == pair.b) take(leavesBelow(pair.a));
    } else if (tree_.isLeaf(pair.a)) {
      visitLeaves(pair, visit);
      if (pair.a == pair.b) take(1);
    } else {
      pushChildren(pair);
    }
  }
  return waiting_.empty();
}

template <class Visit>
void TrianglePairs::visitLeaves(const BranchPair& pair, Visit visit) const {
  const std::span<const std::uint32_t> itemsA = tree_.itemsOf(pair.a);
  const std::span<const std::uint32_t> itemsB = tree_.itemsOf(pair.b);
  const std::span<const Box> boxesA = tree_.itemBoxesOf(pair.a);
  const std::span<const Box> boxesB = tree_.itemBoxesOf(pair.b);
  for (std::size_t i = 0; i < itemsA.size(); ++i) {
    for (std::size_t j = pair.a == pair.b ? i + 1 : 0; j < itemsB.size(); ++j) {
      const TriangleId a(itemsA[i]);
      const TriangleId b(itemsB[j]);
      if (BoxTree::overlaps(boxesA[i], boxesB[j]) && !shareNode(a, b)) visit(a, b);
    }
  }
}

}  // namespace tetrafront
