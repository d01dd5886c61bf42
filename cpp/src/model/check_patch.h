#pragma once

/// @file What can be wrong with the shape of a patch whose lines are sound and whose loops close.

#include <cstdint>
#include <vector>

#include "model/check_plane.h"
#include "model/resolved_model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// A patch of less area than this share of its squared extent has none.
inline constexpr double kMinArea = 1e-9;

/// Appends what is wrong: no area, a fold, a line off the plane, loops that touch or lie outside
/// the first. Returns true if the surface can be evaluated. `movedPoints` is of the same model.
bool checkPatchShape(const ResolvedModel& model, std::uint32_t patch, MovedPointFinder& movedPoints,
                     std::vector<Diagnostic>& diagnostics);

}  // namespace tetrafront
