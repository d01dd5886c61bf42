#pragma once

/// @file Which triangles meet at each edge of a surface, however many they are.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrafront {

/// Half-edge 3t + k runs from triangles[3t + k] to triangles[3t + (k + 1) % 3].
class EdgeTable {
 public:
  /// Triangles marked in `ignored` (one flag each, or empty) take no part. O(triangles).
  EdgeTable(std::span<const std::uint32_t> triangles, std::size_t nodeCount,
            std::span<const std::uint8_t> ignored);

  [[nodiscard]] std::size_t edgeCount() const { return begins_.size() - 1; }

  /// The half-edges on one edge, in ascending order. Edges ascend by their lower, then their
  /// higher node.
  [[nodiscard]] std::span<const std::uint32_t> halfEdgesOf(std::size_t edge) const {
    return std::span(halfEdges_).subspan(begins_[edge], begins_[edge + 1] - begins_[edge]);
  }

 private:
  std::vector<std::uint32_t> halfEdges_;
  std::vector<std::uint32_t> begins_;
};

/// The corner, or half-edge, after this one in its triangle.
inline std::uint32_t nextCorner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// The two nodes of a half-edge, in its direction, and the third node of its triangle.
struct HalfEdgeNodes {
  std::uint32_t from;
  std::uint32_t to;
  std::uint32_t apex;
};

inline HalfEdgeNodes nodesOf(std::span<const std::uint32_t> triangles, std::uint32_t halfEdge) {
  const std::uint32_t first = halfEdge - halfEdge % 3;
  const std::uint32_t k = halfEdge - first;
  return {triangles[halfEdge], triangles[first + (k + 1) % 3], triangles[first + (k + 2) % 3]};
}

}  // namespace tetrafront
