#include "topology/half_faces.h"

#include <algorithm>
#include <utility>

#include "base/sort.h"
#include "geom/predicates.h"
#include "topology/disjoint_sets.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Returns the half-face that looks towards the next triangle by angle. It is the back if the half-edge runs from
/// the higher to the lower node.
HalfFaceId halfFaceAhead(const SurfaceMesh& mesh, HalfEdgeId halfEdge) {
  const HalfEdgeNodes nodes = nodesOf(mesh.triangles, halfEdge);
  const TriangleId triangle = triangleOf(halfEdge);
  return nodes.from > nodes.to ? backOf(triangle) : frontOf(triangle);
}

HalfFaceId halfFaceBehind(const SurfaceMesh& mesh, HalfEdgeId halfEdge) {
  return oppositeOf(halfFaceAhead(mesh, halfEdge));
}

/// Returns the number of the set of each member as an id.
template <class SetId>
std::vector<SetId> numberSets(DisjointSets& sets) {
  const std::vector<std::uint32_t> numbers = sets.numbers();
  std::vector<SetId> ids;
  ids.reserve(numbers.size());
  for (const std::uint32_t number : numbers) ids.emplace_back(number);
  return ids;
}

}  // namespace

void flipTriangle(SurfaceMesh& mesh, TriangleId triangle) {
  const std::size_t i = 3 * triangle.index();
  std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
}

bool orientConsistently(SurfaceMesh& mesh, const EdgeTable& edges) {
  OpposedSets sets(countTriangles(mesh));
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    if (halfEdges.size() < 2) continue;
    const bool areOpposite =
        nodesOf(mesh.triangles, halfEdges[0]).from == nodesOf(mesh.triangles, halfEdges[1]).from;
    if (!sets.join(triangleOf(halfEdges[0]).value, triangleOf(halfEdges[1]).value, areOpposite)) {
      return false;
    }
  }
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    if (sets.find(t).isOpposite != 0) flipTriangle(mesh, TriangleId(t));
  }
  return true;
}

void sortByAngle(const SurfaceMesh& mesh, std::vector<HalfEdgeId>& halfEdges) {
  const HalfEdgeNodes first = nodesOf(mesh.triangles, halfEdges[0]);
  const Vec3 low = pointOf(mesh, std::min(first.from, first.to));
  const Vec3 high = pointOf(mesh, std::max(first.from, first.to));
  const Vec3 reference = pointOf(mesh, first.apex);
  struct Entry {
    int sector;  ///< 0: the first half-edge, 1: less than half a turn after it, 2: half a turn, 3: more
    Vec3 apex;
    HalfEdgeId halfEdge;
  };
  std::vector<Entry> entries;
  for (const HalfEdgeId h : halfEdges) {
    const Vec3 apex = pointOf(mesh, nodesOf(mesh.triangles, h).apex);
    const int sign = orient3d(low, high, reference, apex);
    entries.push_back({h == halfEdges[0] ? 0 : 2 - sign, apex, h});
  }
  stableSort(entries, [&](const Entry& a, const Entry& b) {
    if (a.sector != b.sector) return a.sector < b.sector;
    return orient3d(low, high, a.apex, b.apex) > 0;
  });
  for (std::size_t i = 0; i < entries.size(); ++i) halfEdges[i] = entries[i].halfEdge;
}

std::vector<ShellId> linkHalfFaces(const SurfaceMesh& mesh, const EdgeTable& edges) {
  DisjointSets sets(2 * std::size_t{countTriangles(mesh)});
  std::vector<HalfEdgeId> around;
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    around.assign(halfEdges.begin(), halfEdges.end());
    // Two need no sorting: each is the next of the other.
    if (around.size() > 2) sortByAngle(mesh, around);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const HalfEdgeId next = around[(i + 1) % around.size()];
      sets.join(halfFaceAhead(mesh, around[i]).value, halfFaceBehind(mesh, next).value);
    }
  }
  return numberSets<ShellId>(sets);
}

std::vector<ComponentId> connectedComponents(const SurfaceMesh& mesh, const EdgeTable& edges) {
  DisjointSets sets(countTriangles(mesh));
  for (std::size_t e = 0; e < edges.edgeCount(); ++e) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(EdgeId(e));
    for (const HalfEdgeId h : halfEdges.subspan(1)) {
      sets.join(triangleOf(halfEdges[0]).value, triangleOf(h).value);
    }
  }
  return numberSets<ComponentId>(sets);
}

}  // namespace tetrafront
