#pragma once

/// @file Target sizes that follow from the shape of a surface: curvature, thickness, gaps between
/// feature lines, and short lines. They are for a closed surface that may be rough; those of a drawn model, whose patches need
/// not be closed, follow from its samples (preview/size_proposals.cpp).

#include <cstddef>
#include <vector>

#include "base/task.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct ShapeSizeRules {
  double maxSize = 0.0;
  double minSize = 0.0;
  double minSizeAtLines = 0.0;  ///< at feature lines shorter than minSize
  double minSizeAtGaps = 0.0;   ///< at gaps between feature lines that are narrower than minSize
  double minSizeAtThinPlaces = 0.0;  ///< where the thickness is far below minSize
  double tolerance = 0.0;            ///< largest deviation of an edge from a curved patch
  double anglePerEdge = 0.0;         ///< largest angle that an edge spans, in radians
  double layers =
      0.0;  ///< elements across the thickness of thin parts; 0: thickness has no influence
  double detailFactor = 1.0;  ///< on the sizes at gaps between feature lines and at short lines
};

/// A position where the region is so thin that one good layer needs a size below the smallest one.
struct ThinPlace {
  std::size_t index;  ///< in ShapeSizes
  double coarse;      ///< size if one good layer would need too many triangles
};

/// Positions at which the shape requires a size below the largest one.
struct ShapeSizes {
  std::vector<Vec3> positions;
  std::vector<double> sizes;
  /// Per position: a unit vector along which the size is not limited, because the surface or the line does not bend around
  /// any other axis; zero if it is limited in all directions.
  std::vector<Vec3> axes;
  /// The first positions do not depend on gaps between feature lines; the others follow from gaps.
  std::size_t countWithoutGaps = 0;
  std::size_t countBelowMin = 0;      ///< sizes below minSize
  std::vector<ThinPlace> thinPlaces;  ///< ascending
};

/// Measures the shape. O(n log n) for n triangles, unless very many feature lines are close to each
/// other.
Task<ShapeSizes> findShapeSizes(Work& work, const ReferenceSurface& reference,
                                const ShapeSizeRules& rules);

}  // namespace tetrafront
