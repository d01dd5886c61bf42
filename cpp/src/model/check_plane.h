#pragma once

/// @file Which points keep a planar patch from being one.

#include <cstdint>
#include <vector>

#include "tetrafront/model.h"

namespace tetrafront {

/// Points off the plane that most points of a patch's lines agree on.
struct MovedPoints {
  std::vector<std::uint32_t> points;  ///< the farthest first; empty if most agree on no plane
  double distance = 0.0;              ///< of the first, from that plane
};

/// Of several planes as good, as four points always have, one is taken whose points belong to most
/// patches that are not plane, then one along the axes. `patch` must refer to points that exist,
/// other patches need not. O(model), and O(n log n) in the points of the patch.
[[nodiscard]] MovedPoints findMovedPoints(const Model& model, const Patch& patch, double tolerance);

}  // namespace tetrafront
