#pragma once

/// @file One remeshing: finds features and sizes of a surface, changes its triangles, and bounds the distance between both
/// surfaces. A remeshing that drops details takes several.

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "remesh/reference_surface.h"
#include "remesh/remesh_targets.h"
#include "tetrafront/mesh.h"
#include "tetrafront/remesh.h"

namespace tetrafront {

/// A valid boundary that is to be remeshed: the given surface, or what earlier steps made of it.
struct PassSurface {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> groups;  ///< per triangle: its patch; empty if there is only one
  std::vector<std::uint32_t> origin;  ///< per triangle: the given one
  /// Per node: 1 if all its triangles come from a remeshing and need no other one; empty if none do.
  std::vector<std::uint8_t> isSettled;
  Vec3 centre{0.0};  ///< the nodes are relative to it
};

/// What one remeshing may do.
struct PassRules {
  double toleranceShare = 1.0;
  double plannedShare = 1.0;  ///< of the tolerance, for which sizes are small enough
  bool samples = true;        ///< whether the distance of the triangles is sampled
};

struct RemeshPass {
  SurfaceRemesh remesh;                ///< `origin` refers to the given triangles
  std::vector<std::uint32_t> patches;  ///< per triangle: its smooth patch
  std::vector<std::uint32_t> beneath;  ///< per triangle: as `origin`, in the surface of this pass
};

/// Returns a remeshed surface as the next one to be remeshed, with the feature lines that it has.
[[nodiscard]] PassSurface nextSurface(const RemeshPass& pass, const Vec3& centre);

[[nodiscard]] FeatureRules featureRulesOf(const RemeshOptions& options);

/// Samples the distance of the triangles from a surface, until it is stopped. `beneath`: per triangle, one of that surface
/// near it.
Task<> sampleDeviation(Work& work, const ReferenceSurface& reference,
                       std::span<const std::uint32_t> beneath, const bool& isStopped,
                       SurfaceRemesh& result);

/// Remeshes a surface, with all details. If its triangles are far smaller than the target size, coarsens it first. The
/// distance of the result from it is at most a share of the tolerance, and sizes are planned for another one. Only triangles
/// around nodes that are not settled change. Everything must outlive the task. Once `isStopped` is true, the surface is
/// returned as it is. Errors are in the diagnostics of the result.
Task<RemeshPass> remeshOnce(Work& work, const PassSurface& surface, const GivenSizes& sizes,
                            const RemeshOptions& options, const PassRules& rules,
                            const bool& isStopped);

}  // namespace tetrafront
