#pragma once

/// @file The state of a run: the result of each stage, and the stage that is running. mesher.cpp has the stages.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/fingerprint.h"
#include "base/task.h"
#include "field/size_field.h"
#include "optimize/optimizer.h"
#include "optimize/sweep_observer.h"
#include "optimize/tile_lender.h"
#include "optimize/tile_runner.h"
#include "optimize/volume_limiter.h"
#include "quality/metrics.h"
#include "surface/surface_trace.h"
#include "tetrafront/mesher.h"
#include "topology/mesh_access.h"
#include "topology/mesh_view.h"
#include "topology/region_meshes.h"
#include "volume/region_mesher.h"

namespace tetrafront {

/// Runs the stages one after the other. Each stage keeps its result in a member and frees its own memory.
class MeshRun::Impl {
 public:
  Impl(Model model, BackgroundGrid grid, const MeshOptions& options)
      : options_(options), model_(std::move(model)), grid_(std::move(grid)) {}

  Impl(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options)
      : options_(options), bodies_(std::move(bodies)), grid_(std::move(grid)) {
    if (!model.patches.empty()) {
      model_ = std::move(model);
    } else {
      addBodies();
    }
  }

  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       GivenRegions regions, BackgroundGrid grid, const MeshOptions& options)
      : options_(options), maxVolumes_(std::move(regions.maxVolumes)), grid_(std::move(grid)) {
    surface_.points.assign(points.begin(), points.end());
    surface_.triangles.assign(triangles.begin(), triangles.end());
    surface_.triangleRegions = std::move(regions.triangleRegions);
  }

  MeshStatus advance(std::uint32_t budget) {
    if (status_ != MeshStatus::kRunning) return status_;
    snapshot_ = {};
    const bool isFinished = job_->advance(budget);
    if (isFinished) status_ = job_->take();
    // A run that fails keeps its progress.
    if (!isFinished || status_ == MeshStatus::kDone) fraction_ = job_->fraction();
    if (isFinished) end();
    return status_;
  }

  void cancel() {
    if (status_ != MeshStatus::kRunning) return;
    status_ = MeshStatus::kCancelled;
    if (records_ && front_) recorder_.endPass();
    end();
  }

  void endBeforeFront() { endsBeforeFront_ = true; }

  [[nodiscard]] MeshStatus status() const { return status_; }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const SurfaceMesh& surface() const { return surface_; }
  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const { return patches_; }

  [[nodiscard]] const VolumeMesh& volume() const {
    if (front_) return snapshotOf(front_->meshes());
    if (optimizer_) return snapshotOf(withRegion(optimizer_->mesh()));
    if (limiter_) return snapshotOf(withRegion(limiter_->mesh()));
    if (!meshes_.regions.empty()) return snapshotOf(meshes_);
    if (result_.parts.empty()) return result_.kept;
    if (snapshot_.points.empty()) snapshot_ = toVolumeMesh(MeshView(result_));
    return snapshot_;
  }
  /// Returns the mesh without making arrays of it if the run has ended.
  [[nodiscard]] MeshView view() const {
    const bool hasEnded = !front_ && !optimizer_ && !limiter_ && meshes_.regions.empty();
    return hasEnded ? MeshView(result_) : MeshView(volume());
  }

  [[nodiscard]] std::vector<double> front() const {
    return front_ ? front_->frontCorners() : std::vector<double>{};
  }

  [[nodiscard]] QualitySummary quality() const {
    return status_ == MeshStatus::kDone ? quality_ : measureQuality(volume());
  }
  [[nodiscard]] const QualityStatistics& statistics() const { return statistics_; }
  [[nodiscard]] const MetricShapes& metricShapes() const { return metricShapes_; }
  [[nodiscard]] RecoverySummary recovery() const { return front_ ? front_->recovery() : recovery_; }
  [[nodiscard]] FrontCounters counters() const { return front_ ? front_->counters() : counters_; }

  [[nodiscard]] std::uint32_t latticeCount() const {
    return front_ ? front_->latticeCount() : latticeCount_;
  }

