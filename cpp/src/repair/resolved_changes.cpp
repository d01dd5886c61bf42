#include "repair/resolved_changes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/sort.h"
#include "geom/measure.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront {

std::vector<RepairChange> resolvedChanges(const TrackedSurface& surface,
                                          const EnclosedSurface& enclosed) {
  const auto& [mesh, origin] = surface;
  std::vector<RepairChange> changes;
  const auto add = [&](RepairKind kind, std::uint32_t t, TriangleId second) {
    const Vec3 position = centroidOf(cornersOf(mesh, TriangleId(t)));
    changes.push_back({kind, origin[t].value, second.value, position});
  };
  std::vector<std::uint32_t> count(enclosed.isCut.size(), 0);
  std::vector<TriangleId> last(count.size());
  for (std::uint32_t t = 0; t < enclosed.origin.size(); ++t) {
    ++count[enclosed.origin[t].index()];
    last[enclosed.origin[t].index()] = TriangleId(t);
  }
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    if (origin[t].isNone()) continue;
    const NodeTriple given = nodesOf(mesh, TriangleId(t));
    if (count[t] == 1) {
      const NodeTriple left = nodesOf(enclosed.mesh, last[t]);
      if (sorted(left) == sorted(given)) {
        const auto first = std::ranges::find(left, given[0]) - left.begin();
        const bool isFlipped = left[static_cast<std::size_t>(first + 1) % 3] != given[1];
        if (isFlipped) add(RepairKind::kFlippedTriangle, t, TriangleId{});
        continue;
      }
    }
    if (enclosed.isCut[t] != 0 || count[t] > 1) {
      add(RepairKind::kResolvedIntersection, t, TriangleId(count[t]));
    } else if (count[t] == 0) {
      add(RepairKind::kRemovedSheet, t, TriangleId{});
    }
  }
  return changes;
}

}  // namespace tetrafront
