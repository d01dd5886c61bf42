#include "repair/duplicate_triangles.h"

#include <cstddef>
#include <cstdint>

#include "base/sort.h"
#include "topology/surface_access.h"

namespace tetrafront {

std::vector<TriangleId> findDuplicateTriangles(const SurfaceMesh& mesh) {
  struct Entry {
    NodeTriple nodes;  ///< ascending
    TriangleId triangle;
  };
  std::vector<Entry> byNodes;
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    byNodes.push_back({sorted(nodesOf(mesh, TriangleId(t))), TriangleId(t)});
  }
  stableSort(byNodes, [](const Entry& a, const Entry& b) {
    return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
  });
  std::vector<TriangleId> firstOf(countTriangles(mesh));
  for (std::size_t i = 1; i < byNodes.size(); ++i) {
    if (byNodes[i].nodes != byNodes[i - 1].nodes) continue;
    const TriangleId before = byNodes[i - 1].triangle;
    const TriangleId first = firstOf[before.index()];
    firstOf[byNodes[i].triangle.index()] = first.isNone() ? before : first;
  }
  return firstOf;
}

}  // namespace tetrafront
