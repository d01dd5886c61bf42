#pragma once

/// @file The diagnostic of a front that stalled: which faces are left, and where.

#include "tetrafront/mesh.h"
#include "tetrafront/status.h"
#include "volume/front.h"

namespace tetrafront {

/// Returns kStalled with the number of active faces and the centroid of the first one. Its entities are up to
/// kMaxStalledEntities triangles of the boundary that are still in the front, ascending; if there are none,
/// boundary nodes of its faces. `boundary` must be the one the front began from. O(n log n) for n active faces,
/// and O(triangles).
[[nodiscard]] Diagnostic describeStall(const Front& front, const SurfaceMesh& boundary);

inline constexpr std::size_t kMaxStalledEntities = 8;

/// Face of the front over a triangle of the boundary. The order is reversed: the front looks into the region.
[[nodiscard]] inline NodeTriple frontFaceOf(const SurfaceMesh& boundary, std::size_t triangle) {
  const std::uint32_t* n = boundary.triangles.data() + 3 * triangle;
  return {NodeId(n[0]), NodeId(n[2]), NodeId(n[1])};
}

}  // namespace tetrafront
