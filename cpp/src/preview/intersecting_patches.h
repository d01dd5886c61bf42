#pragma once

/// @file Patches that overlap or cross away from the lines they share, found before anything is
/// meshed.

#include <vector>

#include "preview/model_sampling.h"

namespace tetrafront {

/// One diagnostic per pair of patches (kPatchesIntersect), or per patch that cuts itself
/// (kSelfIntersection), with a place. Triangles of the sampled patches are tested exactly, and told
/// by their nodes what they share; where bent patches are concerned, a finding must persist as they
/// are sampled more and more finely, so that patches that only come near each other are not
/// accused. What is finer than the samples is left to the check of the mesh. Patches that are not
/// joined to their lines are passed over, and no more is looked for after a thousand findings, or
/// once as many pairs of triangles have been compared as no sensible model has. Near-linear in the
/// triangles, unless many patches are near many others.
[[nodiscard]] std::vector<Diagnostic> findIntersectingPatches(const Model& model,
                                                              const CheckedModel& found,
                                                              const SampledModel& sampled);

}  // namespace tetrafront
