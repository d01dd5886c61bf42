#include "repair/sliver_splitting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "boundary/edge_table.h"
#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The corner of a sliver that lies between the others, none where two are at one place. On every axis
/// places on a line either agree or follow each other as on the line.
std::optional<std::uint32_t> middleCorner(const SurfaceMesh& mesh, std::uint32_t sliver) {
  const std::array<Vec3, 3> p = cornersOf(mesh, sliver);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3& a = p[(k + 1) % 3];
    const Vec3& b = p[(k + 2) % 3];
    for (int axis = 0; axis < 3; ++axis) {
      if (std::min(a[axis], b[axis]) < p[k][axis] && p[k][axis] < std::max(a[axis], b[axis])) {
        return k;
      }
    }
  }
  return std::nullopt;
}

/// Every split leaves one sliver less, for the halves of a triangle with area have area.
class SliverSplitter {
 public:
  explicit SliverSplitter(SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t t = 0; t < mesh.triangles.size() / 3; ++t) {
      if (isSliver(mesh, t)) waiting_.push_back(t);
    }
    for (const std::uint32_t sliver : waiting_) {
      for (std::uint32_t k = 0; k < 3; ++k) edges_.push_back(edgeOf(3 * sliver + k));
    }
    sortUnique(edges_);
    halfEdges_.resize(edges_.size());
    if (edges_.empty()) return;
    for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
      if (HalfEdges* known = halfEdgesAt(edgeOf(h))) known->push_back(h);
    }
    // The last is looked at first.
    std::ranges::reverse(waiting_);
  }

  std::vector<SliverSplit> run() {
    while (!waiting_.empty()) {
      const std::uint32_t sliver = waiting_.back();
      waiting_.pop_back();
      consider(sliver);
    }
    return std::move(splits_);
  }

 private:
  using HalfEdges = std::vector<std::uint32_t>;

  [[nodiscard]] Edge edgeOf(std::uint32_t halfEdge) const {
    return std::minmax(mesh_.triangles[halfEdge], mesh_.triangles[nextCorner(halfEdge)]);
  }

  /// The half-edges on an edge that slivers have; null for all others.
  HalfEdges* halfEdgesAt(const Edge& edge) {
    const auto at = std::ranges::lower_bound(edges_, edge);
    if (at == edges_.end() || *at != edge) return nullptr;
    return &halfEdges_[static_cast<std::size_t>(at - edges_.begin())];
  }

  void consider(std::uint32_t triangle) {
    if (!isSliver(mesh_, triangle)) return;
    const std::optional<std::uint32_t> middle = middleCorner(mesh_, triangle);
    if (!middle) return;
    const std::uint32_t longest = 3 * triangle + (*middle + 1) % 3;
    const HalfEdges& on = *halfEdgesAt(edgeOf(longest));
    if (on.size() != 2) return;
    const std::uint32_t across = on[0] == longest ? on[1] : on[0];
    if (!isSliver(mesh_, across / 3)) split(triangle, *middle, across);
  }

  /// The other triangle is a c d, its half-edge a c that of the sliver's longest edge, on which the
  /// middle node m lies: it becomes a m d, the sliver m c d.
  void split(std::uint32_t sliver, std::uint32_t corner, std::uint32_t across) {
    const std::uint32_t middle = mesh_.triangles[3 * sliver + corner];
    const std::uint32_t other = across / 3;
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, across);
    unlink(sliver);
    unlink(other);
    mesh_.triangles[nextCorner(across)] = middle;
    const std::array<std::uint32_t, 3> half{middle, nodes.to, nodes.apex};
    std::ranges::copy(half, &mesh_.triangles[3 * std::size_t{sliver}]);
    link(sliver);
    link(other);
    splits_.push_back({sliver, other, middle});
    wakeBeside(across);
    wakeBeside(3 * sliver);
  }

  void unlink(std::uint32_t triangle) {
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      if (HalfEdges* on = halfEdgesAt(edgeOf(h))) std::erase(*on, h);
    }
  }

  void link(std::uint32_t triangle) {
    for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
      if (HalfEdges* on = halfEdgesAt(edgeOf(h))) on->push_back(h);
    }
  }

  /// Slivers on a half-edge's edge, which is no longer another sliver's, may be next.
  void wakeBeside(std::uint32_t halfEdge) {
    for (const std::uint32_t h : *halfEdgesAt(edgeOf(halfEdge))) {
      if (h != halfEdge) waiting_.push_back(h / 3);
    }
  }

  SurfaceMesh& mesh_;
  std::vector<Edge> edges_;  ///< of all slivers there were, ascending
  std::vector<HalfEdges> halfEdges_;
  std::vector<std::uint32_t> waiting_;
  std::vector<SliverSplit> splits_;
};

}  // namespace

bool isSliver(const SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  return collinear(p[0], p[1], p[2]);
}

std::vector<SliverSplit> splitBesideSlivers(SurfaceMesh& mesh) {
  return SliverSplitter(mesh).run();
}

}  // namespace tetrafront
