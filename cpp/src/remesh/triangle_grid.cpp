#include "remesh/triangle_grid.h"

#include <algorithm>
#include <array>

#include "search/box_tree.h"

namespace tetrafront {
namespace {

Box boxAround(const std::array<Vec3, 3>& corners) {
  return Box::of(corners[0], corners[1], corners[2]);
}

}  // namespace

NumberedTriangle numbered(const NodeTriple& nodes, const std::array<Vec3, 3>& corners) {
  return {{nodes[0].value, nodes[1].value, nodes[2].value}, corners};
}

void TriangleGrid::insert(TriangleId triangle) {
  if (triangle.index() >= boxes_.size()) {
    boxes_.resize(triangle.index() + 1);
    isHidden_.resize(boxes_.size(), 0);
  }
  boxes_[triangle.index()] = boxAround(complex_.cornersOf(triangle));
  grid_.insert(triangle.value, boxes_[triangle.index()]);
}

void TriangleGrid::update(TriangleId triangle) {
  boxes_[triangle.index()] = boxAround(complex_.cornersOf(triangle));
  grid_.update(triangle.value, boxes_[triangle.index()]);
}

void TriangleGrid::setHidden(std::span<const TriangleId> triangles, bool isHidden) {
  for (const TriangleId t : triangles) isHidden_[t.index()] = isHidden ? 1 : 0;
}

bool TriangleGrid::intersect(std::span<const NumberedTriangle> triangles,
                             std::span<const NumberedTriangle> uncovered) {
  if (triangles.empty()) return false;
  separation_.begin(triangles);
  return intersectEachOther(triangles) || (!uncovered.empty() && intersectsAny(uncovered));
}

bool TriangleGrid::intersectEachOther(std::span<const NumberedTriangle> triangles) {
  if (separation_.areApart()) return false;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Box box = boxAround(triangles[i].corners);
    for (std::size_t j = 0; j < i; ++j) {
      if (BoxTree::overlaps(box, boxAround(triangles[j].corners)) &&
          intersectImproperly(triangles[i], triangles[j]))
        return true;
    }
  }
  return false;
}

bool TriangleGrid::intersectsAny(std::span<const NumberedTriangle> triangles) {
  ofGiven_.clear();
  for (const NumberedTriangle& triangle : triangles)
    ofGiven_.push_back(boxAround(triangle.corners));
  Box whole = ofGiven_[0];
  for (const Box& box : ofGiven_) {
    for (std::size_t k = 0; k < 3; ++k) {
      whole.low[k] = std::min(whole.low[k], box.low[k]);
      whole.high[k] = std::max(whole.high[k], box.high[k]);
    }
  }
  const std::size_t count = grid_.query(whole, found_);
  for (std::size_t n = 0; n < count; ++n) {
    const TriangleId t(found_[n]);
    if (isHidden(t)) continue;
    const auto isNear = [&](const Box& box) { return BoxTree::overlaps(box, boxes_[t.index()]); };
    if (std::ranges::none_of(ofGiven_, isNear)) continue;
    const NumberedTriangle other = numbered(complex_.nodesOf(t), complex_.cornersOf(t));
    if (separation_.isApart(other)) continue;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (isNear(ofGiven_[i]) && intersectImproperly(triangles[i], other)) return true;
    }
  }
  return false;
}

}  // namespace tetrafront
