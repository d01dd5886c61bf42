#pragma once

/// @file Inspects, repairs and refines given surfaces before they are meshed. Inspection uses the same checks as a
/// run. Repair makes only changes that need no guessing.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// One shell of a surface that can be meshed. An interface between regions belongs to a shell on either side.
struct ShellInfo {
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
  std::uint32_t region = 0;  ///< region that it bounds, as in VolumeMesh::regions
  bool isCavity = false;     ///< bounds a cavity in that region
  double area = 0.0;
  double volume = 0.0;  ///< enclosed volume, > 0; shells inside are not subtracted
};

/// Quality of one triangle of a surface.
struct TriangleQuality {
  std::uint32_t triangle = 0;
  Vec3 centroid{0.0};
  double area = 0.0;           ///< in squared model units
  double smallestAngle = 0.0;  ///< degrees
  double radiusRatio = 0.0;    ///< 2 x inradius / circumradius, 1 for the equilateral triangle
};

/// Result of the inspection of a surface. If a coordinate or an index is invalid, only the diagnostics are set. Edges
/// are counted without triangles that have a node twice and without duplicates of another triangle.
struct SurfaceInspection {
  bool isFillable = false;  ///< no diagnostic is an error: a run would accept the surface
  bool isClosed = false;    ///< there are edges, and no edge has only one triangle
  bool isManifold = false;  ///< at most two triangles per edge, and one fan per node
  bool isEmbedded = false;  ///< triangles have in common only shared corners and edges
  std::uint32_t nodes = 0;  ///< nodes used by triangles
  std::uint32_t unusedNodes = 0;
  std::uint32_t triangles = 0;
  std::uint32_t edges = 0;
  std::uint32_t openEdges = 0;         ///< edges with one triangle
  std::uint32_t nonManifoldEdges = 0;  ///< edges with more than two triangles
  std::uint32_t nonManifoldNodes = 0;  ///< nodes with more than one fan of triangles
  /// Triangles that do not face outward; set if the surface could be meshed otherwise.
  std::uint32_t flippedTriangles = 0;
  std::uint32_t regions = 0;  ///< number of regions; set if isFillable
  Vec3 low{0.0};              ///< box of all used nodes
  Vec3 high{0.0};
  double area = 0.0;
  double volume = 0.0;  ///< of all regions, without cavities; set if isFillable
  double shortestEdge = 0.0;
  double meanEdge = 0.0;
  double longestEdge = 0.0;
  std::vector<ShellInfo> shells;       ///< in the order of their first triangles; set if isFillable
  std::vector<TriangleQuality> worst;  ///< up to ten, by radius ratio, worst first
  /// Those a run would report: of each code the first InspectionOptions::maxDiagnostics. The last value of an error
  /// is the total number.
  std::vector<Diagnostic> diagnostics;
};

struct InspectionOptions {
  /// Decides which orientation an inner shell must have: as an interface, either one is valid.
  InnerShells innerShells = InnerShells::kByOrientation;
  /// Number of diagnostics listed per code, about 200 bytes each; further ones are only counted.
  std::uint32_t maxDiagnostics = kDefaultMaxDiagnostics;
};

/// Inspects a surface in slices; a unit of work is one triangle. O(n log n) if every triangle has few others near it.
class SurfaceInspector : public SlicedTool<SurfaceInspection> {
 public:
  /// Arrays as for MeshRun; they are copied.
  /// `triangleRegions`: as in GivenRegions; known regions replace InspectionOptions::innerShells.
  SurfaceInspector(std::span<const double> points, std::span<const std::uint32_t> triangles,
                   const InspectionOptions& options = {},
                   std::span<const std::uint32_t> triangleRegions = {});
};

