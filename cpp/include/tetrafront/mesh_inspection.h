#pragma once

/// @file Inspects meshes from any source: whether they are valid, the quality of their elements, and their boundary.
/// Signs are exact; the statistics are computed as in the report of a run.

#include <cstdint>
#include <span>

#include "tetrafront/mesh.h"
#include "tetrafront/quality_statistics.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Result of the inspection of a mesh.
struct MeshInspection {
  /// False if an array length, an index or a coordinate is invalid, or if there is no element. All other members
  /// then keep their defaults.
  bool isReadable = false;
  std::uint32_t nodes = 0;  ///< nodes used by elements
  std::uint32_t unusedNodes = 0;
  std::uint32_t tetrahedra = 0;
  std::uint32_t invertedTetrahedra = 0;    ///< (b-a) x (c-a) . (d-a) < 0; measured as if reversed
  std::uint32_t degenerateTetrahedra = 0;  ///< zero volume, exactly
  std::uint32_t duplicateTetrahedra = 0;   ///< with the nodes of another
  std::uint32_t nonManifoldFaces = 0;      ///< shared by more than two elements
  std::uint32_t overlappingFaces = 0;      ///< with two elements on the same side
  std::uint32_t coincidentNodes = 0;       ///< used nodes at the position of another
  double shortestEdge = 0.0;
  double longestEdge = 0.0;
  /// Mean over the edges of all elements; an edge counts once per element.
  double meanEdge = 0.0;
  QualitySummary quality;
  /// Computed with `meanEdge` as the target length of all edges.
  QualityStatistics statistics;
  /// Faces of one element only, counter-clockwise seen from outside, with the node indices of the mesh.
  /// `trianglePatch` holds the region of the element; `points` is empty.
  SurfaceMesh boundary;
};

/// Inspects a mesh in slices; a unit of work is one element. O(n log n).
class MeshInspector : public SlicedTool<MeshInspection> {
 public:
  /// `points`: x y z per node. `tetrahedra`: nodes a b c d of element t at [4t..4t+3]. `regions`: one per element,
  /// or empty. All arrays are copied.
  MeshInspector(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
                std::span<const std::uint32_t> regions);
};

/// Inspects a mesh in one call.
[[nodiscard]] MeshInspection inspectMesh(std::span<const double> points,
                                         std::span<const std::uint32_t> tetrahedra,
                                         std::span<const std::uint32_t> regions);

}  // namespace tetrafront
