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

/// Everything must outlive the task, which moves `mesh` and `groups` away. Once `isStopped` is true, the surface is returned as
/// it is. `model`: as for SurfaceRemesher.
Task<SurfaceRemesh> remeshSurface(Work& work, SurfaceMesh& mesh, std::vector<std::uint32_t>& groups,
                                  GivenSizes sizes, const RemeshOptions& options,
                                  const bool& isStopped, std::span<const double> model = {});

/// Proposes sizes for the surface. Everything must outlive the task, which may reorient triangles of `mesh` and moves `groups`
/// into it.
Task<SurfaceSizeProposal> proposeSurfaceSizes(Work& work, SurfaceMesh& mesh,
                                              std::vector<std::uint32_t>& groups,
                                              const RemeshOptions& options);

}  // namespace tetrafront
