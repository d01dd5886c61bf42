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

/// A normal shorter than this, relative to the longest, belongs to a degenerate corner and has no
/// direction.
inline constexpr double kMinNormal = 1e-6;

/// Returns the normal of a surface, of the length of its area per area of the domain.
[[nodiscard]] Vec3 normalOf(const UnitSurface& surface, const Vec2& unit);

/// Finds where the normal changes by more than 90 degrees between two parameters; nothing if the
/// change is below 90 degrees when they are close enough. Normals shorter than `leastNormal` have no
/// direction.
[[nodiscard]] std::optional<Vec2> findFoldBetween(const UnitSurface& surface, Vec2 from, Vec2 to,
                                                  double leastNormal);

struct SurfaceDefect {
  bool hasNoArea;  ///< no area; otherwise it folds
  Vec3 position;
};

/// Returns the first defect found; `tolerance` is relative to the patch.
[[nodiscard]] std::optional<SurfaceDefect> findSurfaceDefect(const UnitSurface& surface,
                                                             SmoothCorners corners,
                                                             const Tolerance& tolerance);

}  // namespace tetrafront
