#include "surface/corner_fans.h"

#include <algorithm>
#include <numeric>

namespace tetrafront {
namespace {

std::uint32_t lowestOf(std::vector<std::uint32_t>& parent, std::uint32_t corner) {
  while (parent[corner] != corner) {
    parent[corner] = parent[parent[corner]];
    corner = parent[corner];
  }
  return corner;
}

void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t rootA = lowestOf(parent, a);
  const std::uint32_t rootB = lowestOf(parent, b);
  parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
}

}  // namespace

std::vector<std::uint32_t> cornerFans(std::span<const std::uint32_t> triangles,
                                      const EdgeTable& edges) {
  std::vector<std::uint32_t> fans(triangles.size());
  std::iota(fans.begin(), fans.end(), 0U);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() != 2) continue;
    std::uint32_t a = halfEdges[0];
    std::uint32_t b = nextCorner(a);
    if (triangles[halfEdges[0]] != triangles[halfEdges[1]]) std::swap(a, b);
    join(fans, a, halfEdges[1]);
    join(fans, b, nextCorner(halfEdges[1]));
  }
  for (std::uint32_t c = 0; c < fans.size(); ++c) fans[c] = lowestOf(fans, c);
  return fans;
}

}  // namespace tetrafront
