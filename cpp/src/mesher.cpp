#include "tetrafront/mesher.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/fingerprint.h"
#include "field/size_field.h"
#include "optimize/locality.h"
#include "optimize/optimizer.h"
#include "quality/check_mesh.h"
#include "quality/metrics.h"
#include "quality/survey.h"
#include "surface/boundary.h"
#include "surface/examine_input.h"
#include "surface/expected_count.h"
#include "surface/possible_sizes.h"
#include "surface/surface_mesher.h"
#include "surface/wanted_sizes.h"
#include "volume/cell_mesher.h"

namespace tetrafront {
namespace {

/// Where each phase ends on the progress bar, 0 to 1.
constexpr double kCheckEnd = 0.02;
constexpr double kModelSurfaceEnd = 0.15;
constexpr double kVolumeEnd = 0.4;
constexpr double kOptimizeEnd = 0.97;

/// To come to so many elements in the order of a list costs as much as one step of the front.
constexpr std::size_t kReorderedPerBudget = 32;

}  // namespace

/// The rooms composed: each stage makes what the next one needs.
class MeshRun::Impl {
 public:
  Impl(Model model, BackgroundGrid grid, const MeshOptions& options)
      : options_(options), model_(std::move(model)), grid_(std::move(grid)) {}

  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       BackgroundGrid grid, const MeshOptions& options)
      : options_(options), grid_(std::move(grid)) {
    surface_.points.assign(points.begin(), points.end());
    surface_.triangles.assign(triangles.begin(), triangles.end());
    stage_ = Stage::kCheckBoundary;
  }

  MeshStatus advance(std::uint32_t budget) {
    if (status_ != MeshStatus::kRunning) return status_;
    budget = std::max(budget, 1U);
    // A model's options are examined with it.
    if (!optionsChecked_ && !isModel()) {
      optionsChecked_ = true;
      report(checkOptions(options_));
      if (anyError(diagnostics_)) {
        fail();
        return status_;
      }
    }
    switch (stage_) {
      case Stage::kCheckModel:
        checkInput();
        break;
      case Stage::kSurface:
        meshSurface(budget);
        break;
      case Stage::kCheckBoundary:
        checkBoundary(budget);
        break;
      case Stage::kField:
        makeSurfaceField(budget);
        break;
      case Stage::kEstimate:
        estimate();
        break;
      case Stage::kVolume:
        fillVolume(budget);
        break;
      case Stage::kOptimize:
        optimize(budget);
        break;
      case Stage::kMeasure:
        measure(budget);
        break;
      case Stage::kVerify:
        verify(budget);
        break;
    }
    // Sweeps that repeat take their estimate back; the bar must not.
    fraction_ = std::max(fraction_, estimateFraction());
    return status_;
  }

  void cancel() {
    if (status_ != MeshStatus::kRunning) return;
    status_ = MeshStatus::kCancelled;
    if (volumeMesher_) keepMesh();
    if (optimizer_) finishedMesh_ = optimizer_->mesh();
  }

  [[nodiscard]] MeshStatus status() const { return status_; }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const SurfaceMesh& surface() const { return surface_; }

  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const { return patches_; }

  [[nodiscard]] VolumeMesh volume() const {
    if (finishedMesh_) return *finishedMesh_;
    return volumeMesher_ ? volumeMesher_->mesh() : VolumeMesh{};
  }

  [[nodiscard]] QualitySummary quality() const {
    return status_ == MeshStatus::kDone ? survey_->summary() : measureQuality(volume());
  }
  [[nodiscard]] QualityStatistics statistics() const {
    return status_ == MeshStatus::kDone ? survey_->statistics() : QualityStatistics{};
  }
  [[nodiscard]] RecoverySummary recovery() const {
    return volumeMesher_ ? volumeMesher_->recovery() : recovery_;
  }
  [[nodiscard]] FrontCounters counters() const {
    return volumeMesher_ ? volumeMesher_->counters() : counters_;
  }

