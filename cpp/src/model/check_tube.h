#pragma once

/// @file Checks whether the rims of a tube span a surface.

#include <optional>

#include "base/tolerance.h"
#include "model/resolved_model.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

struct TubeDefect {
  bool isContact = false;  ///< the rims touch
  Vec3 position{0.0};
};

/// Returns the first defect found in samples of a tube with two closed loops: rims that touch, no
/// area, or a fold. Lines may meet at any angle. `tolerance` is relative to the patch.
[[nodiscard]] std::optional<TubeDefect> findTubeDefect(const ResolvedModel& model,
                                                       const Patch& patch,
                                                       const Tolerance& tolerance);

}  // namespace tetrafront
