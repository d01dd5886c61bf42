#include "topology/corner_fans.h"

#include <utility>

#include "topology/disjoint_sets.h"

namespace tetrafront {

std::vector<HalfEdgeId> cornerFans(std::span<const std::uint32_t> triangles,
                                   const EdgeTable& edges) {
  DisjointSets fans(triangles.size());
  const auto join = [&fans](HalfEdgeId a, HalfEdgeId b) { fans.join(a.value, b.value); };
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() != 2) continue;
    HalfEdgeId a = halfEdges[0];
    HalfEdgeId b = nextOf(a);
    if (triangles[halfEdges[0].index()] != triangles[halfEdges[1].index()]) std::swap(a, b);
    join(a, halfEdges[1]);
    join(b, nextOf(halfEdges[1]));
  }
  std::vector<HalfEdgeId> fanOf(triangles.size());
  for (std::uint32_t c = 0; c < fanOf.size(); ++c) fanOf[c] = HalfEdgeId(fans.find(c));
  return fanOf;
}

}  // namespace tetrafront
