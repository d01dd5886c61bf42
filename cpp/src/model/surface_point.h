#pragma once

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Position and tangents of a surface at one point of its parameter plane.
struct SurfacePoint {
  Vec3 position{0.0};
  Vec3 alongXi{0.0};   ///< derivative with respect to the first coordinate
  Vec3 alongEta{0.0};  ///< derivative with respect to the second coordinate
};

}  // namespace tetrafront
