#pragma once

/// @file Checks whether a curved patch folds, by the changes of its normal on a grid of its domain.

#include <cstdint>
#include <optional>

#include "base/tolerance.h"
#include "model/unit_surface.h"

namespace tetrafront {

/// Two lines of a transfinite patch may meet smoothly at a corner. The normal then vanishes there
/// or, if the lines are slightly off, is reversed, which is harmless. The shape functions of an
/// isoparametric patch fold from a corner on if a mid-point is too close.
enum class SmoothCorners : std::uint8_t { kAllowed, kFold };

struct SurfaceDefect {
  bool hasNoArea;  ///< no area; otherwise it folds
  Vec3 position;
};

/// Returns the first defect found; `tolerance` is relative to the patch.
[[nodiscard]] std::optional<SurfaceDefect> findSurfaceDefect(const UnitSurface& surface,
                                                             SmoothCorners corners,
                                                             const Tolerance& tolerance);

}  // namespace tetrafront
