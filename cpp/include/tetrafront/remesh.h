#pragma once

/// @file Remeshes a given surface: triangles of a target size and good shape, within a tolerance of the given ones.

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Options of a remeshing. The defaults suit any part: sizes follow from curvature, thickness and gaps.
struct RemeshOptions {
  /// Target edge length, in model units, > 0; 0: automatic. Sources and a background grid cap it.
  double size = 0.0;
  double minSize = 0.0;  ///< least size that the shape may ask for; 0: automatic
  double maxSize = 0.0;  ///< largest automatic size; 0: a twentieth of the surface's diagonal
  /// Largest distance between the surfaces, both ways, in model units; 0: a thousandth of the diagonal, and no more
  /// than a twentieth of `size`.
  double tolerance = 0.0;
  double featureAngle =
      40.0;  ///< edges with a larger angle between their triangles stay sharp; degrees
  double anglePerEdge = 20.0;  ///< largest angle that an edge may span on a curved patch; degrees
  double layers = 1.0;         ///< elements across thin walls; 0: thickness does not count
  double growth = 0.3;         ///< growth of sizes per unit of distance, 0 to kMaxGrowth
  InnerShells innerShells = InnerShells::kCavities;
};

/// Result of a remeshing.
struct SurfaceRemesh {
  std::vector<double> points;
  std::vector<std::uint32_t> triangles;
  /// Per triangle: a given triangle in the same smooth patch, near it.
  std::vector<std::uint32_t> origin;
  double size = 0.0;       ///< largest target size used
  double minSize = 0.0;    ///< least target size used
  double tolerance = 0.0;  ///< tolerance used
  /// Upper bound of the distance between the surfaces, both ways.
  double deviation = 0.0;
  std::uint32_t patches = 0;       ///< smooth patches of the given surface
  std::uint32_t featureLines = 0;  ///< feature lines of the given surface
  double smallestAngle = 0.0;      ///< of all triangles, in degrees
  double meanRadiusRatio = 0.0;    ///< of all triangles
  /// Not empty if the surface cannot be remeshed: it is not a valid boundary, or an option is out of range.
  std::vector<Diagnostic> diagnostics;
};

/// Remeshes a surface in slices. Every change keeps the surface closed and free of self-intersections (exact), within
/// the tolerance, with its feature lines, corners and groups. A unit of work is about one change. About linear in the
/// triangles given and made.
class SurfaceRemesher : public SlicedTool<SurfaceRemesh> {
 public:
  /// Arrays as for MeshRun; they are copied. `groups`: a number per triangle, for example its patch in a file; edges
  /// between groups are kept. Empty if there are none.
  SurfaceRemesher(std::span<const double> points, std::span<const std::uint32_t> triangles,
                  std::span<const std::uint32_t> groups, BackgroundGrid grid,
                  const RemeshOptions& options);
};

}  // namespace tetrafront
