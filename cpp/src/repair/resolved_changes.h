#pragma once

/// @file What became of the triangles of a surface that was replaced by the boundary of what it encloses.

#include <vector>

#include "arrangement/enclosed_surface.h"
#include "tetrafront/surface_tools.h"
#include "topology/tracked_surface.h"

namespace tetrafront {

/// Returns the triangles of `surface` that were cut, divided, flipped or left out, except those that close a hole. `enclosed` may
/// come from more triangles, which follow them. O(n).
std::vector<RepairChange> resolvedChanges(const TrackedSurface& surface,
                                          const EnclosedSurface& enclosed);

}  // namespace tetrafront
