#include "boundary/triangle_pairs.h"

#include <algorithm>
#include <cstddef>

#include "boundary/surface_access.h"

namespace tetrafront {

TrianglePairs::TrianglePairs(const SurfaceMesh& mesh, const BoxTree& tree)
    : mesh_(mesh), tree_(tree), undescribed_(tree.nodeCount()) {
  // The last leaves of the tree are empty, up to half of it.
  while (undescribed_ > 0 && isEmpty(undescribed_ - 1)) --undescribed_;
  boxes_.resize(undescribed_);
  common_.resize(undescribed_);
  if (undescribed_ > 0) waiting_.push_back({0, 0});
}

double TrianglePairs::fraction() const {
  const double leaves = 0.5 * (static_cast<double>(tree_.nodeCount()) + 1.0);
  return std::min(static_cast<double>(leavesPassed_) / leaves, 1.0);
}

std::uint32_t TrianglePairs::leavesBelow(std::uint32_t branch) const {
  std::uint32_t leaves = 1;
  for (; !tree_.isLeaf(branch); branch = 2 * branch + 1) leaves *= 2;
  return leaves;
}

TrianglePairs::CommonNodes TrianglePairs::nodesOf(std::uint32_t triangle) const {
  const std::size_t i = 3 * std::size_t{triangle};
  return {mesh_.triangles[i], mesh_.triangles[i + 1], mesh_.triangles[i + 2]};
}

bool TrianglePairs::shareNode(const CommonNodes& a, const CommonNodes& b) {
  return std::ranges::any_of(a, [&](std::uint32_t node) {
    return node != kNoIndex && (node == b[0] || node == b[1] || node == b[2]);
  });
}

TrianglePairs::CommonNodes TrianglePairs::commonOf(const CommonNodes& a, const CommonNodes& b) {
  CommonNodes common{kNoIndex, kNoIndex, kNoIndex};
  std::ranges::copy_if(a, common.begin(),
                       [&](std::uint32_t node) { return std::ranges::count(b, node) > 0; });
  return common;
}

void TrianglePairs::describeLeaf(std::uint32_t leaf) {
  bool isFirst = true;
  for (const std::uint32_t triangle : tree_.itemsOf(leaf)) {
    const std::array<Vec3, 3> p = cornersOf(mesh_, triangle);
    const OrientedBox box = OrientedBox::of(p[0], p[1], p[2]);
    const CommonNodes nodes = nodesOf(triangle);
    boxes_[leaf] = isFirst ? box : OrientedBox::hull(boxes_[leaf], box);
    common_[leaf] = isFirst ? nodes : commonOf(common_[leaf], nodes);
    isFirst = false;
  }
}

void TrianglePairs::describeBranch(std::uint32_t branch) {
  const std::uint32_t left = 2 * branch + 1;
  const std::uint32_t right = left + 1;
  // Where anything is in the right branch, the left one is full.
  const bool isLeftOnly = isEmpty(right);
  boxes_[branch] = isLeftOnly ? boxes_[left] : OrientedBox::hull(boxes_[left], boxes_[right]);
  common_[branch] = isLeftOnly ? common_[left] : commonOf(common_[left], common_[right]);
}

bool TrianglePairs::mayIntersect(const Branches& pair) const {
  if (isEmpty(pair.a) || isEmpty(pair.b)) return false;
  if (shareNode(common_[pair.a], common_[pair.b])) return false;
  if (pair.a == pair.b) return true;
  return BoxTree::meets(tree_.boxOf(pair.a), tree_.boxOf(pair.b)) &&
         !boxes_[pair.a].isApartFrom(boxes_[pair.b]);
}

void TrianglePairs::descend(const Branches& pair) {
  const std::uint32_t a = 2 * pair.a + 1;
  const std::uint32_t b = 2 * pair.b + 1;
  // The last one in is the next one out.
  waiting_.push_back({a + 1, b + 1});
  waiting_.push_back({a, b + 1});
  if (pair.a != pair.b) waiting_.push_back({a + 1, b});
  waiting_.push_back({a, b});
}

}  // namespace tetrafront
