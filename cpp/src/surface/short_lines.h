#pragma once

/// @file Lines much shorter than the sides beside them, as at a chamfer or a small step. Sides as long
/// as the field asks would leave triangles of small angles there: sizes grow from such a line instead.

#include <span>
#include <vector>

#include "model/resolved_model.h"
#include "surface/line_mesher.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// A source for each divided line whose sides are much shorter, in wanted sizes, than those of a line
/// it meets at an end. Lines that are not divided have no sides. O(lines).
[[nodiscard]] std::vector<SizeSource> sourcesAtShortLines(const ResolvedModel& model,
                                                          std::span<const LineDivision> divisions);

}  // namespace tetrafront
