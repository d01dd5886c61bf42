#include "boundary/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/budget.h"
#include "base/diagnostics.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "boundary/triangle_pairs.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "topology/node_lists.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// The search ends after this many self-intersections: some surfaces have as many as they have pairs of triangles.
constexpr std::size_t kMaxFound = 100'000;
/// Up to this many triangles at a node are tested in pairs without a tree.
constexpr std::size_t kMaxWithoutTree = 16;
/// Pairs of branches per unit of budget: separating one costs far less than testing a triangle.
constexpr std::size_t kBranchPairsPerUnit = 16;

/// Returns the lowest node of both triangles, or none.
NodeId lowestCommonNode(const NodeTriple& a, const NodeTriple& b) {
  NodeId lowest;
  for (const NodeId node : a) {
    if (std::ranges::count(b, node) > 0) lowest = std::min(lowest, node);
  }
  return lowest;
}

/// Returns a box around the directions in which the triangle lies as seen from its node: an arc of the unit sphere.
Box boxOfDirections(const NumberedTriangle& triangle, NodeId node) {
  std::size_t k = 0;
  while (triangle.nodes[k] != node.value) ++k;
  const Vec3& from = triangle.corners[k];
  const Vec3 a = triangle.corners[(k + 1) % 3] - from;
  const Vec3 b = triangle.corners[(k + 2) % 3] - from;
  const Vec3 u = a * (1.0 / glm::length(a));
  const Vec3 v = b * (1.0 / glm::length(b));
  // If the square of a length overflows or underflows, its direction is unknown. NaN fails the comparison too.
  if (!(std::fabs(glm::dot(u, u) - 1.0) < Tolerance::kRounding &&
        std::fabs(glm::dot(v, v) - 1.0) < Tolerance::kRounding)) {
    return Box::of(Vec3(-2.0), Vec3(2.0), Vec3(2.0));
  }
  // No arc is farther from its chord than a quarter of the squared chord.
  const Vec3 reach(0.25 * glm::dot(v - u, v - u) + Tolerance::kRounding);
  Box box = Box::of(u, v, v);
  box.include(u, reach);
  box.include(v, reach);
  return box;
}

class SelfIntersectionFinder {
 public:
  SelfIntersectionFinder(const SurfaceMesh& mesh, std::span<const std::uint8_t> ignored,
                         const BoxTree& tree, std::size_t maxPairs)
      : mesh_(mesh),
        ignored_(ignored),
        tree_(tree),
        maxPairs_(maxPairs),
        trianglesAt_(countNodes(mesh)) {}

  Task<> run(Work& work) {
    work.beginPart(0.25);
    co_await listTrianglesAtNodes(work);
    work.beginPart(0.5);
    co_await testPairsAtNodes(work);
    work.beginPart(1.0);
    co_await testPairsWithoutCommonNode(work);
    stableSort(found_);
  }

  [[nodiscard]] std::vector<IntersectingPair> take() { return std::move(found_); }

 private:
  /// The triangles at a node with many, by the directions in which they lie as seen from it.
  struct Directions {
    explicit Directions(std::vector<Box> seen) : boxes(std::move(seen)), tree(boxes) {}

    std::vector<Box> boxes;
    BoxTree tree;
    std::uint32_t next = 0;
  };

  [[nodiscard]] bool hasFoundEnough() const { return found_.size() >= maxPairs_; }

  Task<> listTrianglesAtNodes(Work& work) {
    work.beginPart(0.4);
    co_await work.forEachBlock(mesh_.triangles.size(), [this](std::size_t first, std::size_t last) {
      for (std::size_t h = first; h < last; ++h) {
        if (ignored_[h / 3] == 0) trianglesAt_.count(NodeId(mesh_.triangles[h]));
      }
    });
    trianglesAt_.endCounting();
    work.beginPart(1.0);
    co_await work.forEachBlock(mesh_.triangles.size(), [this](std::size_t first, std::size_t last) {
      for (std::size_t h = first; h < last; ++h) {
        if (ignored_[h / 3] != 0) continue;
        trianglesAt_.add(NodeId(mesh_.triangles[h]), TriangleId(h / 3));
      }
    });
  }

  Task<> testPairsAtNodes(Work& work) {
    while (!testNodes(work.remaining())) {
      work.setFraction(static_cast<double>(node_.value) / countNodes(mesh_));
      co_await work.yield();
    }
  }

  /// Tests the triangles at the next nodes; returns true when finished.
  bool testNodes(std::uint32_t budget) {
    while (budget > 0 && node_.value < countNodes(mesh_) && !hasFoundEnough()) {
      const bool isFew = trianglesAt_.at(node_).size() <= kMaxWithoutTree;
      const std::uint32_t tested = isFew ? testFewAtNode() : testManyAtNode(budget);
      budget -= std::min(tested, budget);
      if (!directions_) ++node_.value;
    }
    return node_.value == countNodes(mesh_) || hasFoundEnough();
  }