  [[nodiscard]] std::uint64_t fingerprint() const {
    const VolumeMesh mesh = volume();
    Fingerprint fingerprint;
    fingerprint.add(mesh.points);
    fingerprint.add(mesh.tetrahedra);
    return fingerprint.value();
  }

  [[nodiscard]] Progress progress() const {
    Progress progress;
    progress.phase = phase();
    progress.fraction = fraction_;
    progress.expectedTetrahedra = expectedTetrahedra_;
    progress.triangles = static_cast<std::uint32_t>(surface_.triangles.size() / 3);
    progress.points = static_cast<std::uint32_t>(surface_.points.size() / 3);
    if (volumeMesher_) {
      progress.points = volumeMesher_->pointCount();
      progress.tetrahedra = volumeMesher_->tetrahedronCount();
      progress.frontFaces = volumeMesher_->frontFaceCount();
    } else if (optimizer_) {
      progress.points = optimizer_->pointCount();
      progress.tetrahedra = optimizer_->tetrahedronCount();
    } else if (finishedMesh_) {
      progress.points = static_cast<std::uint32_t>(finishedMesh_->points.size() / 3);
      progress.tetrahedra = static_cast<std::uint32_t>(finishedMesh_->tetrahedra.size() / 4);
      progress.frontFaces = static_cast<std::uint32_t>(finishedMesh_->front.size() / 3);
    }
    return progress;
  }

 private:
  enum class Stage : std::uint8_t {
    kCheckModel,
    kSurface,
    kCheckBoundary,
    kField,
    kEstimate,
    kVolume,
    kOptimize,
    kMeasure,
    kVerify,
  };

  [[nodiscard]] bool isModel() const { return model_.has_value(); }

  [[nodiscard]] Phase phase() const {
    switch (stage_) {
      case Stage::kCheckModel:
        return Phase::kCheck;
      case Stage::kSurface:
        return surfaceMesher_->phase();
      case Stage::kCheckBoundary:
        return isModel() ? Phase::kSurface : Phase::kCheck;
      case Stage::kField:
        return Phase::kCheck;
      case Stage::kEstimate:
      case Stage::kVolume:
        return Phase::kVolume;
      case Stage::kOptimize:
        return Phase::kOptimize;
      case Stage::kMeasure:
      case Stage::kVerify:
        return Phase::kVerify;
    }
    return Phase::kCheck;
  }

  /// Estimated part of the whole run that is done.
  [[nodiscard]] double estimateFraction() const {
    const double surfaceEnd = isModel() ? kModelSurfaceEnd : kCheckEnd;
    const auto between = [](double from, double to, double part) {
      return from + (to - from) * part;
    };
    switch (stage_) {
      case Stage::kCheckModel:
        return 0.0;
      case Stage::kSurface:
        return between(kCheckEnd, surfaceEnd, surfaceMesher_->fraction());
      case Stage::kCheckBoundary:
        return isModel() ? surfaceEnd : 0.0;
      case Stage::kField:
      case Stage::kEstimate:
        return surfaceEnd;
      case Stage::kVolume:
        return between(surfaceEnd, kVolumeEnd, filled_);
      case Stage::kOptimize:
        return between(kVolumeEnd, kOptimizeEnd, optimizer_ ? optimizer_->fraction() : 0.0);
      case Stage::kMeasure:
        return kOptimizeEnd;
      case Stage::kVerify:
        return status_ == MeshStatus::kDone ? 1.0
                                            : between(kOptimizeEnd, 1.0, verifier_->fraction());
    }
    return 0.0;
  }

  void fail() { status_ = MeshStatus::kInvalidInput; }

  void report(const std::vector<Diagnostic>& found) {
    diagnostics_.insert(diagnostics_.end(), found.begin(), found.end());
  }

  [[nodiscard]] bool wasReported(DiagnosticCode code) const {
    return std::ranges::any_of(diagnostics_,
                               [&](const Diagnostic& known) { return known.code == code; });
  }

