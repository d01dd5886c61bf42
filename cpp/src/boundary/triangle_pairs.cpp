#include "boundary/triangle_pairs.h"

#include <algorithm>
#include <cstddef>

#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

/// Progress when all branches are described.
constexpr double kDescribed = 0.2;

}  // namespace

TrianglePairs::TrianglePairs(const SurfaceMesh& mesh, const BoxTree& tree)
    : mesh_(mesh), tree_(tree) {
  // The last leaves of the tree are empty, up to half of all.
  std::uint32_t branches = tree.nodeCount();
  while (branches > 0 && isEmpty(branches - 1)) --branches;
  boxes_.resize(branches);
  common_.resize(branches);
  if (branches > 0) waiting_.push_back({0, 0});
  beginPass(branches, kDescribed);
}

std::uint32_t TrianglePairs::leavesBelow(std::uint32_t branch) const {
  std::uint32_t leaves = 1;
  for (; !tree_.isLeaf(branch); branch = 2 * branch + 1) leaves *= 2;
  return leaves;
}

bool TrianglePairs::shareNode(const CommonNodes& a, const CommonNodes& b) {
  return std::ranges::any_of(a, [&](NodeId node) {
    return !node.isNone() && (node == b[0] || node == b[1] || node == b[2]);
  });
}

bool TrianglePairs::shareNode(std::uint32_t triangle, std::uint32_t other) const {
  return shareNode(nodesOf(mesh_, TriangleId(triangle)), nodesOf(mesh_, TriangleId(other)));
}

TrianglePairs::CommonNodes TrianglePairs::commonOf(const CommonNodes& a, const CommonNodes& b) {
  CommonNodes common;
  std::ranges::copy_if(a, common.begin(),
                       [&](NodeId node) { return std::ranges::count(b, node) > 0; });
  return common;
}

void TrianglePairs::describe(std::uint32_t branch) {
  if (isEmpty(branch)) return;
  if (tree_.isLeaf(branch)) {
    describeLeaf(branch);
  } else {
    describeBranch(branch);
  }
}

void TrianglePairs::describeLeaf(std::uint32_t leaf) {
  bool isFirst = true;
  for (const std::uint32_t item : tree_.itemsOf(leaf)) {
    const std::array<Vec3, 3> p = cornersOf(mesh_, TriangleId(item));
    const OrientedBox box = OrientedBox::of(p[0], p[1], p[2]);
    const CommonNodes nodes = nodesOf(mesh_, TriangleId(item));
    boxes_[leaf] = isFirst ? box : OrientedBox::hull(boxes_[leaf], box);
    common_[leaf] = isFirst ? nodes : commonOf(common_[leaf], nodes);
    isFirst = false;
  }
}

void TrianglePairs::describeBranch(std::uint32_t branch) {
  const std::uint32_t left = 2 * branch + 1;
  const std::uint32_t right = left + 1;
  // If the right branch holds anything, the left one is full.
  const bool isLeftOnly = isEmpty(right);
  boxes_[branch] = isLeftOnly ? boxes_[left] : OrientedBox::hull(boxes_[left], boxes_[right]);
  common_[branch] = isLeftOnly ? common_[left] : commonOf(common_[left], common_[right]);
}

bool TrianglePairs::mayIntersect(const BranchPair& pair) const {
  if (isEmpty(pair.a) || isEmpty(pair.b)) return false;
  if (shareNode(common_[pair.a], common_[pair.b])) return false;
  if (pair.a == pair.b) return true;
  return BoxTree::overlaps(tree_.boxOf(pair.a), tree_.boxOf(pair.b)) &&
         !boxes_[pair.a].isApartFrom(boxes_[pair.b]);
}

void TrianglePairs::pushChildren(const BranchPair& pair) {
  const std::uint32_t a = 2 * pair.a + 1;
  const std::uint32_t b = 2 * pair.b + 1;
  // `waiting_` is a stack: push in reverse order of processing.
  waiting_.push_back({a + 1, b + 1});
  waiting_.push_back({a, b + 1});
  if (pair.a != pair.b) waiting_.push_back({a + 1, b});
  waiting_.push_back({a, b});
}

}  // namespace tetrafront
