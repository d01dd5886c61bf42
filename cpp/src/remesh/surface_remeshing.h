#pragma once

/// @file Remeshes a surface: checks it, finds its features and sizes, changes its triangles, and
/// bounds the distance between the two surfaces.

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "remesh/remesh_targets.h"
#include "tetrafront/mesh.h"
#include "tetrafront/remesh.h"

namespace tetrafront {

/// Everything must outlive the task. May reorient triangles of `mesh`, and changes `mesh` and `groups` if details are
/// dropped. Once `isStopped` is true, the surface is returned as it is.
Task<SurfaceRemesh> remeshSurface(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                  GivenSizes sizes, const RemeshOptions& options,
                                  const bool& isStopped);

/// Proposes sizes for the surface. May reorient triangles of `mesh`. Everything must outlive the task.
Task<SurfaceSizeProposal> proposeSurfaceSizes(Work& work, SurfaceMesh& mesh,
                                              std::span<const std::uint32_t> groups,
                                              const RemeshOptions& options);

}  // namespace tetrafront
