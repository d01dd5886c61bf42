#include "boundary/half_faces.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "search/disjoint_sets.h"
#include "boundary/surface_access.h"

namespace tetrafront {
namespace {

/// The side of a half-edge's triangle that looks towards the next triangle by angle. One that runs
/// from the higher to the lower node has its back there.
std::uint32_t halfFaceAhead(const SurfaceMesh& mesh, std::uint32_t halfEdge) {
  const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdge);
  return nodes.from > nodes.to ? backOf(halfEdge / 3) : frontOf(halfEdge / 3);
}

std::uint32_t halfFaceBehind(const SurfaceMesh& mesh, std::uint32_t halfEdge) {
  return halfFaceAhead(mesh, halfEdge) ^ 1U;
}

}  // namespace

void flipTriangle(SurfaceMesh& mesh, std::uint32_t triangle) {
  const std::size_t i = 3 * std::size_t{triangle};
  std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
}

bool orientConsistently(SurfaceMesh& mesh, const EdgeTable& edges) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
  OpposedSets sets(count);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    if (halfEdges.size() < 2) continue;
    const bool areOpposite =
        nodesOf(mesh.triangles, halfEdges[0]).from == nodesOf(mesh.triangles, halfEdges[1]).from;
    if (!sets.join(halfEdges[0] / 3, halfEdges[1] / 3, areOpposite)) return false;
  }
  for (std::uint32_t t = 0; t < count; ++t) {
    if (sets.find(t).isOpposite != 0) flipTriangle(mesh, t);
  }
  return true;
}

void sortByAngle(const SurfaceMesh& mesh, std::vector<std::uint32_t>& halfEdges) {
  const HalfEdgeNodes first = nodesOf(mesh.triangles, halfEdges[0]);
  const Vec3 low = pointOf(mesh, std::min(first.from, first.to));
  const Vec3 high = pointOf(mesh, std::max(first.from, first.to));
  const Vec3 reference = pointOf(mesh, first.apex);
  struct Entry {
    int quarter;  ///< 0 the reference, 1 the half turn after it, 2 opposite to it, 3 the rest
    Vec3 apex;
    std::uint32_t halfEdge;
  };
  std::vector<Entry> entries;
  for (const std::uint32_t h : halfEdges) {
    const Vec3 apex = pointOf(mesh, nodesOf(mesh.triangles, h).apex);
    const int side = orient3d(low, high, reference, apex);
    entries.push_back({h == halfEdges[0] ? 0 : 2 - side, apex, h});
  }
  stableSort(entries, [&](const Entry& a, const Entry& b) {
    if (a.quarter != b.quarter) return a.quarter < b.quarter;
    return orient3d(low, high, a.apex, b.apex) > 0;
  });
  for (std::size_t i = 0; i < entries.size(); ++i) halfEdges[i] = entries[i].halfEdge;
}

std::vector<std::uint32_t> linkHalfFaces(const SurfaceMesh& mesh, const EdgeTable& edges) {
  DisjointSets sets(2 * (mesh.triangles.size() / 3));
  std::vector<std::uint32_t> around;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    around.assign(halfEdges.begin(), halfEdges.end());
    // Of two, each is the other's next.
    if (around.size() > 2) sortByAngle(mesh, around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      sets.join(halfFaceAhead(mesh, around[i]),
                halfFaceBehind(mesh, around[(i + 1) % around.size()]));
    }
  }
  return sets.numbers();
}

std::vector<std::uint32_t> connectedComponents(const SurfaceMesh& mesh, const EdgeTable& edges) {
  DisjointSets sets(mesh.triangles.size() / 3);
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const std::uint32_t> halfEdges = edges.halfEdgesOf(e);
    for (const std::uint32_t h : halfEdges.subspan(1)) sets.join(halfEdges[0] / 3, h / 3);
  }
  return sets.numbers();
}

}  // namespace tetrafront
