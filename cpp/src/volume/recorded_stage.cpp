#include "volume/recorded_stage.h"

#include "volume/region_mesher.h"

namespace tetrafront {

std::unique_ptr<VolumeStage> makeRecordedStage(const SurfaceMesh& boundary, const SizeField& field,
                                               const MeshOptions& options, StepRecorder& recorder,
                                               const FrontExperiment& experiment) {
  return std::make_unique<BasicRegionMesher<RecordingTrace>>(boundary, field, options,
                                                             RecordingTrace{&recorder, experiment});
}

}  // namespace tetrafront
