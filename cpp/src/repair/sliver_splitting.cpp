#include "repair/sliver_splitting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "topology/edge_table.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

using Edge = std::pair<NodeId, NodeId>;

/// Returns the corner of a sliver that lies between the other two; nothing if two have equal positions. Along each
/// axis, collinear positions are either all equal or in their order on the line.
std::optional<std::uint32_t> middleCorner(const SurfaceMesh& mesh, TriangleId sliver) {
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

/// Every split removes one sliver, because the halves of a triangle with area have area. So the work ends.
class SliverSplitter {
 public:
  explicit SliverSplitter(SurfaceMesh& mesh) : mesh_(mesh) {
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
      if (isSliver(mesh, TriangleId(t))) waiting_.emplace_back(t);
    }
    for (const TriangleId sliver : waiting_) {
      for (const HalfEdgeId h : halfEdgesOf(sliver)) edges_.push_back(edgeOf(h));
    }
    sortUnique(edges_);
    halfEdges_.resize(edges_.size());
    if (edges_.empty()) return;
    for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
      if (HalfEdges* known = halfEdgesAt(edgeOf(HalfEdgeId(h)))) known->emplace_back(h);
    }
    // `waiting_` is a stack: process the first sliver first.
    std::ranges::reverse(waiting_);
  }

  std::vector<SliverSplit> run() {
    while (!waiting_.empty()) {
      const TriangleId triangle = waiting_.back();
      waiting_.pop_back();
      if (isSliver(mesh_, triangle)) splitBeside(triangle);
    }
    return std::move(splits_);
  }

 private:
  using HalfEdges = std::vector<HalfEdgeId>;

  static std::array<HalfEdgeId, 3> halfEdgesOf(TriangleId triangle) {
    return {halfEdgeOf(triangle, 0), halfEdgeOf(triangle, 1), halfEdgeOf(triangle, 2)};
  }

  [[nodiscard]] Edge edgeOf(HalfEdgeId halfEdge) const {
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, halfEdge);
    return std::minmax(nodes.from, nodes.to);
  }

  /// Returns the half-edges on an edge that a sliver had at the start; null for other edges.
  HalfEdges* halfEdgesAt(const Edge& edge) {
    const auto found = std::ranges::lower_bound(edges_, edge);
    if (found == edges_.end() || *found != edge) return nullptr;
    return &halfEdges_[static_cast<std::size_t>(found - edges_.begin())];
  }

  void splitBeside(TriangleId sliver) {
    const std::optional<std::uint32_t> middle = middleCorner(mesh_, sliver);
    if (!middle) return;
    const HalfEdgeId longest = halfEdgeOf(sliver, (*middle + 1) % 3);
    const HalfEdges& onEdge = *halfEdgesAt(edgeOf(longest));
    if (onEdge.size() != 2) return;
    const HalfEdgeId across = onEdge[0] == longest ? onEdge[1] : onEdge[0];
    if (!isSliver(mesh_, triangleOf(across))) split(halfEdgeOf(sliver, *middle), across);
  }

  /// `across`: half-edge a c of the other triangle a c d, on which the sliver's middle corner m lies. The other
  /// triangle becomes a m d, the sliver m c d.
  void split(HalfEdgeId middleCorner, HalfEdgeId across) {
    const TriangleId sliver = triangleOf(middleCorner);
    const TriangleId other = triangleOf(across);
    const std::uint32_t middle = mesh_.triangles[middleCorner.index()];
    const HalfEdgeNodes nodes = nodesOf(mesh_.triangles, across);
    unlink(sliver);
    unlink(other);
    mesh_.triangles[nextOf(across).index()] = middle;
    const std::array half{middle, nodes.to.value, nodes.apex.value};
    std::ranges::copy(half, &mesh_.triangles[3 * sliver.index()]);
    link(sliver);
    link(other);
    splits_.push_back({sliver, other, NodeId(middle)});
    pushNeighbours(across);
    pushNeighbours(halfEdgeOf(sliver, 0));
  }

  void unlink(TriangleId triangle) {
    for (const HalfEdgeId h : halfEdgesOf(triangle)) {
      if (HalfEdges* onEdge = halfEdgesAt(edgeOf(h))) std::erase(*onEdge, h);
    }
  }

  void link(TriangleId triangle) {
    for (const HalfEdgeId h : halfEdgesOf(triangle)) {
      if (HalfEdges* onEdge = halfEdgesAt(edgeOf(h))) onEdge->push_back(h);
    }
  }

  /// Slivers at the half-edge may be split now, because no other sliver shares their edge any more.
  void pushNeighbours(HalfEdgeId halfEdge) {
    for (const HalfEdgeId h : *halfEdgesAt(edgeOf(halfEdge))) {
      if (h != halfEdge) waiting_.push_back(triangleOf(h));
    }
  }

  SurfaceMesh& mesh_;
  std::vector<Edge> edges_;  ///< of the slivers at the start, ascending
  std::vector<HalfEdges> halfEdges_;
  std::vector<TriangleId> waiting_;  ///< a stack
  std::vector<SliverSplit> splits_;
};

}  // namespace

bool isSliver(const SurfaceMesh& mesh, TriangleId triangle) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  return collinear(p[0], p[1], p[2]);
}

std::vector<SliverSplit> splitBesideSlivers(SurfaceMesh& mesh) {
  return SliverSplitter(mesh).run();
}

}  // namespace tetrafront
