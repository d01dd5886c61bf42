#pragma once

/// @file Given surfaces before they are filled: what is there, what is wrong with it, and the few
/// repairs that need no guessing. The questions are answered by the very checks that a run begins
/// with.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// One closed, connected part of a surface that can be filled. A wall between regions belongs to one on
/// either side.
struct ShellFigures {
  std::uint32_t firstTriangle = 0;
  std::uint32_t triangles = 0;
  std::uint32_t region = 0;  ///< that lies on its inner side, as in VolumeMesh::regions
  bool isCavity = false;     ///< bounds a void within that region
  double area = 0.0;
  double volume = 0.0;  ///< enclosed by this shell alone, > 0
};

/// One triangle of a surface.
struct TriangleFigures {
  std::uint32_t triangle = 0;
  Vec3 place{0.0};             ///< centroid
  double area = 0.0;           ///< in squared model units
  double smallestAngle = 0.0;  ///< degrees
  double radiusRatio = 0.0;    ///< 2 x inradius / circumradius, 1 for the equilateral triangle
};

/// What inspection finds. Where coordinates or indices are broken only the diagnostics are filled.
/// Triangles with a node twice make no edges, and of those with the same nodes only the first does.
struct SurfaceInspection {
  bool isFillable = false;  ///< no error among the diagnostics: a run would accept the surface
  bool isClosed = false;    ///< it has edges, and none of them has one triangle
  bool isManifold = false;  ///< no edge with more than two triangles, and one fan at every node
  bool isEmbedded = false;  ///< no two triangles meet but in shared corners and edges
  std::uint32_t nodes = 0;  ///< that triangles use
  std::uint32_t unusedNodes = 0;
  std::uint32_t triangles = 0;
  std::uint32_t edges = 0;
  std::uint32_t openEdges = 0;     ///< with one triangle
  std::uint32_t crowdedEdges = 0;  ///< with more than two
  std::uint32_t pinchedNodes = 0;  ///< where more than one fan of triangles meets
  /// That do not face outward; known where nothing else keeps the surface from being filled.
  std::uint32_t turnedTriangles = 0;
  std::uint32_t regions = 0;  ///< bodies; known where isFillable
  Vec3 low{0.0};              ///< the box of all used nodes
  Vec3 high{0.0};
  double area = 0.0;
  double volume = 0.0;  ///< of all regions, cavities left out; known where isFillable
  double shortestEdge = 0.0;
  double meanEdge = 0.0;
  double longestEdge = 0.0;
  std::vector<ShellFigures> shells;    ///< by their first triangles; known where isFillable
  std::vector<TriangleFigures> worst;  ///< up to ten, by radius ratio, the worst first
  /// As a run would have them: of each code the first InspectionOptions::findings, the last of an
  /// error's values counting all.
  std::vector<Diagnostic> diagnostics;
};

/// So many findings of each code teach what is wrong with a surface; a ruined one has millions.
inline constexpr std::uint32_t kListedFindings = 1000;

struct InspectionOptions {
  /// What enclosed parts bound decides how they may be turned: between two regions either way will do.
  EnclosedBodies enclosed = EnclosedBodies::kCavities;
  /// So many findings of each code are listed, at some 200 bytes each; the others are counted.
  std::uint32_t findings = kListedFindings;
};

/// Inspects a surface in slices. O(n log n) where triangles have few others near them.
class SurfaceInspector {
 public:
  /// Arrays as for MeshRun; they are copied.
  SurfaceInspector(std::span<const double> points, std::span<const std::uint32_t> triangles,
                   const InspectionOptions& options = {});
  SurfaceInspector(SurfaceInspector&&) noexcept;
  SurfaceInspector& operator=(SurfaceInspector&&) noexcept;
  ~SurfaceInspector();

