#pragma once

/// @file Improves the elements of a mesh from any source. Its boundary, its interfaces and given triangles stay.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Number and shapes of the elements of a mesh.
struct MeshShapes {
  std::uint32_t nodes = 0;  ///< nodes used by elements
  std::uint32_t tetrahedra = 0;
  QualitySummary quality;
  std::uint32_t outOfRange = 0;  ///< elements with a dihedral angle outside 30 to 135 degrees
  /// Those of them that the boundary limits; see QualityStatistics.
  std::uint32_t limitedByBoundary = 0;
};

/// Growth of a mesh, as a fraction of its elements, that is kept for making poor elements better.
inline constexpr double kGrowthForPoor = 0.05;

/// Effort and limits of an improvement.
struct ImproveOptions {
  Optimization optimization = Optimization::kDefault;
  /// Number of elements that may be added, as a fraction of the given ones. Up to kGrowthForPoor, elements are added only
  /// where that makes a poor element better.
  double maxGrowth = kGrowthForPoor;
};

/// Result of an improvement. If there is a diagnostic of severity kError, nothing else is set but `isReadable`.
struct MeshImprovement {
  /// False if an array length, an index or a coordinate is invalid, or if there is no element.
  bool isReadable = false;
  /// False if no better mesh was found. The mesh is then the given one, with all elements oriented.
  bool isImproved = false;
  bool isPartial = false;                 ///< stop() ended the work early
  std::vector<double> points;             ///< x y z per node
  std::vector<std::uint32_t> tetrahedra;  ///< nodes a b c d per element, (b-a) x (c-a) . (d-a) > 0
  std::vector<std::uint32_t> regions;     ///< one per element, with the given numbers
  /// Per node: its index in the given mesh, or kNoIndex of a node that was moved or added. All nodes of the
  /// boundary, of interfaces and of the kept triangles have one.
  std::vector<std::uint32_t> nodeOrigin;
  std::uint32_t orientedTetrahedra = 0;  ///< elements that were given with negative volume
  /// Whether changes were refused because they would have added more elements than permitted.
  bool isGrowthLimited = false;
  MeshShapes before;
  MeshShapes after;
  std::vector<Diagnostic> diagnostics;
};

/// Improves a mesh in slices: swaps, moves, splits and collapses, as after a run, with the sizes of the mesh's own
/// edges. The result is at least as good in its smallest and its largest dihedral angle, its least and its mean radius ratio,
/// and the share of elements outside 30 to 135 degrees; and it has no more elements than ImproveOptions::maxGrowth permits. A mesh whose elements have no volume, overlap, or share
/// a face with two others gives a diagnostic that names them; a part inside another is not recognized if an edge joins
/// their boundaries. A unit of work is about one element. O(n log n) per sweep. After stop(), the result is the mesh as it
/// then was, or the given one.
class MeshImprover : public SlicedTool<MeshImprovement> {
 public:
  /// `points`: x y z per node. `tetrahedra`: nodes a b c d of element t at [4t..4t+3], in any orientation. `regions`: one
  /// number per element, or empty. `keptTriangles`: three nodes per triangle; those that are faces of elements stay
  /// faces, and their nodes stay. All arrays are copied.
  MeshImprover(std::span<const double> points, std::span<const std::uint32_t> tetrahedra,
               std::span<const std::uint32_t> regions, std::span<const std::uint32_t> keptTriangles,
               const ImproveOptions& options);
};

}  // namespace tetrafront
