#pragma once

/// @file Plain input: the background grid (Löhner & Parikh 1988, section 3).

#include <array>
#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// The generation parameters at one node of the background grid.
struct BackgroundNode {
  Vec3 position{0.0};
  double size = 0.0;              ///< wanted edge length across the stretching direction, > 0
  double stretching = 1.0;        ///< wanted length along `direction` divided by `size`, >= 1
  Vec3 direction{1.0, 0.0, 0.0};  ///< stretching direction; unit length is not required
};

/// Tetrahedra, in any orientation, that together cover the domain to be meshed.
struct BackgroundGrid {
  std::vector<BackgroundNode> nodes;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;  ///< positions in `nodes`
};

}  // namespace tetrafront
