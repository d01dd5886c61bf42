#pragma once

/// @file The edges of a surface, each with all its triangles, however many there are.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"

namespace tetrafront {

/// Half-edge 3t + k runs from corner k of triangle t to the next corner. The same id addresses that corner.
using HalfEdgeId = Id<struct HalfEdgeTag>;

constexpr HalfEdgeId halfEdgeOf(TriangleId triangle, std::uint32_t corner) {
  return HalfEdgeId(3 * triangle.value + corner);
}

constexpr TriangleId triangleOf(HalfEdgeId halfEdge) { return TriangleId(halfEdge.value / 3); }

/// Returns the next half-edge of the same triangle.
constexpr HalfEdgeId nextOf(HalfEdgeId halfEdge) {
  return HalfEdgeId(halfEdge.value % 3 == 2 ? halfEdge.value - 2 : halfEdge.value + 1);
}

struct HalfEdgeNodes {
  NodeId from;
  NodeId to;
  NodeId apex;  ///< third node of the triangle
};

inline HalfEdgeNodes nodesOf(std::span<const std::uint32_t> triangles, HalfEdgeId halfEdge) {
  const HalfEdgeId next = nextOf(halfEdge);
  return {NodeId(triangles[halfEdge.index()]), NodeId(triangles[next.index()]),
          NodeId(triangles[nextOf(next).index()])};
}

class EdgeTable {
 public:
  /// Ignores the triangles whose flag in `ignored` is set; an empty `ignored` ignores none. O(triangles).
  EdgeTable(std::span<const std::uint32_t> triangles, std::size_t nodeCount,
            std::span<const std::uint8_t> ignored);

  /// Makes this the table of the same triangles with some flipped (flipTriangle()). `isFlipped`: one flag per triangle.
  void followFlips(std::span<const std::uint8_t> isFlipped);

  /// Edges ascend by their lower node, then by their higher node.
  [[nodiscard]] std::size_t edgeCount() const { return begins_.size() - 1; }

  /// Returns the half-edges on one edge, in ascending order.
  [[nodiscard]] std::span<const HalfEdgeId> halfEdgesOf(EdgeId edge) const {
    const std::uint32_t begin = begins_[edge.index()];
    return std::span(halfEdges_).subspan(begin, begins_[edge.index() + 1] - begin);
  }

 private:
  std::vector<HalfEdgeId> halfEdges_;
  std::vector<std::uint32_t> begins_;  ///< per edge and one more: index in halfEdges_
};

}  // namespace tetrafront
