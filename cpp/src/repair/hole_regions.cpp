#include "repair/hole_regions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "topology/edge_table.h"
#include "topology/mesh_access.h"

namespace tetrafront {
namespace {

/// Two triangles at an edge. One of them, or both, have no known regions.
struct Neighbours {
  TriangleId first;
  TriangleId second;
  bool areTurned = false;  ///< whether they face different ways
};

std::vector<Neighbours> findNeighbours(const SurfaceMesh& mesh,
                                       std::span<const std::uint8_t> isKnown) {
  const EdgeTable edges(mesh.triangles, mesh.points.size() / 3, {});
  std::vector<Neighbours> found;
  for (const EdgeId edge : IdRange<EdgeId>(edges.edgeCount())) {
    const std::span<const HalfEdgeId> halfEdges = edges.halfEdgesOf(edge);
    if (halfEdges.size() != 2) continue;
    const TriangleId first = triangleOf(halfEdges[0]);
    const TriangleId second = triangleOf(halfEdges[1]);
    if (isKnown[first.index()] != 0 && isKnown[second.index()] != 0) continue;
    const bool areTurned =
        nodesOf(mesh.triangles, halfEdges[0]).from == nodesOf(mesh.triangles, halfEdges[1]).from;
    found.push_back({first, second, areTurned});
  }
  return found;
}

/// Returns the regions that a triangle has by its neighbour.
std::array<std::uint32_t, 2> regionsBeside(const SurfaceMesh& mesh, TriangleId neighbour,
                                           bool areTurned) {
  const std::size_t side = 2 * neighbour.index();
  const std::uint32_t first = mesh.triangleRegions[side];
  const std::uint32_t second = mesh.triangleRegions[side + 1];
  return areTurned ? std::array{second, first} : std::array{first, second};
}

/// Gives triangles without known regions those of their neighbours.
bool spreadRegions(SurfaceMesh& mesh, std::vector<std::uint8_t> isKnown) {
  const std::vector<Neighbours> all = findNeighbours(mesh, isKnown);
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (const auto& [first, second, areTurned] : all) {
      if (isKnown[first.index()] == isKnown[second.index()]) continue;
      const bool isFirstKnown = isKnown[first.index()] != 0;
      const TriangleId to = isFirstKnown ? second : first;
      const auto regions = regionsBeside(mesh, isFirstKnown ? first : second, areTurned);
      mesh.triangleRegions[2 * to.index()] = regions[0];
      mesh.triangleRegions[2 * to.index() + 1] = regions[1];
      isKnown[to.index()] = 1;
      isChanged = true;
    }
  }
  if (std::ranges::find(isKnown, 0) != isKnown.end()) return false;
  return std::ranges::all_of(all, [&mesh](const Neighbours& pair) {
    return regionsBeside(mesh, pair.first, false) ==
           regionsBeside(mesh, pair.second, pair.areTurned);
  });
}

}  // namespace

bool assignRegions(TrackedSurface& surface, std::span<const std::uint32_t> given) {
  auto& [mesh, origin] = surface;
  mesh.triangleRegions.assign(2 * origin.size(), SurfaceMesh::kNoRegion);
  std::vector<std::uint8_t> isKnown(origin.size(), 0);
  for (std::size_t t = 0; t < origin.size(); ++t) {
    if (origin[t].isNone()) continue;
    isKnown[t] = 1;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
      mesh.triangleRegions[2 * t + side] = given[2 * origin[t].index() + side];
    }
  }
  return spreadRegions(mesh, std::move(isKnown));
}

}  // namespace tetrafront