  /// What examineInput() says is what a preview says.
  void checkInput() {
    InputExamination found = examineInput(*model_, grid_, options_);
    report(found.preview.diagnostics);
    if (anyError(diagnostics_) || !found.field) return fail();
    field_ = std::move(found.field);
    surfaceMesher_.emplace(*model_, *field_);
    stage_ = Stage::kSurface;
  }

  void meshSurface(std::uint32_t budget) {
    const MeshStatus status = surfaceMesher_->advance(budget);
    if (status == MeshStatus::kRunning) return;
    report(surfaceMesher_->diagnostics());
    if (status != MeshStatus::kDone || anyError(diagnostics_)) return fail();
    surface_ = surfaceMesher_->takeMesh();
    patches_ = surfaceMesher_->patchSummaries();
    stage_ = Stage::kCheckBoundary;
  }

  void checkBoundary(std::uint32_t budget) {
    if (!boundaryCheck_) {
      if (!isModel()) report(checkWantedSizes(grid_, options_));
      boundaryCheck_.emplace(
          surface_, isModel() ? BoundarySource::kDrawnPatches : BoundarySource::kGivenSurface,
          options_.enclosed, MixedTurns::kRefuse);
    }
    if (!boundaryCheck_->advance(budget)) return;
    for (const Diagnostic& found : boundaryCheck_->diagnostics()) {
      // How the bodies of a model are nested was told with the check of the input.
      if (found.code != DiagnosticCode::kNestedBodies || !wasReported(found.code)) report({found});
    }
    if (!boundaryCheck_->result().valid || anyError(diagnostics_)) return fail();
    stage_ = isModel() ? Stage::kEstimate : Stage::kField;
  }

  /// Once the sizes wanted are known, what of them the surface allows.
  void makeSurfaceField(std::uint32_t budget) {
    if (!field_) {
      if (!wantedSizes_) wantedSizes_.emplace(surface_, grid_, options_, OwnEdges::kCount);
      if (!wantedSizes_->advance(budget)) return;
      report(wantedSizes_->diagnostics());
      if (anyError(diagnostics_)) return fail();
      field_ = wantedSizes_->take();
      wantedSizes_.reset();
      possibleSizes_.emplace(surface_, grid_, options_, *field_);
    }
    if (!possibleSizes_->advance(budget)) return;
    report(possibleSizes_->diagnostics());
    possibleSizes_.reset();
    stage_ = Stage::kEstimate;
  }

  void refuse(double expectedCount) {
    Diagnostic tooMany;
    tooMany.code = DiagnosticCode::kTooManyElements;
    tooMany.values = {counted(expectedCount), static_cast<double>(options_.maxTetrahedra)};
    report({tooMany});
    fail();
  }

  void estimate() {
    const double expected = expectedTetrahedra(surface_, *field_);
    if (!(expected <= static_cast<double>(options_.maxTetrahedra))) return refuse(expected);
    expectedTetrahedra_ = static_cast<std::uint32_t>(expected);
    volumeMesher_.emplace(surface_, *field_, options_);
    stage_ = Stage::kVolume;
  }

  void fillVolume(std::uint32_t budget) {
    const MeshStatus status = volumeMesher_->advance(budget);
    filled_ = volumeMesher_->filledFraction();
    if (status == MeshStatus::kRunning) return;
    report(volumeMesher_->diagnostics());
    keepMesh();
    if (status != MeshStatus::kDone) {
      status_ = status;
      return;
    }
    stage_ = Stage::kOptimize;
  }

  void optimize(std::uint32_t budget) {
    if (options_.optimization != Optimization::kNone) {
      if (!optimizer_) return beginOptimizer(budget);
      if (!optimizer_->advance(budget)) return;
      finishedMesh_ = optimizer_->mesh();
      optimizer_.reset();
    }
    verifier_.emplace(*finishedMesh_, surface_);
    stage_ = Stage::kMeasure;
  }

  void beginOptimizer(std::uint32_t budget) {
    const std::size_t boundaryNodes = surface_.points.size() / 3;
    if (!reordering_) reordering_.emplace(*finishedMesh_, boundaryNodes);
    if (!reordering_->advance(kReorderedPerBudget * budget)) return;
    finishedMesh_ = reordering_->take();
    reordering_.reset();
    optimizer_.emplace(*finishedMesh_, boundaryNodes, *field_, options_.optimization);
  }

