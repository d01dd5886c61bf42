#pragma once

/// @file One remeshing: finds features and sizes of a surface, changes its triangles, and bounds the distance between both
/// surfaces. A remeshing that drops details takes several.

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_targets.h"
#include "tetrafront/remesh.h"
#include "topology/tracked_surface.h"

namespace tetrafront {

/// What one remeshing may do.
struct PassRules {
  double toleranceShare = 1.0;
  double plannedShare = 1.0;  ///< of the tolerance, for which sizes are small enough
  bool samples = true;        ///< whether the distance of the triangles is sampled
  /// Whether the surface is on the faces of a model. Settled nodes then stay, and none is moved to keep the volume.
  bool isOnFaces = false;
  /// Per node: 1 if all its triangles come from a remeshing and need no other one; empty if none do.
  std::vector<std::uint8_t> isSettled{};
};

struct RemeshPass {
  TrackedSurface surface;           ///< its patches are the smooth ones
  std::vector<TriangleId> beneath;  ///< per triangle: as `origin`, in the surface of this pass
  SurfaceRemesh remesh;             ///< what is known about the surface, without its arrays
};

[[nodiscard]] FeatureRules featureRulesOf(const RemeshOptions& options);

/// Measures the shapes of the triangles of a result.
void measureShapes(const SurfaceMesh& mesh, SurfaceRemesh& result);

/// Samples the distance of the triangles from a surface, until it is stopped. `beneath`: per triangle, one of that surface
/// near it.
Task<> sampleDeviation(Work& work, const ReferenceSurface& reference, const SurfaceMesh& made,
                       std::span<const TriangleId> beneath, const bool& isStopped,
                       SurfaceRemesh& result);

/// Remeshes a surface, with all details. If its triangles are far smaller than the target size, coarsens it first. The
/// distance of the result from it is at most a share of the tolerance, and sizes are planned for another one. Only triangles
/// around nodes that are not settled change. `reference`: the prepared one of the surface. Everything must outlive the task.
/// Once `isStopped` is true, the surface is returned as it is. Errors are in the diagnostics of the result.
Task<RemeshPass> remeshOnce(Work& work, const ReferenceSurface& reference,
                            const TrackedSurface& surface, const GivenSizes& sizes,
                            const RemeshOptions& options, const PassRules& rules,
                            const bool& isStopped);

}  // namespace tetrafront
