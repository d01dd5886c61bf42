#include "arrangement/arrangement.h"

#include <algorithm>
#include <utility>

#include "arrangement/cut_graph.h"
#include "arrangement/planar_triangulation.h"
#include "arrangement/triangle_cuts.h"
#include "base/mesh_access.h"
#include "base/sort.h"
#include "boundary/self_intersection.h"
#include "search/box_tree.h"

namespace tetrafront {
namespace {

/// Boxes per unit of budget, as in the boundary check.
constexpr std::size_t kTreeBoxesPerUnit = 16;

CutPointId pointAt(NodeId node) { return CutPointId(node.value); }

/// Returns three positions around all points of a graph in its plane.
std::array<Vec3, 3> triangleAround(const CutPoints& points, std::span<const CutPointId> vertices,
                                   const CutView& view) {
  const auto u = static_cast<int>(view.u);
  const auto v = static_cast<int>(view.v);
  Vec3 low = points.rounded(vertices[0]);
  Vec3 high = low;
  for (const CutPointId point : vertices) {
    low = glm::min(low, points.rounded(point));
    high = glm::max(high, points.rounded(point));
  }
  const Vec3 middle = 0.5 * (low + high);
  const double size = high[u] - low[u] + high[v] - low[v];
  std::array<Vec3, 3> corners{Vec3(0.0), Vec3(0.0), Vec3(0.0)};
  const auto place = [&](Vec3& corner, double alongU, double alongV) {
    corner[u] = middle[u] + alongU * size;
    corner[v] = middle[v] + alongV * size;
  };
  place(corners[0], -4.0, -2.0);
  place(corners[1], 4.0, -2.0);
  place(corners[2], 0.0, 4.0);
  return corners;
}

}  // namespace

/// Triangles in one plane, with their cuts.
struct Arrangement::Group {
  std::span<const TriangleId> triangles;
  std::vector<CutSegment> cuts;
};

Task<bool> Arrangement::run(Work& work, std::size_t maxPairs) {
  work.beginPart(0.1);
  BoxTreeBuilder builder(triangleBoxes(mesh_));
  co_await work.finish(builder, kTreeBoxesPerUnit);
  const BoxTree tree = builder.take();
  work.beginPart(0.5);
  const std::vector<std::uint8_t> ignored(countTriangles(mesh_), 0);
  const std::vector<IntersectingPair> pairs =
      co_await findSelfIntersections(work, mesh_, ignored, tree, maxPairs);
  pairCount_ = pairs.size();
  isCut_.assign(countTriangles(mesh_), 0);
  if (pairs.size() >= maxPairs) co_return false;
  TriangleCuts found(mesh_, points_);
  work.beginPart(0.7);
  co_await work.forEachBlock(pairs.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) found.addPair(pairs[i].low, pairs[i].high);
  });
  const std::vector<TriangleCuts::Cut> cuts = found.takeCuts();
  const std::vector<std::vector<TriangleId>> groups = found.takeGroups(cuts);
  for (const std::vector<TriangleId>& group : groups) {
    for (const TriangleId triangle : group) isCut_[triangle.index()] = 1;
  }
  addUncut();
  work.beginPart(1.0);
  co_await work.forEachBlock(groups.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !points_.isFull(); ++i) {
      Group group{groups[i], {}};
      for (const TriangleId triangle : groups[i]) {
        const auto range =
            std::ranges::equal_range(cuts, triangle, {}, &TriangleCuts::Cut::triangle);
        for (const TriangleCuts::Cut& cut : range) group.cuts.push_back(cut.segment);
      }
      divideGroup(group);
    }
  });
  co_return !points_.isFull();
}

void Arrangement::addPart(const std::array<CutPointId, 3>& points) {
  for (const CutPointId point : points) parts_.push_back(point.value);
  begins_.push_back(static_cast<std::uint32_t>(owners_.size()));
}