  /// Takes what the volume mesher has made and frees it: the front needs more room than the mesh.
  void keepMesh() {
    finishedMesh_ = volumeMesher_->mesh();
    recovery_ = volumeMesher_->recovery();
    counters_ = volumeMesher_->counters();
    volumeMesher_.reset();
  }

  void measure(std::uint32_t budget) {
    if (!survey_) survey_.emplace(*finishedMesh_, surface_, *field_);
    if (survey_->advance(budget)) stage_ = Stage::kVerify;
  }

  /// The engine's own exact verdict; a failure is our mistake, and is told rather than hidden.
  void verify(std::uint32_t budget) {
    if (!verifier_->advance(budget)) return;
    const std::uint64_t defects = verifier_->defects().count();
    if (defects == 0) {
      status_ = MeshStatus::kDone;
      return;
    }
    Diagnostic failed;
    failed.code = DiagnosticCode::kVerificationFailed;
    failed.values = {static_cast<double>(defects)};
    report({failed});
    status_ = MeshStatus::kStalled;
  }

  MeshOptions options_;
  std::optional<Model> model_;
  BackgroundGrid grid_;
  Stage stage_ = Stage::kCheckModel;
  MeshStatus status_ = MeshStatus::kRunning;
  SurfaceMesh surface_;
  std::vector<PatchSummary> patches_;
  std::optional<SizeField> field_;
  std::optional<WantedSizes> wantedSizes_;
  std::optional<PossibleSizes> possibleSizes_;
  std::optional<SurfaceMesher> surfaceMesher_;
  std::optional<BoundaryCheck> boundaryCheck_;
  std::optional<CellMesher> volumeMesher_;
  std::optional<VolumeMesh> finishedMesh_;
  double filled_ = 0.0;
  double fraction_ = 0.0;
  std::uint32_t expectedTetrahedra_ = 0;
  bool optionsChecked_ = false;
  RecoverySummary recovery_;
  FrontCounters counters_;
  std::optional<QualitySurvey> survey_;
  std::optional<MortonReordering> reordering_;
  std::optional<MeshOptimizer> optimizer_;
  std::optional<MeshVerifier> verifier_;
  std::vector<Diagnostic> diagnostics_;
};

MeshRun::MeshRun(Model model, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(grid), options)) {}

MeshRun::MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 const MeshOptions& options)
    : MeshRun(points, triangles, BackgroundGrid{}, options) {}

MeshRun::MeshRun(std::span<const double> points, std::span<const std::uint32_t> triangles,
                 BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(points, triangles, std::move(grid), options)) {}

MeshRun::MeshRun(MeshRun&&) noexcept = default;
MeshRun& MeshRun::operator=(MeshRun&&) noexcept = default;
MeshRun::~MeshRun() = default;

MeshStatus MeshRun::advance(std::uint32_t budget) { return impl_->advance(budget); }
void MeshRun::cancel() { impl_->cancel(); }
MeshStatus MeshRun::status() const { return impl_->status(); }
Progress MeshRun::progress() const { return impl_->progress(); }
const std::vector<Diagnostic>& MeshRun::diagnostics() const { return impl_->diagnostics(); }
const SurfaceMesh& MeshRun::surface() const { return impl_->surface(); }
VolumeMesh MeshRun::volume() const { return impl_->volume(); }
const std::vector<PatchSummary>& MeshRun::patchSummaries() const { return impl_->patchSummaries(); }
QualitySummary MeshRun::quality() const { return impl_->quality(); }
QualityStatistics MeshRun::statistics() const { return impl_->statistics(); }
RecoverySummary MeshRun::recovery() const { return impl_->recovery(); }
FrontCounters MeshRun::counters() const { return impl_->counters(); }
std::uint64_t MeshRun::fingerprint() const { return impl_->fingerprint(); }

}  // namespace tetrafront
