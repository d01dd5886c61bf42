/// @file The public functions of a run.

#include "mesh_run.h"

#include "optimize/sweep_recorder.h"
#include "tetrafront/trace.h"
#include "volume/recorded_front.h"

namespace tetrafront {

MeshRun::MeshRun(Model model, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(grid), options)) {}

MeshRun::MeshRun(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(bodies), std::move(grid), options)) {
}

MeshRun::MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 const MeshOptions& options)
    : MeshRun(points, triangles, BackgroundGrid{}, options) {}

MeshRun::MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 BackgroundGrid grid, const MeshOptions& options)
    : MeshRun(points, triangles, GivenRegions{}, std::move(grid), options) {}

MeshRun::MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 GivenRegions regions, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, std::move(regions), std::move(grid),
                                   options)) {}

MeshRun::MeshRun(MeshRun&&) noexcept = default;
MeshRun& MeshRun::operator=(MeshRun&&) noexcept = default;
MeshRun::~MeshRun() = default;

MeshStatus MeshRun::advance(std::uint32_t budget) { return impl_->advance(budget); }
void MeshRun::cancel() { impl_->cancel(); }
void MeshRun::endBeforeFront() { impl_->endBeforeFront(); }
MeshStatus MeshRun::status() const { return impl_->status(); }
Progress MeshRun::progress() const { return impl_->progress(); }
const std::vector<Diagnostic>& MeshRun::diagnostics() const { return impl_->diagnostics(); }
const SurfaceMesh& MeshRun::surface() const { return impl_->surface(); }
const VolumeMesh& MeshRun::volume() const { return impl_->volume(); }
std::uint32_t MeshRun::nodeCount() const { return impl_->view().nodeCount(); }
std::uint32_t MeshRun::tetrahedronCount() const { return impl_->view().elementCount(); }
std::vector<double> MeshRun::points(std::uint32_t first, std::uint32_t last) const {
  return pointsOf(impl_->view(), first, last);
}
std::vector<std::uint32_t> MeshRun::tetrahedra(std::uint32_t first, std::uint32_t last) const {
  return elementsOf(impl_->view(), first, last);
}
std::vector<std::uint32_t> MeshRun::regionRuns() const { return regionRunsOf(impl_->view()); }
std::vector<double> MeshRun::front() const { return impl_->front(); }
const std::vector<PatchSummary>& MeshRun::patchSummaries() const { return impl_->patchSummaries(); }
QualitySummary MeshRun::quality() const { return impl_->quality(); }
QualityStatistics MeshRun::statistics() const { return impl_->statistics(); }
MetricShapes MeshRun::metricShapes() const { return impl_->metricShapes(); }
RecoverySummary MeshRun::recovery() const { return impl_->recovery(); }
FrontCounters MeshRun::counters() const { return impl_->counters(); }
std::uint32_t MeshRun::latticeCount() const { return impl_->latticeCount(); }
bool MeshRun::hasFoundNothingBetter() const { return impl_->hasFoundNothingBetter(); }
std::uint64_t MeshRun::fingerprint() const { return impl_->fingerprint(); }
std::vector<std::uint8_t> MeshRun::takeTrace() { return impl_->takeTrace(); }
std::uint64_t MeshRun::recordedSteps() const { return impl_->recordedSteps(); }
std::uint64_t MeshRun::frontFingerprint() const { return impl_->frontFingerprint(); }

void recordFront(MeshRun& run, const FrontExperiment& experiment) {
  run.impl_->record(std::make_unique<RecordingFrontMaker>(run.impl_->recorder(), experiment),
                    makeSweepRecorder);
}

}  // namespace tetrafront
