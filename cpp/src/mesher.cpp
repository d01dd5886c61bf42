#include "tetrafront/mesher.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "base/budget.h"
#include "base/diagnostics.h"
#include "base/fingerprint.h"
#include "boundary/boundary.h"
#include "field/size_field.h"
#include "optimize/locality.h"
#include "optimize/optimizer.h"
#include "preview/check_input.h"
#include "quality/verify_mesh.h"
#include "quality/metrics.h"
#include "quality/quality_analysis.h"
#include "sizing/achievable_sizes.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/target_sizes.h"
#include "surface/surface_mesher.h"
#include "volume/region_mesher.h"

namespace tetrafront {
namespace {

/// Where each phase ends on the progress bar, 0 to 1.
constexpr double kCheckEnd = 0.02;
constexpr double kModelSurfaceEnd = 0.15;
constexpr double kVolumeEnd = 0.4;
constexpr double kOptimizeEnd = 0.97;
/// How much later the volume ends where the front has left everything to recovery.
constexpr double kRecovery = 0.35;

/// To come to so many elements in the order of a list costs as much as one step of the front.
constexpr std::size_t kReorderedPerBudget = 32;

}  // namespace

/// The rooms composed. One worker is there at a time; it hands what it has made to the run and goes,
/// with all it needed, when the next one comes.
class MeshRun::Impl {
 public:
  Impl(Model model, BackgroundGrid grid, const MeshOptions& options)
      : options_(options), model_(std::move(model)), grid_(std::move(grid)) {}

  Impl(std::span<const double> points, std::span<const std::uint32_t> triangles,
       BackgroundGrid grid, const MeshOptions& options)
      : options_(options), grid_(std::move(grid)) {
    surface_.points.assign(points.begin(), points.end());
    surface_.triangles.assign(triangles.begin(), triangles.end());
  }

  MeshStatus advance(std::uint32_t budget) {
    if (status_ != MeshStatus::kRunning) return status_;
    std::visit([&](auto& worker) { work(worker, std::max(budget, 1U)); }, worker_);
    if (status_ != MeshStatus::kRunning) {
      end();
    } else {
      look();
    }
    return status_;
  }

  void cancel() {
    if (status_ != MeshStatus::kRunning) return;
    status_ = MeshStatus::kCancelled;
    end();
  }

  [[nodiscard]] MeshStatus status() const { return status_; }
  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const SurfaceMesh& surface() const { return surface_; }

  [[nodiscard]] const std::vector<PatchSummary>& patchSummaries() const { return patches_; }

  [[nodiscard]] VolumeMesh volume() const {
    if (const auto* mesher = std::get_if<RegionMesher>(&worker_)) return mesher->mesh();
    if (const auto* optimizer = std::get_if<MeshOptimizer>(&worker_)) return optimizer->mesh();
    return mesh_;
  }

  [[nodiscard]] QualitySummary quality() const {
    return status_ == MeshStatus::kDone ? quality_ : measureQuality(volume());
  }
  [[nodiscard]] const QualityStatistics& statistics() const { return statistics_; }
  [[nodiscard]] RecoverySummary recovery() const {
    const auto* mesher = std::get_if<RegionMesher>(&worker_);
    return mesher != nullptr ? mesher->recovery() : recovery_;
  }
  [[nodiscard]] FrontCounters counters() const {
    const auto* mesher = std::get_if<RegionMesher>(&worker_);
    return mesher != nullptr ? mesher->counters() : counters_;
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
    progress.phase = phase_;
    progress.fraction = fraction_;
    progress.expectedTetrahedra = expectedTetrahedra_;
    progress.triangles = static_cast<std::uint32_t>(surface_.triangles.size() / 3);
    progress.points = static_cast<std::uint32_t>(surface_.points.size() / 3);
    if (const auto* mesher = std::get_if<RegionMesher>(&worker_)) {
      progress.points = mesher->nodeCount();
      progress.tetrahedra = mesher->tetrahedronCount();
      progress.frontFaces = mesher->frontFaceCount();
      progress.exactFill = exactFill_;
    } else if (const auto* optimizer = std::get_if<MeshOptimizer>(&worker_)) {
      progress.points = optimizer->pointCount();
      progress.tetrahedra = optimizer->tetrahedronCount();
    } else if (!mesh_.points.empty()) {
      progress.points = static_cast<std::uint32_t>(mesh_.points.size() / 3);
      progress.tetrahedra = static_cast<std::uint32_t>(mesh_.tetrahedra.size() / 4);
      progress.frontFaces = static_cast<std::uint32_t>(mesh_.front.size() / 3);
    }
    return progress;
  }

