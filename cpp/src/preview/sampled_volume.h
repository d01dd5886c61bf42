#pragma once

/// @file The volume that a sampled model encloses, and how its regions are nested.

#include <optional>
#include <vector>

#include "model/check_closure.h"
#include "preview/surface_sampler.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"

namespace tetrafront {

struct SampledVolume {
  /// The samples with shared nodes; oriented outward, or inward as a whole. Empty unless the volume is known.
  SurfaceMesh boundary;
  std::optional<double> volume;  ///< enclosed; nothing if the samples do not form a closed surface
  std::vector<Diagnostic> diagnostics;
};

/// Takes the sampled patches as one surface, oriented outward. A single region only needs its patches oriented; several
/// are nested by the same check as meshes. The samples are too coarse to report intersections.
[[nodiscard]] SampledVolume findSampledVolume(const Model& model, const SampledModel& sampled,
                                              const Closure& closure, InnerShells enclosed);

}  // namespace tetrafront
