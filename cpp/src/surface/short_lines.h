#pragma once

/// @file Lines that are much shorter than the sides next to them, as at a chamfer or a small step. Sides of the target
/// size would cause triangles with small angles there, so the sizes are made to grow gradually from such a line.

#include <span>
#include <vector>

#include "model/resolved_model.h"
#include "surface/line_mesher.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// Returns a source for each divided line whose sides are much shorter, in target sizes, than those of a line with
/// which it has an end point in common. Lines that are not divided have no sides. O(lines).
[[nodiscard]] std::vector<SizeSource> sourcesAtShortLines(const ResolvedModel& model,
                                                          std::span<const LineDivision> divisions);

}  // namespace tetrafront
