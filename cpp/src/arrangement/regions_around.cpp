#include "arrangement/regions_around.h"

#include <cstddef>
#include <optional>

#include "boundary/ray_crossing.h"
#include "boundary/self_intersection.h"
#include "geom/predicates.h"
#include "search/box_tree.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Returns whether a triangle that the ray along x crosses has it arrive from behind.
bool isCrossedFromBehind(const SurfaceMesh& mesh, TriangleId triangle) {
  const auto [a, b, c] = cornersOf(mesh, triangle);
  return orient2d({a.y, a.z}, {b.y, b.z}, {c.y, c.z}) > 0;
}

class Surroundings {
 public:
  Surroundings(const SurfaceMesh& mesh, std::span<const std::uint32_t> componentOf)
      : mesh_(mesh), componentOf_(componentOf), tree_(triangleBoxes(mesh)) {}

  /// Returns the windings at a node of a component; nothing if it lies on another component, or if this is not decided.
  [[nodiscard]] std::optional<RegionWindings> at(NodeId node, std::uint32_t component) const {
    const Vec3 start = pointOf(mesh_, node);
    RegionWindings windings;
    bool isDecided = true;
    tree_.visitOverlaps(boxOfRay(start), [&](std::uint32_t item) {
      const TriangleId triangle(item);
      const std::uint32_t other = componentOf_[item];
      if (other == component || other == kNoIndex) return;
      const bool isAhead = isAheadOf(mesh_, start, triangle);
      if (!isAhead && !liesOn(mesh_, start, triangle)) return;
      isDecided = isDecided && isAhead && other != kInPart;
      const std::int64_t number = isCrossedFromBehind(mesh_, triangle) ? 1 : -1;
      addWinding(windings, mesh_.triangleRegions[2 * std::size_t{item}], number);
      addWinding(windings, mesh_.triangleRegions[2 * std::size_t{item} + 1], -number);
    });
    return isDecided ? std::optional(std::move(windings)) : std::nullopt;
  }

 private:
  const SurfaceMesh& mesh_;
  std::span<const std::uint32_t> componentOf_;
  BoxTree tree_;
};

}  // namespace

std::vector<RegionWindings> findRegionsAround(const SurfaceMesh& mesh,
                                              std::span<const std::uint32_t> componentOf,
                                              std::uint32_t components) {
  std::vector<RegionWindings> found(components);
  if (components < 2) return found;
  const Surroundings surroundings(mesh, componentOf);
  std::vector<std::uint8_t> isFound(components, 0);
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    const std::uint32_t component = componentOf[t];
    if (component >= components || isFound[component] != 0) continue;
    for (const NodeId node : nodesOf(mesh, TriangleId(t))) {
      std::optional<RegionWindings> windings = surroundings.at(node, component);
      if (!windings) continue;
      found[component] = *std::move(windings);
      isFound[component] = 1;
      break;
    }
  }
  return found;
}

}  // namespace tetrafront
