#include "arrangement/arrangement.h"

#include <algorithm>
#include <utility>

#include "arrangement/cut_graph.h"
#include "arrangement/planar_triangulation.h"
#include "arrangement/triangle_cuts.h"
#include "base/sort.h"
#include "boundary/self_intersection.h"
#include "search/box_tree.h"
#include "topology/mesh_access.h"

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

/// One triangle, or several that overlap in their plane, divided along their cuts.
class DividedGroup {
 public:
  using Part = std::array<CutPointId, 3>;

  DividedGroup(const SurfaceMesh& mesh, CutPoints& points, std::span<const TriangleId> triangles)
      : points_(points),
        plane_(nodesOf(mesh, triangles[0])),
        view_(viewOf(mesh, plane_)),
        graph_(points, {plane_}, view_) {
    for (const TriangleId triangle : triangles) members_.push_back(memberOf(mesh, triangle));
    if (members_.size() == 1) return;
    std::vector<Box> boxes;
    for (const Member& member : members_) boxes.push_back(boxOf(member.corners));
    tree_ = BoxTree(boxes);
  }

  void addCut(const CutSegment& cut) { graph_.add(cut); }

  /// Divides the group, and calls visit(part, owners) for each part. The part has the orientation of the first owner.
  template <class Visit>
  void divide(Visit visit) {
    addEdges();
    graph_.divide();
    if (points_.isFull()) return;
    const PlanarTriangulation triangulation = triangulate();
    std::vector<PartOwner> owners;
    for (std::size_t t = 0; t < triangulation.triangleCount(); ++t) {
      const auto [a, b, c] = triangulation.cornersOf(t);
      Part part{triangulation.pointOf(a), triangulation.pointOf(b), triangulation.pointOf(c)};
      findOwners(part, owners);
      if (owners.empty()) continue;
      if (owners[0].isReversed) {
        std::swap(part[1], part[2]);
        for (PartOwner& owner : owners) owner.isReversed = !owner.isReversed;
      }
      visit(part, owners);
    }
  }

 private:
  /// A triangle of the group.
  struct Member {
    TriangleId triangle;
    Part corners;  ///< counter-clockwise in the view
    bool isReversed = false;
  };

  [[nodiscard]] Member memberOf(const SurfaceMesh& mesh, TriangleId triangle) const {
    const auto [a, b, c] = nodesOf(mesh, triangle);
    Member member{triangle, {pointAt(a), pointAt(b), pointAt(c)}, false};
    member.isReversed =
        points_.orient(view_, member.corners[0], member.corners[1], member.corners[2]) < 0;
    if (member.isReversed) std::swap(member.corners[1], member.corners[2]);
    return member;
  }

  [[nodiscard]] Box boxOf(const Part& part) const {
    return Box::of(points_.rounded(part[0]), points_.rounded(part[1]), points_.rounded(part[2]));
  }

  void addEdges() {
    const std::uint32_t hiddenAxis = 3 - view_.u - view_.v;
    for (const Member& member : members_) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(member.corners[k], member.corners[(k + 1) % 3]);
        const std::array<NodeId, 3> nodes{NodeId(low.value), NodeId(high.value), NodeId()};
        graph_.add({low, high, {nodes, hiddenAxis}});
      }
    }
  }

  [[nodiscard]] PlanarTriangulation triangulate() {
    const std::span<const CutPointId> vertices = graph_.vertices();
    Part outer = members_[0].corners;
    if (members_.size() > 1) {
      const std::array<Vec3, 3> around = triangleAround(points_, vertices, view_);
      for (std::size_t k = 0; k < 3; ++k) outer[k] = points_.addHelper(around[k]);
    }
    PlanarTriangulation triangulation(points_, view_, outer);
    std::vector<PlanarTriangulation::Vertex> vertexOf(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto known = std::ranges::find(outer, vertices[i]);
      vertexOf[i] = known != outer.end() ? static_cast<std::uint32_t>(known - outer.begin())
                                         : triangulation.insert(vertices[i]);
    }
    const auto vertexAt = [&](CutPointId point) {
      const auto found = std::ranges::lower_bound(vertices, point);
      return vertexOf[static_cast<std::size_t>(found - vertices.begin())];
    };
    for (const auto& [from, to] : graph_.edges()) {
      triangulation.constrain(vertexAt(from), vertexAt(to));
    }
    triangulation.improve();
    return triangulation;
  }

  void findOwners(const Part& part, std::vector<PartOwner>& owners) const {
    owners.clear();
    if (members_.size() == 1) {
      owners.push_back({members_[0].triangle, members_[0].isReversed});
      return;
    }
    tree_.visitOverlaps(boxOf(part), [&](std::uint32_t m) {
      if (isInside(members_[m], part))
        owners.push_back({members_[m].triangle, members_[m].isReversed});
    });
    sortFew(owners, [](const PartOwner& a, const PartOwner& b) { return a.triangle < b.triangle; });
  }

  [[nodiscard]] bool isInside(const Member& member, const Part& part) const {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const CutPointId point : part) {
        const int side =
            points_.orient(view_, member.corners[k], member.corners[(k + 1) % 3], point);
        if (side < 0) return false;
      }
    }
    return true;
  }

  CutPoints& points_;
  NodeTriple plane_;
  CutView view_;
  CutGraph graph_;
  std::vector<Member> members_;
  BoxTree tree_;  ///< of the members, if there are several
};

}  // namespace

Task<bool> Arrangement::run(Work& work, std::size_t maxPairs) {
  work.beginPart(0.1);
  const BoxTree tree = co_await BoxTree::build(work, triangleBoxes(mesh_), kTreeBoxesPerUnit);
  work.beginPart(0.5);
  const std::vector<std::uint8_t> ignored(countTriangles(mesh_), 0);
  const std::vector<IntersectingPair> pairs =
      co_await findSelfIntersections(work, mesh_, ignored, tree, maxPairs);
  pairCount_ = pairs.size();
  if (!pairs.empty()) firstOfPair_ = pairs[0].low;
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
      DividedGroup group(mesh_, points_, groups[i]);
      for (const TriangleId triangle : groups[i]) {
        const auto range =
            std::ranges::equal_range(cuts, triangle, {}, &TriangleCuts::Cut::triangle);
        for (const TriangleCuts::Cut& cut : range) group.addCut(cut.segment);
      }
      group.divide([this](const DividedGroup::Part& part, std::span<const PartOwner> owners) {
        owners_.insert(owners_.end(), owners.begin(), owners.end());
        addPart(part);
      });
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

}  // namespace tetrafront
