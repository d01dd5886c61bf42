#pragma once

/// @file The lengths and the size field of a remeshing, with all automatic values replaced.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/task.h"
#include "remesh/automatic_sizes.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_sizes.h"
#include "sizing/region_sizes.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/options.h"
#include "tetrafront/remesh.h"
#include "tetrafront/status.h"

namespace tetrafront {

struct RemeshLengths {
  double maxSize;
  double minSize;
  double minSizeAtLines;
  double minSizeAtGaps;
  double minSizeAtThinPlaces;
  double tolerance;
  /// The checks of a change use this smaller tolerance. From the remeshed surface to the given one, they hold for every
  /// point. In the other direction they test the guests only, and between them the distance may be slightly larger.
  double testedTolerance;
  double plannedTolerance;  ///< deviation that sizes aim at
  double radiansPerEdge;
  double layers;
  double detailFactor;  ///< as ShapeSizeRules::detailFactor
};

/// `hasTargets`: a size or a background grid is given. `diagonal`: of the surface. `plannedShare`: of the tolerance, for which
/// sizes are small enough.
[[nodiscard]] RemeshLengths remeshLengthsOf(const RemeshOptions& options, bool hasTargets,
                                            double diagonal, double plannedShare = 1.0);

/// Returns the tolerance of a surface with this diagonal, if none is given.
[[nodiscard]] double automaticTolerance(const RemeshOptions& options, bool hasTargets,
                                        double diagonal);

/// Returns the options of the given sizes.
[[nodiscard]] MeshOptions targetOptions(const RemeshOptions& options);

/// Returns the number of triangles of one size that cover an area.
[[nodiscard]] double trianglesOn(double area, double size);

/// Given sizes besides those of the options; both must outlive this.
struct GivenSizes {
  const BackgroundGrid& grid;
  const RegionSizes& ofRegions;  ///< per given triangle
};

struct TargetField {
  std::optional<RemeshSizes> sizes;
  /// The sizes that the shape asks for, from which `sizes` grow.
  ShapeSizes ofShape;
  std::vector<Diagnostic> diagnostics;  ///< not empty if the grid or the sizes cannot be used
};

/// Makes the size field: given sizes, capped by those of the shape. Too many triangles are refused as soon as the sizes
/// are known: work on the shape takes longer if they are small. `origin`: per triangle of the reference surface, the given
/// one. Everything must outlive the task.
Task<TargetField> findTargetField(Work& work, const ReferenceSurface& reference,
                                  std::span<const TriangleId> origin, const GivenSizes& sizes,
                                  const RemeshOptions& options, const RemeshLengths& lengths);

/// Names the region whose size applies to each smooth patch of a surface, if regions have sizes. `origin`: as for
/// findTargetField(). O(n).
void setRegions(RemeshSizes& sizes, const ReferenceSurface& reference,
                std::span<const TriangleId> origin, const RegionSizes& ofRegions);

}  // namespace tetrafront