 private:
  struct InputCheck {
    std::optional<Job<CheckedInput>> ofModel;
    std::optional<BackgroundGridCheck> ofGrid;  ///< with a given surface
  };
  // Done in one step each.
  struct Estimate {};
  struct Nobody {};

  using Worker = std::variant<InputCheck, SurfaceMesher, BoundaryCheck, TargetSizes,
                              AchievableSizes, Estimate, RegionMesher, MortonReordering,
                              MeshOptimizer, QualityAnalysis, MeshVerifier, Nobody>;

  [[nodiscard]] bool isModel() const { return model_.has_value(); }
  [[nodiscard]] std::size_t boundaryNodes() const { return surface_.points.size() / 3; }

  void fail() { status_ = MeshStatus::kInvalidInput; }

  void report(const std::vector<Diagnostic>& found) {
    diagnostics_.insert(diagnostics_.end(), found.begin(), found.end());
  }

  [[nodiscard]] bool wasReported(DiagnosticCode code) const {
    return std::ranges::any_of(diagnostics_,
                               [&](const Diagnostic& known) { return known.code == code; });
  }

  /// Keeps what an unfinished worker has made.
  void end() {
    if (auto* mesher = std::get_if<RegionMesher>(&worker_)) {
      keepFront(*mesher);
    } else if (const auto* optimizer = std::get_if<MeshOptimizer>(&worker_)) {
      mesh_ = optimizer->mesh();
    }
    if (status_ == MeshStatus::kDone) fraction_ = 1.0;
    worker_.emplace<Nobody>();
  }

  void keepFront(RegionMesher& mesher) {
    mesh_ = mesher.take();
    recovery_ = mesher.recovery();
    counters_ = mesher.counters();
  }

  // work() on each worker's own, about `budget` of it; the worker is gone once the next is there.

  void work(InputCheck& check, std::uint32_t budget) {
    if (isModel()) {
      // What a preview says.
      if (!check.ofModel)
        check.ofModel.emplace(
            [this](Work& work) { return checkInput(work, *model_, grid_, options_); });
      if (!check.ofModel->advance(budget)) return;
      CheckedInput found = check.ofModel->take();
      report(found.preview.diagnostics);
      if (anyError(diagnostics_) || !found.field) return fail();
      field_ = std::move(found.field);
      worker_.emplace<SurfaceMesher>(*model_, *field_);
    } else {
      if (!check.ofGrid) {
        report(checkOptions(options_));
        if (anyError(diagnostics_)) return fail();
        check.ofGrid = targetSizeCheck(grid_, options_);
      }
      if (!check.ofGrid->advance(budget)) return;
      report(check.ofGrid->take());
      worker_.emplace<BoundaryCheck>(surface_, BoundarySource::kGivenSurface, options_.enclosed,
                                     MixedOrientation::kRefuse);
    }
  }

  void work(SurfaceMesher& mesher, std::uint32_t budget) {
    const MeshStatus status = mesher.advance(budget);
    if (status == MeshStatus::kRunning) return;
    report(mesher.diagnostics());
    if (status != MeshStatus::kDone || anyError(diagnostics_)) return fail();
    surface_ = mesher.takeMesh();
    patches_ = mesher.patchSummaries();
    worker_.emplace<BoundaryCheck>(surface_, BoundarySource::kDrawnPatches, options_.enclosed,
                                   MixedOrientation::kRefuse);
  }