void Arrangement::addUncut() {
  for (std::uint32_t t = 0; t < countTriangles(mesh_); ++t) {
    if (isCut_[t] != 0) continue;
    const auto [a, b, c] = nodesOf(mesh_, TriangleId(t));
    owners_.push_back({TriangleId(t), false});
    addPart({pointAt(a), pointAt(b), pointAt(c)});
  }
}

void Arrangement::divideGroup(const Group& group) {
  const NodeTriple first = nodesOf(mesh_, group.triangles[0]);
  const CutView view = viewOf(mesh_, first);
  const std::uint32_t hiddenAxis = 3 - view.u - view.v;
  CutGraph graph(points_, {first}, view);
  for (const CutSegment& cut : group.cuts) graph.add(cut);
  for (const TriangleId triangle : group.triangles) {
    const NodeTriple nodes = nodesOf(mesh_, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(nodes[k], nodes[(k + 1) % 3]);
      graph.add({pointAt(low), pointAt(high), {{low, high, NodeId()}, hiddenAxis}});
    }
  }
  graph.divide();
  if (points_.isFull()) return;

  const bool isSingle = group.triangles.size() == 1;
  std::array<CutPointId, 3> outer{pointAt(first[0]), pointAt(first[1]), pointAt(first[2])};
  if (!isSingle) {
    const std::array<Vec3, 3> around = triangleAround(points_, graph.vertices(), view);
    for (std::size_t k = 0; k < 3; ++k) outer[k] = points_.addHelper(around[k]);
  }
  PlanarTriangulation triangulation(points_, view, outer);
  const std::span<const CutPointId> vertices = graph.vertices();
  std::vector<PlanarTriangulation::Vertex> vertexOf(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto known = std::ranges::find(outer, vertices[i]);
    vertexOf[i] = known != outer.end() ? static_cast<std::uint32_t>(known - outer.begin())
                                       : triangulation.insert(vertices[i]);
  }
  const auto vertexAt = [&](CutPointId point) {
    return vertexOf[static_cast<std::size_t>(std::ranges::lower_bound(vertices, point) -
                                             vertices.begin())];
  };
  for (const auto& [from, to] : graph.edges()) {
    triangulation.constrain(vertexAt(from), vertexAt(to));
  }
  triangulation.improve();

  struct Member {
    TriangleId triangle;
    std::array<CutPointId, 3> corners;  ///< counter-clockwise in the view
    bool isReversed;
  };
  std::vector<Member> members;
  for (const TriangleId triangle : group.triangles) {
    const auto [a, b, c] = nodesOf(mesh_, triangle);
    Member member{triangle, {pointAt(a), pointAt(b), pointAt(c)}, false};
    member.isReversed =
        points_.orient(view, member.corners[0], member.corners[1], member.corners[2]) < 0;
    if (member.isReversed) std::swap(member.corners[1], member.corners[2]);
    members.push_back(member);
  }
  const auto isInside = [&](const Member& member, const std::array<CutPointId, 3>& part) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const CutPointId point : part) {
        if (points_.orient(view, member.corners[k], member.corners[(k + 1) % 3], point) < 0)
          return false;
      }
    }
    return true;
  };
  for (std::size_t t = 0; t < triangulation.triangleCount(); ++t) {
    const auto [a, b, c] = triangulation.cornersOf(t);
    std::array<CutPointId, 3> part{triangulation.pointOf(a), triangulation.pointOf(b),
                                   triangulation.pointOf(c)};
    const std::size_t before = owners_.size();
    for (const Member& member : members) {
      if (isSingle || isInside(member, part))
        owners_.push_back({member.triangle, member.isReversed});
    }
    if (owners_.size() == before) continue;
    // The part has the orientation of its first owner.
    if (owners_[before].isReversed) {
      std::swap(part[1], part[2]);
      for (std::size_t i = before; i < owners_.size(); ++i)
        owners_[i].isReversed = !owners_[i].isReversed;
    }
    addPart(part);
  }
}

}  // namespace tetrafront