  [[nodiscard]] bool hasFoundNothingBetter() const { return hasFoundNothingBetter_; }

  [[nodiscard]] std::uint64_t fingerprint() const {
    constexpr std::size_t kBlock = 4096;
    const MeshView mesh = view();
    Fingerprint fingerprint;
    for (std::size_t first = 0; first < mesh.nodeCount(); first += kBlock) {
      fingerprint.add(pointsOf(mesh, first, first + kBlock));
    }
    for (std::size_t first = 0; first < mesh.elementCount(); first += kBlock) {
      fingerprint.add(elementsOf(mesh, first, first + kBlock));
    }
    return fingerprint.value();
  }

  /// Records the steps of a run that has not begun. Only callers of this function need the code that records.
  void record(std::unique_ptr<FrontMaker> maker, MakeSweepObserver observe) {
    frontMaker_ = std::move(maker);
    makeObserver_ = observe;
    meshSurface_ = &Impl::meshSurface<RecordingSurfaceTrace>;
    records_ = true;
  }
  void runTilesBy(std::unique_ptr<TileRunner> runner) { tileRunner_ = std::move(runner); }
  [[nodiscard]] TileLender& lender() { return lender_; }
  [[nodiscard]] const TileLender& lender() const { return lender_; }
  [[nodiscard]] std::vector<std::uint8_t> takeTrace() { return recorder_.takeEvents(); }
  [[nodiscard]] StepRecorder& recorder() { return recorder_; }
  [[nodiscard]] std::uint64_t recordedSteps() const { return recorder_.counts().steps; }
  [[nodiscard]] std::uint64_t frontFingerprint() const { return frontFingerprint_; }

  [[nodiscard]] Progress progress() const {
    Progress progress;
    progress.phase = phase_;
    progress.fraction = fraction_;
    progress.expectedTetrahedra = expectedTetrahedra_;
    progress.triangles = static_cast<std::uint32_t>(surface_.triangles.size() / 3);
    progress.nodes = static_cast<std::uint32_t>(surface_.points.size() / 3);
    const auto count = [&](std::size_t nodes, std::size_t tetrahedra, std::size_t frontFaces) {
      progress.nodes = static_cast<std::uint32_t>(nodes);
      progress.tetrahedra = static_cast<std::uint32_t>(tetrahedra);
      progress.frontFaces = static_cast<std::uint32_t>(frontFaces);
    };
    // The region that is worked on is not among the meshes meanwhile.
    const auto addRegion = [&](std::size_t nodes, std::size_t tetrahedra) {
      progress.nodes += static_cast<std::uint32_t>(nodes);
      progress.tetrahedra += static_cast<std::uint32_t>(tetrahedra);
    };
    if (front_) {
      count(front_->nodeCount(), front_->tetrahedronCount(), front_->frontFaceCount());
      progress.exactFillFraction = front_->exactFillFraction();
    } else if (!meshes_.regions.empty()) {
      count(meshes_.nodeCount(), meshes_.tetrahedronCount(), meshes_.frontFaceCount());
      if (optimizer_) addRegion(optimizer_->innerNodeCount(), optimizer_->tetrahedronCount());
      if (limiter_) addRegion(limiter_->innerNodeCount(), limiter_->tetrahedronCount());
    } else if (!result_.kept.points.empty()) {
      const MeshView mesh(result_);
      count(mesh.nodeCount(), mesh.elementCount(), mesh.front().size() / 3);
    }
    return progress;
  }

 private:
  Task<MeshStatus> run(Work& work);
  void begin(Work& work, Phase phase, double end);