  void work(BoundaryCheck& check, std::uint32_t budget) {
    if (!check.advance(budget)) return;
    for (const Diagnostic& found : check.diagnostics()) {
      // How the bodies of a model are nested was told with the check of the input.
      if (found.code != DiagnosticCode::kNestedRegions || !wasReported(found.code)) report({found});
    }
    if (!check.result().isValid || anyError(diagnostics_)) return fail();
    if (isModel()) {
      worker_.emplace<Estimate>();
    } else {
      report(checkLargestSize(surface_, options_.size));
      worker_.emplace<TargetSizes>(surface_, grid_, options_, EdgeSizes::kCount);
    }
  }

  void work(TargetSizes& sizes, std::uint32_t budget) {
    if (!sizes.advance(budget)) return;
    report(sizes.diagnostics());
    if (anyError(diagnostics_)) return fail();
    field_ = sizes.take();
    worker_.emplace<AchievableSizes>(surface_, grid_, options_, *field_);
  }

  void work(AchievableSizes& sizes, std::uint32_t budget) {
    if (!sizes.advance(budget)) return;
    report(sizes.diagnostics());
    worker_.emplace<Estimate>();
  }

  void work(Estimate& /*worker*/, std::uint32_t /*budget*/) {
    const double expected = expectedTetrahedra(surface_, *field_);
    if (!(expected <= static_cast<double>(options_.maxTetrahedra))) {
      Diagnostic tooMany;
      tooMany.code = DiagnosticCode::kTooManyElements;
      tooMany.values = {cappedCount(expected), static_cast<double>(options_.maxTetrahedra)};
      report({tooMany});
      return fail();
    }
    expectedTetrahedra_ = static_cast<std::uint32_t>(expected);
    worker_.emplace<RegionMesher>(surface_, *field_, options_);
  }

  void work(RegionMesher& mesher, std::uint32_t budget) {
    const MeshStatus status = mesher.advance(budget);
    if (status == MeshStatus::kRunning) return;
    report(mesher.diagnostics());
    if (status != MeshStatus::kDone) {
      status_ = status;
      return;
    }
    keepFront(mesher);
    if (options_.optimization == Optimization::kNone) return judge();
    worker_.emplace<MortonReordering>(mesh_, boundaryNodes());
  }

  void work(MortonReordering& reordering, std::uint32_t budget) {
    if (!reordering.advance(scaledBudget(budget, kReorderedPerBudget))) return;
    mesh_ = reordering.take();
    worker_.emplace<MeshOptimizer>(std::exchange(mesh_, {}), boundaryNodes(), *field_,
                                   options_.optimization);
  }

  void work(MeshOptimizer& optimizer, std::uint32_t budget) {
    if (!optimizer.advance(budget)) return;
    mesh_ = optimizer.mesh();
    judge();
  }

  void judge() { worker_.emplace<QualityAnalysis>(mesh_, surface_, *field_); }

  void work(QualityAnalysis& survey, std::uint32_t budget) {
    if (!survey.advance(budget)) return;
    quality_ = survey.summary();
    statistics_ = survey.statistics();
    worker_.emplace<MeshVerifier>(mesh_, surface_);
  }

  /// The engine's own exact verdict; a failure is our mistake, and is told rather than hidden.
  void work(MeshVerifier& verifier, std::uint32_t budget) {
    if (!verifier.advance(budget)) return;
    const std::uint64_t defects = verifier.defects().count();
    if (defects == 0) {
      status_ = MeshStatus::kDone;
      return;
    }
    Diagnostic failed;
    failed.code = DiagnosticCode::kVerificationFailed;
    failed.values = {static_cast<double>(defects)};
    report({failed});
    statistics_ = {};
    status_ = MeshStatus::kStalled;
  }

  void work(Nobody& /*worker*/, std::uint32_t /*budget*/) {}

  /// Where a run is: `part`, 0 to 1, of a section of its way, which ends there on the progress bar.
  struct Position {
    Phase phase;
    double end;
    double part = 0.0;
    std::uint32_t section = 0;  ///< of the worker's own
  };

