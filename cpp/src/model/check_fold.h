#pragma once

/// @file Does a curved patch fold over itself? By the turns of its normal on a grid of its domain.

#include <cstdint>
#include <optional>

#include "model/unit_surface.h"

namespace tetrafront {

/// Two lines of a transfinite patch may meet smoothly at a corner, where the normal then vanishes
/// or, for lines a little off, points the other way; that does no harm. The shape functions of an
/// isoparametric patch fold from a corner on where a mid-point is too near.
enum class SmoothCorners : std::uint8_t { kAllowed, kFold };

struct SurfaceDefect {
  bool hasNoArea;  ///< otherwise it folds
  Vec3 place;
};

/// The first fault found; `extent` is the patch's size.
[[nodiscard]] std::optional<SurfaceDefect> findSurfaceFault(const UnitSurface& surface,
                                                            SmoothCorners corners, double extent);

}  // namespace tetrafront
