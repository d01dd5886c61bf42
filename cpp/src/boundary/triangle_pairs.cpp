#include "boundary/triangle_pairs.h"

#include <algorithm>
#include <cstddef>

#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Progress when all branches are described.
constexpr double kDescribed = 0.2;

}  // namespace

TrianglePairs::TrianglePairs(const SurfaceMesh& mesh, const BoxTree& tree)
    : mesh_(mesh), tree_(tree) {
  // The last leaves of the tree are empty, up to half of all.
  std::uint32_t branches = tree.nodeCount();
  while (branches > 0 && isEmpty(BranchId(branches - 1))) --branches;
  boxes_.resize(branches);
  common_.resize(branches);
  if (branches > 0) waiting_.push_back({BranchId(0U), BranchId(0U)});
  beginPass(branches, kDescribed);
}

std::uint32_t TrianglePairs::leavesBelow(BranchId branch) const {
  std::uint32_t leaves = 1;
  for (; !tree_.isLeaf(branch); branch = BoxTree::leftOf(branch)) leaves *= 2;
  return leaves;
}

bool TrianglePairs::shareNode(const CommonNodes& a, const CommonNodes& b) {
  return std::ranges::any_of(a, [&](NodeId node) {
    return !node.isNone() && (node == b[0] || node == b[1] || node == b[2]);
  });
}

bool TrianglePairs::shareNode(TriangleId triangle, TriangleId other) const {
  return shareNode(nodesOf(mesh_, triangle), nodesOf(mesh_, other));
}

TrianglePairs::CommonNodes TrianglePairs::commonOf(const CommonNodes& a, const CommonNodes& b) {
  CommonNodes common;
  std::ranges::copy_if(a, common.begin(),
                       [&](NodeId node) { return std::ranges::count(b, node) > 0; });
  return common;
}

void TrianglePairs::describe(BranchId branch) {
  if (isEmpty(branch)) return;
  if (tree_.isLeaf(branch)) {
    describeLeaf(branch);
  } else {
    describeInner(branch);
  }
}

void TrianglePairs::describeLeaf(BranchId leaf) {
  bool isFirst = true;
  for (const std::uint32_t item : tree_.itemsOf(leaf)) {
    const std::array<Vec3, 3> p = cornersOf(mesh_, TriangleId(item));
    const OrientedBox box = OrientedBox::of(p[0], p[1], p[2]);
    const CommonNodes nodes = nodesOf(mesh_, TriangleId(item));
    OrientedBox& hull = boxes_[leaf.index()];
    hull = isFirst ? box : OrientedBox::hull(hull, box);
    CommonNodes& common = common_[leaf.index()];
    common = isFirst ? nodes : commonOf(common, nodes);
    isFirst = false;
  }
}

void TrianglePairs::describeInner(BranchId branch) {
  const BranchId left = BoxTree::leftOf(branch);
  const BranchId right = BoxTree::rightOf(branch);
  boxes_[branch.index()] = boxes_[left.index()];
  common_[branch.index()] = common_[left.index()];
  // If the right branch holds anything, the left one is full.
  if (isEmpty(right)) return;
  boxes_[branch.index()] = OrientedBox::hull(boxes_[left.index()], boxes_[right.index()]);
  common_[branch.index()] = commonOf(common_[left.index()], common_[right.index()]);
}

bool TrianglePairs::mayIntersect(const BranchPair& pair) const {
  if (isEmpty(pair.a) || isEmpty(pair.b)) return false;
  if (shareNode(common_[pair.a.index()], common_[pair.b.index()])) return false;
  if (pair.a == pair.b) return true;
  return BoxTree::overlaps(tree_.boxOf(pair.a), tree_.boxOf(pair.b)) &&
         !boxes_[pair.a.index()].isApartFrom(boxes_[pair.b.index()]);
}

void TrianglePairs::pushChildren(const BranchPair& pair) {
  const BranchId leftA = BoxTree::leftOf(pair.a);
  const BranchId leftB = BoxTree::leftOf(pair.b);
  const BranchId rightA = BoxTree::rightOf(pair.a);
  const BranchId rightB = BoxTree::rightOf(pair.b);
  // `waiting_` is a stack: push in reverse order of processing.
  waiting_.push_back({rightA, rightB});
  waiting_.push_back({leftA, rightB});
  if (pair.a != pair.b) waiting_.push_back({rightA, leftB});
  waiting_.push_back({leftA, leftB});
}

}  // namespace tetrafront
