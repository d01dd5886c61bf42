#pragma once

/// @file The mesher of regions as a stage that records its steps.

#include "volume/volume_stage.h"

namespace tetrafront {

[[nodiscard]] std::unique_ptr<VolumeStage> makeRecordedStage(const SurfaceMesh& boundary,
                                                             const SizeField& field,
                                                             const MeshOptions& options,
                                                             StepRecorder& recorder,
                                                             const FrontExperiment& experiment);

}  // namespace tetrafront