  [[nodiscard]] double surfaceEnd() const { return isModel() ? kModelSurfaceEnd : kCheckEnd; }

  [[nodiscard]] Position positionOf(const InputCheck& check) const {
    return {Phase::kCheck, kCheckEnd, check.ofModel ? check.ofModel->fraction() : 0.0};
  }
  [[nodiscard]] Position positionOf(const SurfaceMesher& mesher) const {
    return {mesher.phase(), surfaceEnd(), mesher.fraction()};
  }
  [[nodiscard]] Position positionOf(const BoundaryCheck& check) const {
    if (isModel()) return {Phase::kSurface, surfaceEnd()};
    return {Phase::kCheck, kCheckEnd, check.fraction()};
  }
  [[nodiscard]] Position positionOf(const TargetSizes& /*sizes*/) const {
    return {Phase::kCheck, kCheckEnd};
  }
  [[nodiscard]] Position positionOf(const AchievableSizes& /*sizes*/) const {
    return {Phase::kCheck, kCheckEnd};
  }
  [[nodiscard]] Position positionOf(const Estimate& /*worker*/) const {
    return {Phase::kVolume, kVolumeEnd};
  }
  [[nodiscard]] Position positionOf(const RegionMesher& mesher) const {
    const double end = surfaceEnd() +
                       (kVolumeEnd - surfaceEnd()) * mesher.passFractionAtSectionEnd() +
                       kRecovery * mesher.openShare();
    return {Phase::kVolume, end, mesher.sectionFraction(), mesher.section()};
  }
  [[nodiscard]] Position positionOf(const MortonReordering& /*reordering*/) const {
    return {Phase::kOptimize, kVolumeEnd};
  }
  [[nodiscard]] Position positionOf(const MeshOptimizer& optimizer) const {
    return {Phase::kOptimize, kOptimizeEnd, optimizer.fraction()};
  }
  [[nodiscard]] Position positionOf(const QualityAnalysis& /*survey*/) const {
    return {Phase::kVerify, kOptimizeEnd};
  }
  [[nodiscard]] Position positionOf(const MeshVerifier& verifier) const {
    return {Phase::kVerify, 1.0, verifier.fraction()};
  }
  [[nodiscard]] Position positionOf(const Nobody& /*worker*/) const { return {phase_, fraction_}; }

  /// Sweeps that repeat take their estimate back, as do tries that fail; the bar must not.
  void look() {
    const Position at = std::visit([&](const auto& worker) { return positionOf(worker); }, worker_);
    phase_ = at.phase;
    const std::pair section(worker_.index(), at.section);
    if (section != section_) {
      section_ = section;
      sectionBegan_ = fraction_;
      exactFill_ = 0.0;
    }
    const double end = std::max(at.end, sectionBegan_);
    fraction_ = std::max(fraction_, sectionBegan_ + (end - sectionBegan_) * at.part);
    if (const auto* mesher = std::get_if<RegionMesher>(&worker_)) {
      exactFill_ = std::max(exactFill_, mesher->exactFillFraction());
    }
  }

  MeshOptions options_;
  std::optional<Model> model_;
  BackgroundGrid grid_;
  MeshStatus status_ = MeshStatus::kRunning;
  Phase phase_ = Phase::kCheck;
  double fraction_ = 0.0;
  std::pair<std::size_t, std::uint32_t> section_;  ///< worker's number, and its own
  double sectionBegan_ = 0.0;                      ///< where fraction_ was then
  double exactFill_ = 0.0;
  SurfaceMesh surface_;
  std::vector<PatchSummary> patches_;
  std::optional<SizeField> field_;
  std::uint32_t expectedTetrahedra_ = 0;
  VolumeMesh mesh_;  ///< between two workers, and from the last on
  RecoverySummary recovery_;
  FrontCounters counters_;
  QualitySummary quality_;
  QualityStatistics statistics_;
  std::vector<Diagnostic> diagnostics_;
  Worker worker_;  ///< the last: it refers to the others
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
