#pragma once

/// @file What became of the triangles of a surface that was replaced by the boundary of what it encloses.

#include <span>
#include <vector>

#include "arrangement/enclosed_surface.h"
#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {

/// Returns the triangles of `mesh` that were cut, divided, flipped or left out; `enclosed` may come from more triangles, which closed
/// its holes. `origin`: per triangle of both, the given one; none if it closes a hole. O(n).
std::vector<RepairChange> resolvedChanges(const SurfaceMesh& mesh,
                                          std::span<const TriangleId> origin,
                                          const EnclosedSurface& enclosed);

}  // namespace tetrafront
