#pragma once

/// @file Target sizes that follow from the shape of a surface: curvature, thickness, gaps between feature lines, and
/// short lines.

#include <vector>

#include "base/task.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct ShapeSizeRules {
  double maxSize = 0.0;
  double minSize = 0.0;
  double tolerance = 0.0;     ///< edges on curved patches deviate by no more
  double anglePerEdge = 0.0;  ///< largest angle that an edge spans, in radians
  double layers = 0.0;        ///< elements across thin walls; 0: thickness does not count
};

/// Positions where the shape asks for less than the largest size.
struct ShapeSizes {
  std::vector<Vec3> positions;
  std::vector<double> sizes;
};

/// O(n log n) for n triangles, unless very many feature lines are close to each other.
Task<ShapeSizes> findShapeSizes(Work& work, const ReferenceSurface& reference,
                                const ShapeSizeRules& rules);

}  // namespace tetrafront
