#pragma once

/// @file Remeshes a given surface: replaces its triangles by triangles of a target size and good
/// shape, within a tolerance of the given surface.

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

/// Range of the angles in RemeshOptions, in degrees.
inline constexpr double kMinRemeshAngle = 1.0;
inline constexpr double kMaxRemeshAngle = 180.0;

/// Range of RemeshOptions::sizeFactor.
inline constexpr double kMinSizeFactor = 1e-3;
inline constexpr double kMaxSizeFactor = 1e3;

/// Largest number of layers across thin walls.
inline constexpr double kMaxLayers = 100.0;

/// Options of a remeshing. With the defaults, sizes follow from curvature, thickness and gaps,
/// which suits any shape.
struct RemeshOptions {
  /// Target edge length, in model units, > 0; 0: automatic, unless a background grid is given. Sources cap
  /// the sizes.
  double size = 0.0;
  /// Smallest automatic size; 0: chosen automatically, with smaller sizes at shorter feature lines and narrower gaps.
  double minSize = 0.0;
  double maxSize = 0.0;  ///< largest automatic size; 0: a fifteenth of the surface's diagonal
  /// Largest distance between the two surfaces, measured from each to the other, in model units; 0:
  /// 1/250 of the diagonal, with several regions of that of the smallest, but at least 1/2000 of the whole; with given
  /// sizes 1/700 instead of 1/250, and at most a twentieth of `size`. Besides, at most half of the mean thickness 2 V / A of the
  /// thinnest region.
  double tolerance = 0.0;
  double featureAngle =
      40.0;  ///< edges with a larger angle between their triangles stay sharp; degrees
  /// Largest angle that an edge may span on a curved patch, in degrees; 0: 36, and 60 if a size or a grid is given.
  double anglePerEdge = 0.0;
  /// Elements across the thickness of thin parts; 0: thickness has no influence; negative: 1, and 0 if a size or a grid is given.
  double layers = -1.0;
  /// Factor on all automatic lengths, angles and layers: below 1, all sizes shrink by it; above 1, flat and curved faces get
  /// coarser first, then thin walls and gaps, and the automatic tolerance grows as far as the curvature requires.
  double sizeFactor = 1.0;
  /// Details below this are dropped first: where feature lines are nearer to each other, they become one. In model units;
  /// 0: all details are kept.
  double dropDetails = 0.0;
  /// Details below a fifth of the tolerance are dropped, unless a background grid or sources are given, or the smallest size is
  /// less than six times as large. If an angle is below 10 degrees all the same, more details across which the triangles are poor
  /// are dropped; unless the result is not better, or triangles are poor everywhere (mean radius ratio below 0.8). The
  /// tolerance is kept.
  bool dropPoorDetails = false;
  double growth = 0.3;  ///< growth of sizes per unit of distance, 0 to kMaxGrowth
  /// Largest volume of a tetrahedron of the future mesh, as in MeshOptions: it caps all sizes; 0 for no limit.
  double maxVolume = 0.0;
  /// Largest number of triangles that the sizes may ask for; above it, the result has kTooManyElements. The given
  /// triangles are never too many.
  std::uint32_t maxTriangles = 5'000'000;
  InnerShells innerShells = InnerShells::kByOrientation;
};

/// A node of a feature line of the given surface, and the point of another line onto which it was moved.
struct MergedDetail {
  Vec3 from{0.0};
  Vec3 onto{0.0};
};

/// Result of a remeshing.
struct SurfaceRemesh {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: a given triangle of the same smooth patch; where the patch is curved, one near it.
  std::vector<std::uint32_t> origin;
  /// Per triangle: its distance from the given surface, the largest of seven samples. For display; `deviation` is the bound.
  /// Empty if the work was stopped before.
  std::vector<float> triangleDeviation;
  double size = 0.0;       ///< largest target size used
  double minSize = 0.0;    ///< smallest target size used, except at details
  double tolerance = 0.0;  ///< tolerance used
  /// Upper bound of the distance between the surfaces, both ways; not below the tolerance. If the work was stopped, it is not
  /// measured, but the tolerance, which every change keeps. With `onFaces`, samples count, and it may be up to twice the tolerance
  /// where the given triangles are far from the faces themselves.
  double deviation = 0.0;
  std::vector<MergedDetail> mergedDetails;  ///< what was dropped, in this order
  std::uint32_t patches = 0;                ///< smooth patches of the given surface
  std::uint32_t featureLines = 0;           ///< feature lines of the given surface
  double givenVolume = 0.0;      ///< enclosed by the given surface, by all of its regions together
  double volume = 0.0;           ///< enclosed by the new surface, likewise
  double smallestAngle = 0.0;    ///< of all triangles, in degrees
  double meanRadiusRatio = 0.0;  ///< of all triangles
  bool isPartial = false;        ///< stop() ended the work before all triangles were improved
  bool onFaces = false;          ///< the faces of the model were triangulated on their own surfaces
  /// Faces of the model that could not be triangulated on their surfaces; ascending. With `onFaces`, only their triangles were
  /// changed instead, and those around them.
  std::vector<std::uint32_t> failedFaces;
  /// Errors if the surface was not remeshed, because it is not a valid boundary or an option is
  /// out of range. Otherwise notes about components that were given inside out.
  std::vector<Diagnostic> diagnostics;
};

/// Remeshes a surface in slices. Every change keeps the surface closed and, by exact signs, free of
/// self-intersections; it also keeps the tolerance, the feature lines, the corners and the groups.
/// A unit of work is about one change. The work is about linear in the number of triangles given
/// and made. After stop(), the result is the surface as it then was.
class SurfaceRemesher : public SlicedTool<SurfaceRemesh> {
 public:
  /// Arrays as for MeshRun; they are copied. `groups`: a number per triangle, for example its patch
  /// in a file, or empty; the lines between groups are kept. `regions`: as for MeshRun; known regions replace
  /// RemeshOptions::innerShells. The largest volume of a region caps the sizes of its own triangles, and sizes grow from
  /// there; the smaller one of both regions applies to an interface. `model`: numbers of the TrimmedModels whose faces the
  /// triangles approximate (see model/model_numbers.h), or empty. Their faces are then triangulated on their own surfaces, if
  /// they can be, the groups divide no face, and only the shape or one size decides the sizes.
  SurfaceRemesher(std::span<const double> points, std::span<const std::uint32_t> triangles,
                  std::span<const std::uint32_t> groups, BackgroundGrid grid,
                  const RemeshOptions& options, const GivenRegions& regions = {},
                  std::span<const double> model = {});
};

/// Sizes that a remeshing would use, and what results from them.
struct SurfaceSizeProposal {
  double size = 0.0;     ///< largest target size on the surface
  double minSize = 0.0;  ///< smallest target size on the surface
  double tolerance = 0.0;
  double triangles = 0.0;   ///< expected number of triangles
  double tetrahedra = 0.0;  ///< expected number of tetrahedra inside
  /// Not empty if the surface cannot be remeshed; all numbers are 0 then.
  std::vector<Diagnostic> diagnostics;
};

/// Finds the sizes of a remeshing without making it, in slices.
class SurfaceSizeProposer : public SlicedTool<SurfaceSizeProposal> {
 public:
  /// As SurfaceRemesher, without a background grid and largest volumes of regions.
  SurfaceSizeProposer(std::span<const double> points, std::span<const std::uint32_t> triangles,
                      std::span<const std::uint32_t> groups, const RemeshOptions& options,
                      std::span<const std::uint32_t> triangleRegions = {});
};

}  // namespace tetrafront