  // The stages. Those that return a boolean return false if the input is invalid.
  Task<bool> checkInput(Work& work);
  template <class Trace>
  Task<bool> meshSurface(Work& work);
  Task<bool> checkBoundary(Work& work);
  Task<bool> findSizes(Work& work);
  void addBodies();
  void summarizeBodies();
  bool limitElements();
  [[nodiscard]] double frontShare() const;
  [[nodiscard]] Interior interior() const;
  Task<MeshStatus> fill(Work& work);
  Task<> optimize(Work& work);
  Task<bool> limitVolumes(Work& work);
  [[nodiscard]] double maxVolumeOf(std::size_t region) const;
  [[nodiscard]] double neededElements(std::size_t region) const;
  void reportLimits(std::size_t before, double others);
  [[nodiscard]] TileRunner& tileRunner() { return tileRunner_ ? *tileRunner_ : lender_; }
  [[nodiscard]] RegionMesh& region() { return meshes_.regions[region_]; }
  [[nodiscard]] RegionMeshes withRegion(TetMesh mesh) const {
    RegionMeshes all = meshes_;
    all.regions[region_].mesh = std::move(mesh);
    return all;
  }
  Task<> measure(Work& work);
  Task<MeshStatus> verify(Work& work);

  void keepUnfinished();
  void takeResult();
  void end();

  [[nodiscard]] const VolumeMesh& snapshotOf(RegionMeshes meshes) const {
    return snapshot_ = toVolumeMesh(joined(std::move(meshes)));
  }

  void report(const std::vector<Diagnostic>& found) {
    diagnostics_.insert(diagnostics_.end(), found.begin(), found.end());
  }
  [[nodiscard]] bool hasReported(DiagnosticCode code) const {
    return std::ranges::any_of(diagnostics_,
                               [&](const Diagnostic& known) { return known.code == code; });
  }
  [[nodiscard]] std::size_t boundaryNodes() const { return surface_.points.size() / 3; }

  MeshOptions options_;
  /// Largest volumes per given region; per region of the mesh once the boundary is checked.
  std::vector<double> maxVolumes_;
  std::optional<Model> model_;          ///< none if a surface is given
  std::optional<BodySurfaces> bodies_;  ///< without triangles once they are in the surface
  std::uint32_t firstOfBodies_ = 0;     ///< first triangle of bodies in the surface
  BackgroundGrid grid_;
  MeshStatus status_ = MeshStatus::kRunning;
  Phase phase_ = Phase::kCheck;
  double fraction_ = 0.0;
  SurfaceMesh surface_;
  std::vector<PatchSummary> patches_;
  std::optional<SizeField> field_;
  std::uint32_t expectedTetrahedra_ = 0;
  Task<bool> (Impl::*meshSurface_)(Work&) = &Impl::meshSurface<NullSurfaceTrace>;
  std::unique_ptr<FrontMaker> frontMaker_ = std::make_unique<PlainFrontMaker>();
  MakeSweepObserver makeObserver_ = nullptr;
  bool records_ = false;
  bool endsBeforeFront_ = false;
  StepRecorder recorder_;
  std::uint64_t frontFingerprint_ = 0;
  std::optional<RegionMesher> front_;        ///< while it fills
  std::unique_ptr<SweepObserver> observer_;  ///< of the optimizer, if the run is recorded
  TileLender lender_;                        ///< optimizes tiles unless there is a runner
  std::unique_ptr<TileRunner> tileRunner_;   ///< none by default
  std::optional<MeshOptimizer> optimizer_;   ///< while it optimizes a region
  std::optional<VolumeLimiter> limiter_;     ///< while it splits large elements of a region
  std::size_t region_ = 0;                   ///< region that the optimizer or the limiter works on
  bool hasFoundNothingBetter_ = false;
  RegionMeshes meshes_;          ///< after the front
  PartedMesh result_;            ///< after the last stage
  mutable VolumeMesh snapshot_;  ///< what volume() has returned, unless the result is arrays
  RecoverySummary recovery_;
  FrontCounters counters_;
  std::uint32_t latticeCount_ = 0;
  QualitySummary quality_;
  QualityStatistics statistics_;
  MetricShapes metricShapes_;
  std::vector<Diagnostic> diagnostics_;
  /// The last member: its tasks use the others. None once the run has ended.
  std::optional<Job<MeshStatus>> job_{std::in_place, [this](Work& work) { return run(work); }};
};

}  // namespace tetrafront
