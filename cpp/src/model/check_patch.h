#pragma once

/// @file What can be wrong with the shape of a patch whose lines are sound and whose loops close.

#include <cstdint>
#include <vector>

#include "model/resolved_model.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// A patch of less area than this share of its squared extent has none.
inline constexpr double kLeastArea = 1e-9;

/// Lines of a planar patch may leave its plane by this share of the patch's extent: coordinates
/// typed with four digits pass. Nodes on such a line stay on the line, so nothing opens.
inline constexpr double kPlaneTolerance = 1e-4;

/// Appends what is wrong: no area, a fold, a line off the plane, loops that touch or lie outside
/// the first. Returns true if the surface can be evaluated.
bool checkPatchShape(const ResolvedModel& model, std::uint32_t patch,
                     std::vector<Diagnostic>& diagnostics);

}  // namespace tetrafront