  /// Works on for about `budget` triangles; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const SurfaceInspection& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// What repairSurface() may change; by default nothing that moves or adds anything.
struct RepairOptions {
  /// Nodes no further apart than this become one, in model units; 0: those at the very same place,
  /// below 0: none.
  double weldDistance = 0.0;
  bool removesTriangles = true;  ///< without area, and all but one of those with the same nodes
  std::uint32_t fillsUpTo = 0;   ///< holes of so many edges, at most kMostHoleEdges; 0: none
  bool turns = true;             ///< triangles to agree with each other, outward if possible
  /// As a run is to take closed parts within others: cavities are turned the other way.
  EnclosedBodies enclosed = EnclosedBodies::kCavities;
};
inline constexpr std::uint32_t kMostHoleEdges = 200;

enum class RepairKind : std::uint8_t {
  kWeldedNode = 0,        ///< node `first` is now `second`
  kDroppedNode = 1,       ///< node `first`, which no triangle used
  kRemovedTriangle = 2,   ///< `first`, which had two corners in one or all on one line
  kRemovedDuplicate = 3,  ///< triangle `first`, which had the nodes of `second`
  /// Triangle `first` had its corners on one line: `second` beyond its longest edge was split
  /// where the middle corner lies on it. The shape is the same.
  kSplitTriangle = 4,
  kFilledHole = 5,       ///< with `second` triangles, from `first` of the result on
  kFlippedTriangle = 6,  ///< `first`
};

/// Numbers are those of the given surface, but for the triangles of filled holes.
struct RepairChange {
  RepairKind kind = RepairKind::kWeldedNode;
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  Vec3 place{0.0};
};

struct SurfaceRepair {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: its number in the given surface; kNoOrigin for one that fills a hole.
  std::vector<std::uint32_t> origin;
  std::vector<RepairChange> changes;  ///< every one, in the order of the kinds
  /// Not empty only where coordinates or indices are broken, which nothing here repairs.
  std::vector<Diagnostic> diagnostics;
};
inline constexpr std::uint32_t kNoOrigin = 0xffffffffU;

/// Makes the changes asked for, in the order of RepairOptions, and lists them all. Promises
/// nothing about the result, which is to be inspected. Holes are filled by the triangles of least
/// area in sum, without new nodes; one that would need an edge that exists is left open.
/// O(n log n), and O(edges^3) for each hole.
class SurfaceRepairer {
 public:
  /// Arrays as for MeshRun; they are copied.
  SurfaceRepairer(std::span<const double> points, std::span<const std::uint32_t> triangles,
                  const RepairOptions& options);
  SurfaceRepairer(SurfaceRepairer&&) noexcept;
  SurfaceRepairer& operator=(SurfaceRepairer&&) noexcept;
  ~SurfaceRepairer();

  /// Works on; true when finished. A call takes a step of the repair, the longest of which look at
  /// all triangles once; nodes are welded, holes filled and triangles turned for about `budget` nodes,
  /// edges and triangles.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const SurfaceRepair& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The whole repair at once.
[[nodiscard]] SurfaceRepair repairSurface(std::span<const double> points,
                                          std::span<const std::uint32_t> triangles,
                                          const RepairOptions& options);

struct SurfaceRefinement {
  std::vector<double> points;  ///< the given ones, then the middles of halved edges
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> origin;  ///< per triangle: the given one that it is a part of
  std::uint32_t splitEdges = 0;       ///< as many as there are new points
  /// Not empty where nothing was done: numbers, sizes or the grid are broken, or kTooManyElements, with
  /// the triangle that asks for the most, as values the triangles expected and the most there may be;
  /// without a triangle, as values the tetrahedra expected inside and the most there may be.
  std::vector<Diagnostic> diagnostics;
};

/// Divides the triangles of a surface that are larger than the elements wanted there, so that a run
/// with the same grid and options can have these: sizes as for MeshRun. Edges longer than root 2 of
/// what is wanted are halved, each in all of its triangles, the longest of its triangles only (Rivara
/// 1984): angles stay above half of what they were. New points are middles of edges, up to rounding:
/// the shape is the same. Triangles keep their turning. O(n log n) for n triangles of the result.
class SurfaceRefiner {
 public:
  /// Arrays as for MeshRun; they are copied. `volume`: what the surface encloses, as inspection tells
  /// it; then sizes by which a run could not fill it are refused before anything is divided. 0: not
  /// known.
  SurfaceRefiner(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 BackgroundGrid grid, const MeshOptions& options, double volume = 0.0);
  SurfaceRefiner(SurfaceRefiner&&) noexcept;
  SurfaceRefiner& operator=(SurfaceRefiner&&) noexcept;
  ~SurfaceRefiner();

  /// Works on for about `budget` edges or triangles; true when finished. Linking the edges of the
  /// given triangles is one step.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Complete once advance() has returned true.
  [[nodiscard]] const SurfaceRefinement& result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tetrafront
