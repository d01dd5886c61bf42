#include "boundary/corner_fans.h"

#include <utility>

#include "search/disjoint_sets.h"

namespace tetrafront {

std::vector<std::uint32_t> cornerFans(std::span<const std::uint32_t> triangles,
                                      const EdgeTable& edges) {
  DisjointSets fans(triangles.size());
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() != 2) continue;
    std::uint32_t a = halfEdges[0];
    std::uint32_t b = nextCorner(a);
    if (triangles[halfEdges[0]] != triangles[halfEdges[1]]) std::swap(a, b);
    fans.join(a, halfEdges[1]);
    fans.join(b, nextCorner(halfEdges[1]));
  }
  std::vector<std::uint32_t> fanOf(triangles.size());
  for (std::uint32_t c = 0; c < fanOf.size(); ++c) fanOf[c] = fans.find(c);
  return fanOf;
}

}  // namespace tetrafront