/// Changes that a repair may make. The defaults neither move nor add anything.
struct RepairOptions {
  /// Distance within which nodes are welded, in model units; 0: only nodes at the same position; negative: none.
  double weldDistance = 0.0;
  bool removeTriangles = true;  ///< remove degenerate triangles, and all but one of duplicates
  /// Fill holes with at most this many edges, up to kMaxHoleEdges; 0: none.
  std::uint32_t maxHoleEdges = 0;
  bool orient = true;  ///< orient triangles consistently, outward if possible
  /// If the surface could not be meshed otherwise: replace it by the boundary of what it encloses. Triangles are cut where they
  /// intersect, holes of any size are closed, and triangles that enclose nothing are left out. The change is made only if the result
  /// can be meshed.
  bool resolveIntersections = true;
  /// Distance within which nodes of intersecting triangles are welded when these are resolved, in model units; 0: none.
  /// Faces that nearly coincide then leave no low steps and narrow strips. Thinner walls may disappear; a change that alters the
  /// volume by more than 0.1 % is not made; a quarter and a sixteenth of the distance are tried then.
  double weldIntersections = 0.0;
  /// Meaning of inner shells: the triangles around a cavity are oriented the other way.
  InnerShells innerShells = InnerShells::kByOrientation;
};
inline constexpr std::uint32_t kMaxHoleEdges = 200;

enum class RepairKind : std::uint8_t {
  kWeldedNode = 0,        ///< node `first` is now `second`
  kRemovedNode = 1,       ///< node `first`, which no triangle used
  kRemovedTriangle = 2,   ///< triangle `first`, degenerate: two corners in one or all on one line
  kRemovedDuplicate = 3,  ///< triangle `first`, which had the nodes of `second`
  /// Triangle `first` had its corners on one line. Its neighbour `second` across the longest edge was split at the
  /// middle corner, and `first` removed. The shape does not change.
  kSplitTriangle = 4,
  kFilledHole = 5,       ///< `second` triangles, from triangle `first` of the result on
  kFlippedTriangle = 6,  ///< triangle `first`
  /// Triangle `first` intersected others, or was divided at their corners; `second` triangles of the result are parts of it.
  kResolvedIntersection = 7,
  kRemovedSheet = 8,  ///< triangle `first`, which bounds nothing, or lies inside
};

/// One change of a repair. Indices refer to the given surface, except for the triangles of filled holes.
struct RepairChange {
  RepairKind kind = RepairKind::kWeldedNode;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  Vec3 position{0.0};
};

/// Volume that two regions of the given surface share.
struct SharedVolume {
  std::uint32_t first = 0;   ///< the region that gets the volume
  std::uint32_t second = 0;  ///< the other one
  bool isNested = false;     ///< the first one lies inside the other as a whole
  double volume = 0.0;
  double depth = 0.0;  ///< mean width of the part with the largest volume, in model units
  Vec3 position{0.0};  ///< on the boundary of that part
};

struct SurfaceRepair {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Two per triangle, as SurfaceMesh::triangleRegions, if given regions shared volumes and the surface was replaced by their
  /// boundaries; empty otherwise.
  std::vector<std::uint32_t> triangleRegions;
  std::vector<SharedVolume> sharedVolumes;  ///< by region; set with triangleRegions
  /// Per triangle: its index in the given surface; kNoOrigin if it fills a hole.
  std::vector<std::uint32_t> origin;
  std::vector<RepairChange> changes;  ///< all changes, in the order of the kinds
  /// Largest distance by which a node was moved, in model units; without the rounding of new nodes to doubles.
  double deviation = 0.0;
  /// An error if a coordinate or an index is invalid, which cannot be repaired; a warning if an exact repair was tried and
  /// could not be made (kUnresolvedSurface).
  std::vector<Diagnostic> diagnostics;
};
inline constexpr std::uint32_t kNoOrigin = 0xffffffffU;

/// Makes the requested changes in the order of RepairOptions, and lists all of them. The result may still have
/// problems: inspect it. Holes are filled with triangles of least total area, without new nodes; a hole stays open if
/// this would need an edge that already exists. O(n log n) for n triangles, and O(m^3) for a hole of m edges. A unit of work
/// is a node, edge or triangle. Welding, filling holes and orienting are divided into slices; the other steps visit all
/// triangles in one slice.
class SurfaceRepairer : public SlicedTool<SurfaceRepair> {
 public:
  /// Arrays as for MeshRun; they are copied. `triangleRegions`: as in GivenRegions, of regions that may intersect; or empty. If
  /// intersections are resolved and regions share volumes, each region keeps its own volume, and the lowest gets what it shares.
  SurfaceRepairer(std::span<const double> points, std::span<const std::uint32_t> triangles,
                  const RepairOptions& options,
                  std::span<const std::uint32_t> triangleRegions = {});
};

