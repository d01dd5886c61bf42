#pragma once

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Position and the two tangents of a surface at a place of its parameter plane.
struct SurfacePoint {
  Vec3 position{0.0};
  Vec3 alongXi{0.0};   ///< derivative by the first coordinate
  Vec3 alongEta{0.0};  ///< derivative by the second
};

}  // namespace tetrafront
