#include "repair/hole_filling.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "base/sort.h"
#include "boundary/self_intersection.h"
#include "geom/intersect.h"
#include "repair/open_rims.h"
#include "repair/rim_triangulation.h"
#include "repair/sliver_splitting.h"
#include "search/box_tree.h"
#include "topology/edge_table.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

using Edge = std::pair<NodeId, NodeId>;
using Corners = RimTriangulation::Corners;

/// Each attempt excludes at least one triangle of the best remaining triangulation. Of ten scans and patches with
/// rims of 10 to 136 edges, seven were closed within 20 attempts, and all within 300.
constexpr std::uint32_t kMaxAttempts = 300;

Edge edgeBetween(NodeId a, NodeId b) { return std::minmax(a, b); }

double doubledArea(const NumberedTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return glm::length(glm::cross(b - a, c - a));
}

/// The triangles of the given surface that new triangles must not intersect: all except slivers.
class Obstacles {
 public:
  explicit Obstacles(const SurfaceMesh& mesh) : mesh_(mesh), tree_(triangleBoxes(mesh)) {}

  [[nodiscard]] bool intersect(const NumberedTriangle& triangle) const {
    bool isFound = false;
    const auto& [a, b, c] = triangle.corners;
    tree_.visitOverlaps(Box::of(a, b, c), [&](std::uint32_t item) {
      if (isFound || isSliver(mesh_, TriangleId(item))) return;
      isFound = intersectImproperly(triangle, numberedTriangle(mesh_, TriangleId(item)));
    });
    return isFound;
  }

 private:
  const SurfaceMesh& mesh_;
  BoxTree tree_;
};

/// The edges of a growing mesh.
class EdgeSet {
 public:
  explicit EdgeSet(const SurfaceMesh& mesh) {
    given_.reserve(mesh.triangles.size());
    for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
      const HalfEdgeNodes nodes = nodesOf(mesh.triangles, HalfEdgeId(h));
      given_.push_back(edgeBetween(nodes.from, nodes.to));
    }
    stableSort(given_);
  }

  [[nodiscard]] bool contains(NodeId a, NodeId b) const {
    const Edge edge = edgeBetween(a, b);
    return std::ranges::binary_search(given_, edge) || added_.contains(edge);
  }

  void add(NodeId a, NodeId b) {
    if (!contains(a, b)) added_.insert(edgeBetween(a, b));
  }

 private:
  std::vector<Edge> given_;  ///< sorted
  std::set<Edge> added_;
};

std::vector<Rim> rimsToFill(const SurfaceMesh& mesh, std::uint32_t maxEdges) {
  const EdgeTable edges(mesh.triangles, countNodes(mesh), {});
  std::vector<Rim> rims = openRims(mesh, edges);
  std::erase_if(rims, [=](const Rim& rim) { return rim.size() < 3 || rim.size() > maxEdges; });
  return rims;
}

class HoleFiller {
 public:
  HoleFiller(SurfaceMesh& mesh, std::uint32_t maxEdges)
      : mesh_(mesh), edges_(mesh), rims_(rimsToFill(mesh, maxEdges)) {
    if (!rims_.empty()) obstacles_.emplace(mesh);
  }

  Task<> run(Work& work) {
    for (std::size_t i = 0; i < rims_.size(); ++i) {
      RimTriangulation triangulation(mesh_, rims_[i]);
      bool isSettled = false;
      for (std::uint32_t attempt = 0; attempt < kMaxAttempts && !isSettled; ++attempt) {
        isSettled = tryToFill(triangulation);
        co_await work.spend(rims_[i].size());
      }
      work.setFraction(static_cast<double>(i + 1) / static_cast<double>(rims_.size()));
    }
  }

  [[nodiscard]] std::vector<FilledHole> takeFilled() { return std::move(filled_); }

 private:
  /// Fills the hole, or excludes the triangles of the best triangulation that intersect others. Returns whether the
  /// hole needs no further attempt.
  bool tryToFill(RimTriangulation& triangulation) {
    const std::vector<Corners> triangles =
        triangulation.solve([this](NodeId a, NodeId b) { return edges_.contains(a, b); });
    if (excludeIntersecting(triangulation, triangles)) return false;
    if (!triangles.empty()) append(triangulation, triangles);
    return true;
  }

  /// Excludes triangles that intersect the given surface; if there are none, the larger of two that intersect each
  /// other. Returns whether it excluded any.
  [[nodiscard]] bool excludeIntersecting(RimTriangulation& triangulation,
                                         const std::vector<Corners>& triangles) const {
    bool isAnyExcluded = false;
    for (const Corners& corners : triangles) {
      if (!obstacles_->intersect(triangulation.triangleOf(corners))) continue;
      triangulation.exclude(corners);
      isAnyExcluded = true;
    }
    for (std::size_t i = 1; i < triangles.size() && !isAnyExcluded; ++i) {
      const NumberedTriangle a = triangulation.triangleOf(triangles[i]);
      for (std::size_t j = 0; j < i; ++j) {
        const NumberedTriangle b = triangulation.triangleOf(triangles[j]);
        if (!intersectImproperly(a, b)) continue;
        triangulation.exclude(doubledArea(a) < doubledArea(b) ? triangles[j] : triangles[i]);
        isAnyExcluded = true;
      }
    }
    return isAnyExcluded;
  }

  void append(const RimTriangulation& triangulation, const std::vector<Corners>& triangles) {
    filled_.push_back(
        {TriangleId(countTriangles(mesh_)), static_cast<std::uint32_t>(triangles.size())});
    for (const Corners& corners : triangles) {
      const auto [a, b, c] = triangulation.triangleOf(corners).nodes;
      mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
      edges_.add(NodeId(a), NodeId(b));
      edges_.add(NodeId(b), NodeId(c));
      edges_.add(NodeId(c), NodeId(a));
    }
  }

  SurfaceMesh& mesh_;
  EdgeSet edges_;
  std::vector<Rim> rims_;
  std::optional<Obstacles> obstacles_;  ///< if there are rims
  std::vector<FilledHole> filled_;
};

}  // namespace

Task<std::vector<FilledHole>> fillHoles(Work& work, SurfaceMesh& mesh, std::uint32_t maxEdges) {
  HoleFiller filler(mesh, maxEdges);
  co_await work.yield();
  co_await filler.run(work);
  co_return filler.takeFilled();
}

}  // namespace tetrafront
