#pragma once

/// @file Checks the holes of a curved patch whose surface is valid.

#include <optional>

#include "model/patch_surface.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Largest distance of a hole's lines from the patch, relative to the hole's extent. Splines and
/// parabolas through points on a patch leave it by some per cent between the points. Nodes on such
/// a line stay on the line, so the surface remains closed. With larger distances, the triangles
/// around the hole would differ visibly from the drawn patch.
inline constexpr double kHoleTolerance = 0.05;

/// Returns the first defect found: a line or point used twice, a hole off the patch, loops that
/// touch, a hole outside the outer loop or inside another hole. `surface` is the surface of the
/// patch, which is curved.
[[nodiscard]] std::optional<Diagnostic> findHoleDefect(const ResolvedModel& model, PatchId patch,
                                                       const PatchSurface& surface);

}  // namespace tetrafront
