#include "arrangement/triangle_cuts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "topology/mesh_access.h"

namespace tetrafront {

TriangleCuts::TriangleCuts(const SurfaceMesh& mesh, CutPoints& points)
    : mesh_(mesh),
      points_(points),
      coplanar_(countTriangles(mesh)),
      isCoplanar_(countTriangles(mesh), 0) {}

std::array<int, 3> TriangleCuts::sidesOf(const NodeTriple& triangle,
                                         const NodeTriple& other) const {
  std::array<int, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] =
        orient3d(tetrafront::pointOf(mesh_, triangle[0]), tetrafront::pointOf(mesh_, triangle[1]),
                 tetrafront::pointOf(mesh_, triangle[2]), tetrafront::pointOf(mesh_, other[k]));
  }
  return sides;
}

bool TriangleCuts::isCornerInside(const NodeTriple& triangle, NodeId corner) const {
  const CutView view = viewOf(mesh_, triangle);
  const auto at = [](NodeId node) { return CutPointId(node.value); };
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] == corner) return true;
    if (points_.orient(view, at(triangle[k]), at(triangle[(k + 1) % 3]), at(corner)) < 0)
      return false;
  }
  return true;
}

bool TriangleCuts::isEdgeThrough(const NodeTriple& triangle, NodeId from, NodeId to) const {
  bool isAbove = false;
  bool isBelow = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orient3d(pointOf(mesh_, from), pointOf(mesh_, to), pointOf(mesh_, triangle[k]),
                              pointOf(mesh_, triangle[(k + 1) % 3]));
    isAbove = isAbove || side > 0;
    isBelow = isBelow || side < 0;
  }
  return !isAbove || !isBelow;
}

void TriangleCuts::collectPoints(const NodeTriple& triangle, const NodeTriple& other,
                                 const std::array<int, 3>& sides, std::vector<CutPointId>& found) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (sides[k] == 0 && isCornerInside(triangle, other[k])) found.emplace_back(other[k].value);
    if (sides[k] * sides[next] >= 0) continue;
    const auto [low, high] = std::minmax(other[k], other[next]);
    if (isEdgeThrough(triangle, low, high)) found.push_back(points_.addOnLine(low, high, triangle));
  }
}

void TriangleCuts::addPair(TriangleId a, TriangleId b) {
  const NodeTriple nodesA = nodesOf(mesh_, a);
  const NodeTriple nodesB = nodesOf(mesh_, b);
  const std::array<int, 3> sidesOfA = sidesOf(nodesB, nodesA);
  const std::array<int, 3> sidesOfB = sidesOf(nodesA, nodesB);
  if (sidesOfB == std::array{0, 0, 0}) {
    coplanar_.join(a.value, b.value);
    isCoplanar_[a.index()] = isCoplanar_[b.index()] = 1;
    return;
  }
  std::vector<CutPointId> found;
  collectPoints(nodesA, nodesB, sidesOfB, found);
  collectPoints(nodesB, nodesA, sidesOfA, found);
  sortUnique(found);
  if (found.empty()) return;
  cuts_.push_back({a, {found.front(), found.back(), {nodesB}}});
  cuts_.push_back({b, {found.front(), found.back(), {nodesA}}});
}

std::vector<TriangleCuts::Cut> TriangleCuts::takeCuts() {
  stableSort(cuts_, [](const Cut& a, const Cut& b) { return a.triangle < b.triangle; });
  return std::move(cuts_);
}

std::vector<std::vector<TriangleId>> TriangleCuts::takeGroups(std::span<const Cut> cuts) {
  std::vector<std::uint8_t> isChanged = isCoplanar_;
  for (const Cut& cut : cuts) isChanged[cut.triangle.index()] = 1;
  std::vector<std::uint32_t> groupOf(isChanged.size(), kNoIndex);
  std::vector<std::vector<TriangleId>> groups;
  for (std::uint32_t t = 0; t < isChanged.size(); ++t) {
    if (isChanged[t] == 0) continue;
    std::uint32_t& group = groupOf[coplanar_.find(t)];
    if (group == kNoIndex) {
      group = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back();
    }
    groups[group].emplace_back(t);
  }
  return groups;
}

}  // namespace tetrafront
