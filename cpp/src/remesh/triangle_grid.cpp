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

bool TriangleGrid::collide(const Replacement& change, std::span<const NumberedTriangle> uncovered) {
  if (change.added.empty()) return false;
  separation_.begin(change.added);
  return intersectEachOther(change.added) ||
         (!uncovered.empty() && (intersectsAny(change, uncovered) || passesOverAny(change)));
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

/// Notes the triangles within the box around the change for passesOverAny(): one query serves both.
bool TriangleGrid::intersectsAny(const Replacement& change,
                                 std::span<const NumberedTriangle> triangles) {
  ofGiven_.clear();
  for (const NumberedTriangle& triangle : triangles)
    ofGiven_.push_back(boxAround(triangle.corners));
  Box whole = ofGiven_[0];
  for (const Box& box : ofGiven_) whole.include(box);
  for (const TriangleId t : change.removed) whole.include(boxes_[t.index()]);
  within_.clear();
  const std::size_t count = grid_.query(whole, found_);
  for (std::size_t n = 0; n < count; ++n) {
    const TriangleId t(found_[n]);
    if (isHidden(t)) continue;
    if (whole.contains(boxes_[t.index()])) within_.push_back(t.value);
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

/// A triangle that is passed over is within the box around the change, and no plane separates it from the change. Covered triangles lie
/// in removed ones, so their box is not needed.
bool TriangleGrid::passesOverAny(const Replacement& change) {
  if (within_.empty()) return false;
  beforeAndAfter_.clear();
  for (const TriangleId t : change.removed) {
    beforeAndAfter_.push_back(numbered(complex_.nodesOf(t), complex_.cornersOf(t)));
  }
  // The moved node is another one after the change.
  const auto newNumber = static_cast<std::uint32_t>(complex_.nodeCount());
  for (NumberedTriangle triangle : change.added) {
    std::ranges::replace(triangle.nodes, change.moved.value, newNumber);
    beforeAndAfter_.push_back(triangle);
  }
  separation_.begin(beforeAndAfter_);
  swept_.begin(beforeAndAfter_, change.removed.size());
  return std::ranges::any_of(within_, [&](std::uint32_t face) {
    const TriangleId t(face);
    const NumberedTriangle other = numbered(complex_.nodesOf(t), complex_.cornersOf(t));
    return !separation_.isApart(other) && swept_.contains(other);
  });
}

}  // namespace tetrafront
