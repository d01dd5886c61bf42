#pragma once

/// @file A tetrahedral mesh from any source, as the optimizer needs it: checked exactly, oriented, and divided into
/// parts whose faces stay. A part is a set of elements of one region that are connected through faces which may change.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "tetrafront/mesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

struct GivenMesh {
  /// Elements in the given order; the nodes that stay come first, then the others that elements use. `regions` holds the
  /// part of each element.
  VolumeMesh mesh;
  std::size_t keptNodes = 0;
  std::vector<std::uint32_t> nodeOrigin;    ///< per node: its index in the given mesh
  std::vector<std::uint32_t> regionOfPart;  ///< the given number
  /// The faces of the parts, with the kept nodes: boundary, interfaces and kept triangles.
  SurfaceMesh surface;
  std::uint32_t orientedTetrahedra = 0;  ///< elements that were oriented
  /// If there is an error, only `orientedTetrahedra` is set besides.
  std::vector<Diagnostic> diagnostics;
};

/// Checks and divides a mesh. All indices must be in range, and `regions` must have one number per element. The arguments
/// must outlive the task. O(n log n).
Task<GivenMesh> prepareGivenMesh(Work& work, const VolumeMesh& given,
                                 std::span<const std::uint32_t> keptTriangles);

}  // namespace tetrafront
