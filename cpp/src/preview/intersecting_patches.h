#pragma once

/// @file Finds patches that intersect other than along the lines that they share, before anything is meshed.

#include <vector>

#include "preview/surface_sampler.h"

namespace tetrafront {

/// Returns one diagnostic with a position per pair of patches (kPatchesIntersect), and per patch that intersects itself
/// (kSelfIntersection). The triangles of the sampled patches are tested exactly; their nodes tell what they share. An
/// intersection of curved patches is reported only if it persists when they are sampled more finely, so patches that
/// are merely close are not reported. Intersections smaller than the samples are left to the check of the mesh. Skips
/// patches whose border does not consist of the nodes of its lines. Stops after 1000 diagnostics, or when it has
/// compared far more pairs of triangles than a sensible model needs. Nearly O(triangles) unless many patches are close
/// to many others.
[[nodiscard]] std::vector<Diagnostic> findIntersectingPatches(const Model& model,
                                                              const CheckedModel& found,
                                                              const SampledModel& sampled);

}  // namespace tetrafront
