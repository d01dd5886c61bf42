#pragma once

/// @file The deep inside of a region: tetrahedra of lattices, wherever the sizes are nearly constant over some elements. Only the
/// rest of the region is left to the front.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/ids.h"
#include "base/task.h"
#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"
#include "topology/element_source.h"

namespace tetrafront {

/// Islands of lattice. The rim are the tetrahedra with a node on the hull: the optimizer may change them. Nothing changes the core, the
/// other tetrahedra, so its nodes at the rim stay where they are.
struct LatticeInterior {
  /// First the fixed nodes (of core and rim), then those of the hull, then the others of the rim. Those of the core alone have no array.
  std::vector<Vec3> points;
  std::uint32_t fixed = 0;
  std::uint32_t onHull = 0;
  /// Triangles of the hull, which face into the islands, as a boundary faces out of what it bounds.
  std::vector<NodeTriple> hull;
  std::vector<NodeQuad> rim;  ///< positively oriented
  /// Shares the fixed nodes; null if there is none.
  std::shared_ptr<const ElementSource> core;

  [[nodiscard]] bool isEmpty() const { return hull.empty(); }
  [[nodiscard]] std::size_t nodeCount() const {
    return points.size() + (core ? core->nodeCount() : 0);
  }
  [[nodiscard]] std::size_t tetrahedronCount() const {
    return rim.size() + (core ? core->elementCount() : 0);
  }
  [[nodiscard]] std::uint32_t firstOnHull() const { return fixed; }
  [[nodiscard]] std::uint32_t firstInRim() const { return fixed + onHull; }
};

/// Finds the islands in a region. `boundary`: all triangles around the region, closed; sizes are those of `region`. No node is nearer
/// to the boundary, or to an island of other elements, than 1.2 times the size there. None in a stretched field. O(elements), and
/// O(log n) for each node near the boundary.
Task<LatticeInterior> makeLatticeInterior(Work& work, const SurfaceMesh& boundary,
                                          const SizeField& field, std::uint32_t region);

}  // namespace tetrafront
