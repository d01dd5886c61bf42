#pragma once

/// @file Checks the shape of a patch with usable lines and closed loops.

#include <vector>

#include "model/check_plane.h"
#include "model/resolved_model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// Appends the problems found: no area, a fold, a line off the plane, loops that touch or lie
/// outside the first one. Returns true if the surface can be evaluated. `movedPoints` must be of
/// the same model.
bool checkPatchShape(const ResolvedModel& model, PatchId patch, MovedPointFinder& movedPoints,
                     std::vector<Diagnostic>& diagnostics);

}  // namespace tetrafront
