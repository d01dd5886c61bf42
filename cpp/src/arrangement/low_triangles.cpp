#include "arrangement/low_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "topology/edge_table.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Largest number of passes. A pass changes each triangle at most once; a long edge with n nodes beside it takes about
/// log2(n) of them.
constexpr int kMaxPasses = 16;

/// The longest edge of a triangle, and the height of the opposite corner above it.
struct LongestEdge {
  HalfEdgeId halfEdge;
  double height = 0.0;
};

class LowTriangleRemover {
 public:
  LowTriangleRemover(SurfaceMesh& mesh, double height, std::span<const std::uint8_t> mayChange)
      : mesh_(mesh), height_(height), mayChange_(mayChange) {
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) result_.parents.emplace_back(t);
  }

  /// Takes one slice per pass.
  Task<LowTriangles> run(Work& work) {
    for (int pass = 0; pass < kMaxPasses && removeSome(); ++pass) {
      co_await work.spend(work.remaining());
    }
    co_return std::move(result_);
  }

 private:
  /// Removes low triangles that have no edge in common with another one that is changed. Returns whether there were any.
  bool removeSome() {
    const std::size_t count = countTriangles(mesh_);
    std::vector<LongestEdge> low;
    for (const TriangleId t : IdRange<TriangleId>(count)) {
      const std::optional<LongestEdge> edge = longestEdgeOfLow(t);
      if (edge) low.push_back(*edge);
    }
    if (low.empty()) return false;
    isAny_ = false;
    highest_ = 0.0;
    const EdgeTable edges(mesh_.triangles, countNodes(mesh_), {});
    std::vector<EdgeId> edgeOf(mesh_.triangles.size());
    for (const EdgeId e : IdRange<EdgeId>(edges.edgeCount())) {
      for (const HalfEdgeId h : edges.halfEdgesOf(e)) edgeOf[h.index()] = e;
    }
    isChanged_.assign(count, 0);
    splitAt_.assign(count, HalfEdgeId{});
    middle_.assign(count, NodeId{});
    for (const LongestEdge& edge : low) {
      remove(edge, edges.halfEdgesOf(edgeOf[edge.halfEdge.index()]));
    }
    if (isAny_) apply();
    result_.deviation += highest_;
    return isAny_;
  }

  [[nodiscard]] std::optional<LongestEdge> longestEdgeOfLow(TriangleId triangle) const {
    const NodeTriple nodes = nodesOf(mesh_, triangle);
    for (const NodeId node : nodes) {
      if (mayChange_[node.index()] == 0) return {};
    }
    std::uint32_t longest = 0;
    const double height = heightOf(nodes, longest);
    if (!(height <= height_)) return {};
    return LongestEdge{halfEdgeOf(triangle, longest), height};
  }

  /// Returns the height above the longest edge, and the number of this edge.
  [[nodiscard]] double heightOf(const NodeTriple& nodes, std::uint32_t& longest) const {
    double length = -1.0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double edge =
          glm::length(pointOf(mesh_, nodes[(k + 1) % 3]) - pointOf(mesh_, nodes[k]));
      if (edge <= length) continue;
      length = edge;
      longest = k;
    }
    const Vec3 from = pointOf(mesh_, nodes[0]);
    const Vec3 normal =
        glm::cross(pointOf(mesh_, nodes[1]) - from, pointOf(mesh_, nodes[2]) - from);
    return glm::length(normal) / length;
  }

  /// Returns whether both halves of a triangle are higher than `height`, or it has the middle corner. Every pass then removes lower
  /// triangles than it makes, so that the passes do not undo each other.
  [[nodiscard]] bool areHalvesHigher(HalfEdgeId halfEdge, NodeId middle, double height) const {
    const auto [from, to, apex] = nodesOf(mesh_.triangles, halfEdge);
    if (apex == middle) return true;
    std::uint32_t longest = 0;
    return heightOf({from, middle, apex}, longest) > height &&
           heightOf({middle, to, apex}, longest) > height;
  }

  /// `around`: the half-edges on the longest edge.
  void remove(const LongestEdge& edge, std::span<const HalfEdgeId> around) {
    const NodeId middle = nodesOf(mesh_.triangles, edge.halfEdge).apex;
    const bool isAdmitted = std::ranges::all_of(around, [&](HalfEdgeId h) {
      return isChanged_[triangleOf(h).index()] == 0 && areHalvesHigher(h, middle, edge.height);
    });
    if (!isAdmitted) return;
    isAny_ = true;
    for (const HalfEdgeId h : around) {
      const std::size_t t = triangleOf(h).index();
      isChanged_[t] = 1;
      // Others with the same nodes disappear with it.
      if (nodesOf(mesh_.triangles, h).apex == middle) continue;
      splitAt_[t] = h;
      middle_[t] = middle;
    }
    highest_ = std::max(highest_, edge.height);
  }

  /// Replaces the changed triangles.
  void apply() {
    std::vector<std::uint32_t> triangles;
    std::vector<TriangleId> parents;
    const auto add = [&](NodeId a, NodeId b, NodeId c, std::size_t t) {
      triangles.insert(triangles.end(), {a.value, b.value, c.value});
      parents.push_back(result_.parents[t]);
    };
    for (std::size_t t = 0; t < isChanged_.size(); ++t) {
      if (isChanged_[t] == 0) {
        const auto [a, b, c] = nodesOf(mesh_, TriangleId(t));
        add(a, b, c, t);
      } else if (!splitAt_[t].isNone()) {
        const auto [from, to, apex] = nodesOf(mesh_.triangles, splitAt_[t]);
        add(from, middle_[t], apex, t);
        add(middle_[t], to, apex, t);
      }
    }
    mesh_.triangles = std::move(triangles);
    result_.parents = std::move(parents);
  }

  SurfaceMesh& mesh_;
  double height_;
  std::span<const std::uint8_t> mayChange_;
  LowTriangles result_;
  bool isAny_ = false;    ///< whether a pass has removed any
  double highest_ = 0.0;  ///< largest height of a triangle that a pass has removed
  // Per triangle, in one pass.
  std::vector<std::uint8_t> isChanged_;
  std::vector<HalfEdgeId> splitAt_;  ///< the edge at which it is split, or none if it is removed
  std::vector<NodeId> middle_;
};

}  // namespace

Task<LowTriangles> removeLowTriangles(Work& work, SurfaceMesh& mesh, double height,
                                      std::span<const std::uint8_t> mayChange) {
  LowTriangleRemover remover(mesh, height, mayChange);
  LowTriangles left = co_await remover.run(work);
  co_return left;
}

}  // namespace tetrafront
