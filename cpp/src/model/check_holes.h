#pragma once

/// @file What can be wrong with the holes of a curved patch whose surface is sound.

#include <cstdint>
#include <optional>

#include "model/patch_surface.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// The lines of a hole may leave the patch by this share of the hole's extent. Splines and parabolas
/// through points on a patch leave it by some per cent between the points, and nodes on such a line
/// stay on the line, so that nothing opens; farther away, the triangles around the hole would not be
/// the patch the user sees.
inline constexpr double kHoleTolerance = 0.05;

/// The first fault found: a line or point that the patch passes twice, a hole off the patch, loops
/// that touch, a hole outside the outer loop or in another. `surface` is the patch's, curved.
[[nodiscard]] std::optional<Diagnostic> findHoleFault(const ResolvedModel& model,
                                                      std::uint32_t patch,
                                                      const PatchSurface& surface);

}  // namespace tetrafront