  /// Returns what the tests cost.
  std::uint32_t testFewAtNode() {
    const std::span<const TriangleId> triangles = trianglesAt_.at(node_);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t j = i + 1; j < triangles.size(); ++j) {
        testAtLowestNode(triangles[i], triangles[j]);
      }
    }
    return 1 + static_cast<std::uint32_t>(triangles.size());
  }

  /// Returns what the tests cost. Keeps `directions_` for the next slice if the budget does not suffice.
  std::uint32_t testManyAtNode(std::uint32_t budget) {
    const std::span<const TriangleId> triangles = trianglesAt_.at(node_);
    if (!directions_) {
      std::vector<Box> boxes;
      boxes.reserve(triangles.size());
      for (const TriangleId t : triangles) {
        boxes.push_back(boxOfDirections(numberedTriangle(mesh_, t), node_));
      }
      directions_.emplace(std::move(boxes));
    }
    const std::uint32_t first = directions_->next;
    const auto count = static_cast<std::uint32_t>(triangles.size());
    const std::uint32_t last = first + std::min(count - first, budget);
    for (std::uint32_t i = first; i < last && !hasFoundEnough(); ++i) {
      directions_->tree.visitOverlaps(directions_->boxes[i], [&](std::uint32_t j) {
        if (j > i) testAtLowestNode(triangles[i], triangles[j]);
      });
    }
    directions_->next = last;
    if (last == count) directions_.reset();
    return last - first;
  }

  /// Tests triangles with several common nodes once, although they are visited at each of these nodes.
  void testAtLowestNode(TriangleId a, TriangleId b) {
    if (lowestCommonNode(nodesOf(mesh_, a), nodesOf(mesh_, b)) == node_) test(a, b);
  }

  Task<> testPairsWithoutCommonNode(Work& work) {
    TrianglePairs pairs(mesh_, tree_);
    const auto visit = [this](TriangleId a, TriangleId b) {
      if (ignored_[a.index()] == 0 && ignored_[b.index()] == 0 && !hasFoundEnough()) test(a, b);
    };
    while (!pairs.advance(scaledBudget(work.remaining(), kBranchPairsPerUnit), visit) &&
           !hasFoundEnough()) {
      work.setFraction(pairs.fraction());
      co_await work.yield();
    }
  }

  void test(TriangleId a, TriangleId b) {
    if (intersectImproperly(numberedTriangle(mesh_, a), numberedTriangle(mesh_, b))) {
      found_.push_back({std::min(a, b), std::max(a, b)});
    }
  }

  const SurfaceMesh& mesh_;
  std::span<const std::uint8_t> ignored_;
  const BoxTree& tree_;
  std::size_t maxPairs_;
  NodeLists<TriangleId> trianglesAt_;
  NodeId node_{0U};  ///< the next node whose triangles are tested
  std::optional<Directions> directions_;
  std::vector<IntersectingPair> found_;
};

}  // namespace

std::vector<Box> triangleBoxes(const SurfaceMesh& mesh) {
  std::vector<Box> boxes;
  boxes.reserve(countTriangles(mesh));
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    const std::array<Vec3, 3> p = cornersOf(mesh, TriangleId(t));
    boxes.push_back(Box::of(p[0], p[1], p[2]));
  }
  return boxes;
}

Task<std::vector<IntersectingPair>> findSelfIntersections(Work& work, const SurfaceMesh& mesh,
                                                          std::span<const std::uint8_t> ignored,
                                                          const BoxTree& tree,
                                                          std::size_t maxPairs) {
  SelfIntersectionFinder finder(mesh, ignored, tree, maxPairs);
  co_await finder.run(work);
  co_return finder.take();
}

Task<> checkSelfIntersections(Work& work, const SurfaceMesh& mesh,
                              std::span<const std::uint8_t> ignored, const BoxTree& tree,
                              BoundaryReport& report) {
  const std::size_t limit = std::max(kMaxFound, report.maxDiagnostics());
  work.beginPart(0.95);
  const std::vector<IntersectingPair> found =
      co_await findSelfIntersections(work, mesh, ignored, tree, limit);
  if (found.size() >= limit) report.setLowerBound(DiagnosticCode::kSelfIntersection);
  work.beginPart(1.0);
  co_await work.forEachBlock(found.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto [low, high] = found[i];
      const Vec3 position = report.canKeep(DiagnosticCode::kSelfIntersection)
                                ? intersectionPosition(cornersOf(mesh, low), cornersOf(mesh, high))
                                : Vec3(0.0);
      report.addTrianglePair(diagnoseCounted<DiagnosticCode::kSelfIntersection>(), low, high,
                             position);
    }
  });
}

}  // namespace tetrafront
