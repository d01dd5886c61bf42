#pragma once

/// @file The surface of a mesh that was given without one.

#include <cstdint>
#include <vector>

#include "base/task.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

struct MeshBoundary {
  /// Faces that only one element has: counter-clockwise as seen from outside if the elements are positively oriented, in the
  /// order of the elements; trianglePatch holds their regions. `points` is empty.
  SurfaceMesh boundary;
  /// Three nodes per face between two regions, oriented as in the first of its elements.
  std::vector<std::uint32_t> interfaces;
};

/// Finds the faces that only one tetrahedron has, and those between two regions. Indices must be in range. `mesh` must outlive
/// the task and must not change. O(n log m) if at most m faces share their lowest node.
Task<MeshBoundary> findMeshBoundary(Work& work, const VolumeMesh& mesh);

}  // namespace tetrafront