/// Repairs a surface in one call.
[[nodiscard]] SurfaceRepair repairSurface(std::span<const double> points,
                                          std::span<const std::uint32_t> triangles,
                                          const RepairOptions& options,
                                          std::span<const std::uint32_t> triangleRegions = {});

/// Result of the refinement of a surface.
struct SurfaceRefinement {
  std::vector<double> points;  ///< the given nodes, then the midpoints of split edges
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t>
      origin;                    ///< per triangle: index of the given triangle that contains it
  std::uint32_t splitEdges = 0;  ///< number of split edges, and of new nodes
  double lengthRatio = 0.0;      ///< longest given edge / target length; 0 if no sizes are given
  /// Not empty if the surface was not refined: arrays, sizes or the grid are invalid, or the result would have too
  /// many elements. kTooManyElements with a triangle names the one that asks for the most; values: expected triangles,
  /// limit. Without a triangle, values: expected tetrahedra in the volume, limit.
  std::vector<Diagnostic> diagnostics;
};

/// Splits the triangles of a surface that are larger than the target size, so that a run with the same grid and
/// options can reach its sizes. Without sizes, the surface's own edges are the sizes, limited by growth. Edges longer than sqrt(2) x the target length are halved, in all triangles at the
/// edge, and only if the edge is the longest of these triangles (Rivara 1984); angles therefore stay above half of
/// what they were. New nodes are midpoints of edges, so that the shape changes by rounding only. Triangles keep
/// their orientation. O(n log n) for n triangles of the result. A unit of work is an edge or triangle; linking the edges
/// of the given triangles is not divided.
class SurfaceRefiner : public SlicedTool<SurfaceRefinement> {
 public:
  /// Arrays as for MeshRun; they are copied. `volume`: volume that the surface encloses, from its inspection; 0 if
  /// unknown. If it is known, sizes that lead to too many tetrahedra are rejected before anything is split. `regions`: as
  /// for MeshRun; the largest volume of a region caps the sizes of its own triangles. The smaller one of both regions applies to
  /// an interface.
  SurfaceRefiner(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 BackgroundGrid grid, const MeshOptions& options, double volume = 0.0,
                 const GivenRegions& regions = {});
};

/// Range and default of the angle between patches, in degrees.
inline constexpr double kMinPatchAngle = 1.0;
inline constexpr double kMaxPatchAngle = 180.0;
inline constexpr double kPatchAngle = 40.0;

/// Patches of a surface, separated by its sharp edges. They are ordered by position: by the lowest z of their points, then
/// the lowest y, the lowest x, the highest z, and so on. The order belongs to the shape: other triangles, or the same ones
/// in another order, do not change it.
struct PatchSplit {
  std::vector<std::uint32_t> trianglePatch;  ///< per triangle: index of its patch
  std::vector<std::uint32_t>
      patchGroup;  ///< per patch: the group of its triangles; 0 without groups
  /// Not empty if a coordinate, an index or the angle is invalid; there are no patches then.
  std::vector<Diagnostic> diagnostics;
};

/// Splits a surface into patches, in slices. Triangles are in one patch if they are in one group and a path of smooth edges
/// joins them; a line of sharp edges that ends within a face does not divide it. The surface may be open or
/// intersect itself. O(n log n) for n triangles; finding the edges and patches is not divided.
class PatchSplitter : public SlicedTool<PatchSplit> {
 public:
  /// Arrays as for MeshRun; they are copied. `groups`: a number per triangle, for example its patch in a file, or empty.
  /// `angle`: edges with a larger angle between the normals of their triangles are sharp; degrees.
  PatchSplitter(std::span<const double> points, std::span<const std::uint32_t> triangles,
                std::span<const std::uint32_t> groups, double angle = kPatchAngle);
};

}  // namespace tetrafront
