#include "topology/edge_table.h"

#include <algorithm>

#include "base/sort.h"

namespace tetrafront {

EdgeTable::EdgeTable(std::span<const std::uint32_t> triangles, std::size_t nodeCount,
                     std::span<const std::uint8_t> ignored) {
  struct Entry {
    NodeId higher;
    HalfEdgeId halfEdge;
  };
  const auto count = static_cast<std::uint32_t>(triangles.size());
  const auto isIgnored = [&](std::uint32_t h) { return !ignored.empty() && ignored[h / 3] != 0; };
  const auto lowerOf = [&](const HalfEdgeNodes& e) { return std::min(e.from, e.to).index(); };

  // A counting sort by the lower node leaves runs of a few entries each.
  std::vector<std::uint32_t> begins(nodeCount + 1, 0);
  for (std::uint32_t h = 0; h < count; ++h) {
    if (!isIgnored(h)) ++begins[lowerOf(nodesOf(triangles, HalfEdgeId(h))) + 1];
  }
  for (std::size_t i = 1; i <= nodeCount; ++i) begins[i] += begins[i - 1];
  std::vector<Entry> entries(begins[nodeCount]);
  std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
  for (std::uint32_t h = 0; h < count; ++h) {
    if (isIgnored(h)) continue;
    const HalfEdgeNodes e = nodesOf(triangles, HalfEdgeId(h));
    entries[next[lowerOf(e)]++] = {std::max(e.from, e.to), HalfEdgeId(h)};
  }

  halfEdges_.reserve(entries.size());
  for (std::size_t node = 0; node < nodeCount; ++node) {
    const std::span<Entry> run =
        std::span(entries).subspan(begins[node], begins[node + 1] - begins[node]);
    sortFew(run, [](const Entry& a, const Entry& b) {
      return a.higher != b.higher ? a.higher < b.higher : a.halfEdge < b.halfEdge;
    });
    for (std::size_t i = 0; i < run.size(); ++i) {
      if (i == 0 || run[i].higher != run[i - 1].higher) {
        begins_.push_back(static_cast<std::uint32_t>(halfEdges_.size()));
      }
      halfEdges_.push_back(run[i].halfEdge);
    }
  }
  begins_.push_back(static_cast<std::uint32_t>(halfEdges_.size()));
}

/// A flip swaps the last two nodes, so the first half-edge and the last one change their edges. A triangle has one half-edge on
/// an edge; so the order of an edge's half-edges stays.
void EdgeTable::followFlips(std::span<const std::uint8_t> isFlipped) {
  for (HalfEdgeId& halfEdge : halfEdges_) {
    const TriangleId triangle = triangleOf(halfEdge);
    if (isFlipped[triangle.index()] == 0) continue;
    halfEdge = halfEdgeOf(triangle, 2 - halfEdge.value % 3);
  }
}

}  // namespace tetrafront
