/// @file The stages of a run, one after the other.

#include "mesh_run.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "boundary/boundary.h"
#include "lattice/rules.h"
#include "optimize/locality.h"
#include "preview/check_input.h"
#include "quality/metrics.h"
#include "quality/quality_analysis.h"
#include "quality/verify_mesh.h"
#include "sizing/achievable_sizes.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/memory_limit.h"
#include "sizing/most_demanding.h"
#include "sizing/target_sizes.h"
#include "sizing/volume_sizes.h"
#include "surface/patch_summary.h"
#include "surface/surface_mesher.h"
#include "topology/surface_access.h"

namespace tetrafront {
namespace {

/// Progress at the end of the first stages, 0 to 1: estimated shares of the time of typical runs.
struct StageEnds {
  double input;
  double surface;
  double boundary;
  double sizes;
};
constexpr StageEnds kModelEnds{.input = 0.01, .surface = 0.09, .boundary = 0.1, .sizes = 0.1};
constexpr StageEnds kBodyEnds{.input = 0.01, .surface = 0.09, .boundary = 0.11, .sizes = 0.12};
constexpr StageEnds kSurfaceEnds{
    .input = 0.004, .surface = 0.004, .boundary = 0.015, .sizes = 0.02};

/// Progress at the end of the volume if the front leaves everything to recovery, and the share of the front in it: larger where
/// few elements per triangle are expected, because the optimization has then little to do.
constexpr double kVolumeEnd = 0.75;
constexpr double kFrontShareOfThin = 0.5;
constexpr double kElementsPerTriangle = 6.0;
constexpr double kElementsPerTriangleOfThin = 1.5;

constexpr double kOptimizeEnd = 0.97;
/// Share of the optimization in which elements are put in order.
constexpr double kOrderShare = 0.01;
constexpr double kLimitedOptimizeEnd = 0.9;  ///< if volumes are limited
constexpr double kMeasureEnd = 0.98;

bool isAboutRegions(DiagnosticCode code) {
  return code == DiagnosticCode::kNestedRegions || code == DiagnosticCode::kSurfaceContact;
}

/// Returns the smaller of two limits; 0 stands for no limit.
double smallerLimit(double a, double b) {
  return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
}

/// Returns per region the share of the elements in it and in those before it, cores left out.
std::vector<double> shareEnds(const RegionMeshes& meshes) {
  std::vector<double> ends;
  double sum = 0.0;
  for (const RegionMesh& region : meshes.regions) {
    sum += static_cast<double>(region.mesh.tetrahedra.size());
    ends.push_back(sum);
  }
  for (double& end : ends) end /= std::max(sum, 1.0);
  return ends;
}

bool hasVolumeLimits(const std::vector<double>& volumes) {
  return std::ranges::any_of(volumes, [](double volume) { return volume > 0.0; });
}

}  // namespace

/// The chain F1-F9 of Löhner & Parikh 1988, section 2, then optimization and verification.
Task<MeshStatus> MeshRun::Impl::run(Work& work) {
  const StageEnds& ends = !model_ ? kSurfaceEnds : bodies_ ? kBodyEnds : kModelEnds;
  begin(work, Phase::kCheck, ends.input);
  if (!co_await checkInput(work)) co_return MeshStatus::kInvalidInput;

  if (model_) {
    begin(work, Phase::kSides, ends.surface);
    if (!co_await (this->*meshSurface_)(work)) co_return MeshStatus::kInvalidInput;
    if (bodies_) addBodies();
  }
  begin(work, model_ ? Phase::kSurface : Phase::kCheck, ends.boundary);
  if (!co_await checkBoundary(work)) co_return MeshStatus::kInvalidInput;

  if (!model_ || bodies_) {
    begin(work, model_ ? Phase::kSurface : Phase::kCheck, ends.sizes);
    if (!co_await findSizes(work)) co_return MeshStatus::kInvalidInput;
  }
  if (bodies_) summarizeBodies();
  if (!limitElements()) co_return MeshStatus::kInvalidInput;
  if (endsBeforeFront_) co_return MeshStatus::kDone;

  begin(work, Phase::kVolume, kVolumeEnd);
  const MeshStatus filled = co_await fill(work);
  if (filled != MeshStatus::kDone) co_return filled;

  const bool isLimited = options_.maxVolume > 0.0 || hasVolumeLimits(maxVolumes_);
  if (options_.optimization != Optimization::kNone) {
    begin(work, Phase::kOptimize, isLimited ? kLimitedOptimizeEnd : kOptimizeEnd);
    co_await optimize(work);
  }
  if (isLimited) {
    begin(work, Phase::kOptimize, kOptimizeEnd);
    const bool isWithinLimits = co_await limitVolumes(work);
    if (!isWithinLimits) co_return MeshStatus::kStalled;
  }
  begin(work, Phase::kVerify, kMeasureEnd);
  co_await measure(work);
  begin(work, Phase::kVerify, 1.0);
  co_return co_await verify(work);
}

void MeshRun::Impl::begin(Work& work, Phase phase, double end) {
  phase_ = phase;
  work.beginPart(end);
}

Task<bool> MeshRun::Impl::checkInput(Work& work) {
  if (!model_) {
    report(checkOptions(options_));
    if (anyError(diagnostics_)) co_return false;
    // Errors of the grid end the run after the boundary check, so that the user gets all diagnostics at once.
    const std::vector<Diagnostic> ofGrid = co_await checkTargetGrid(work, grid_, options_);
    report(ofGrid);
    co_return true;
  }
  CheckedInput input = co_await tetrafront::checkInput(work, *model_, grid_, options_);
  for (const Diagnostic& found : input.preview.diagnostics) {
    // Bodies change how regions are nested and touch; the boundary check reports it.
    if (!bodies_ || !isAboutRegions(found.code)) report({found});
  }
  field_ = std::move(input.field);
  co_return field_.has_value() && !anyError(diagnostics_);
}

template <class Trace>
Task<bool> MeshRun::Impl::meshSurface(Work& work) {
  typename Trace::Recorder recorder(recorder_.bytes());
  BasicSurfaceMesher<Trace> mesher(*model_, *field_, options_.maxTetrahedra, Trace{&recorder});
  MeshStatus status = mesher.advance(work.remaining());
  for (; status == MeshStatus::kRunning; status = mesher.advance(work.remaining())) {
    phase_ = mesher.phase();
    work.setFraction(mesher.fraction());
    co_await work.yield();
  }
  report(mesher.diagnostics());
  if (status != MeshStatus::kDone || anyError(diagnostics_)) co_return false;
  surface_ = mesher.takeMesh();
  patches_ = mesher.patchSummaries();
  co_await work.yield();
  co_return true;
}

template Task<bool> MeshRun::Impl::meshSurface<NullSurfaceTrace>(Work& work);
template Task<bool> MeshRun::Impl::meshSurface<RecordingSurfaceTrace>(Work& work);

Task<bool> MeshRun::Impl::checkBoundary(Work& work) {
  const BoundarySource source =
      model_ || bodies_ ? BoundarySource::kDrawnPatches : BoundarySource::kGivenSurface;
  BoundaryCheck check(surface_, source, options_.innerShells, MixedOrientation::kRefuse);
  if (bodies_) check.setFirstOfBodies(firstOfBodies_);
  co_await work.finish(check);
  for (const Diagnostic& found : check.diagnostics()) {
    // The input check has already reported how the regions of a model are nested and touch.
    if (!isAboutRegions(found.code) || !hasReported(found.code)) report({found});
  }
  std::vector<double> ofRegions;
  for (const std::uint32_t given : check.result().givenRegionOf) {
    ofRegions.push_back(given < maxVolumes_.size() ? maxVolumes_[given] : 0.0);
  }
  maxVolumes_ = std::move(ofRegions);
  co_return check.result().isValid && !anyError(diagnostics_);
}

/// Finds the sizes in a given surface: from its own edges, the options and the background grid.
Task<bool> MeshRun::Impl::findSizes(Work& work) {
  report(checkLargestSize(surface_, options_.size));
  work.beginPart(0.5);
  {
    TargetSizes target(surface_, grid_, options_, EdgeSizes::kCount);
    co_await work.finish(target);
    report(target.diagnostics());
    if (anyError(diagnostics_)) co_return false;
    field_ = target.take();
  }
  if (hasVolumeLimits(maxVolumes_)) {
    field_->capSizes(sizeForVolume(options_.maxVolume), sizesForVolumes(maxVolumes_));
  }
  work.beginPart(1.0);
  AchievableSizes achievable(surface_, grid_, options_, *field_);
  co_await work.finish(achievable);
  report(achievable.diagnostics());
  co_return true;
}

/// Appends the bodies to the surface, with their patches after those of the model. The boundary check reports invalid
/// indices, so they must stay invalid.
void MeshRun::Impl::addBodies() {
  constexpr std::uint32_t kInvalid = 0xffffffffU;
  const auto nodes = static_cast<std::uint32_t>(boundaryNodes());
  const auto patches = static_cast<std::uint32_t>(patches_.size());
  firstOfBodies_ = countTriangles(surface_);
  const BodySurfaces bodies = std::exchange(*bodies_, BodySurfaces{});
  bodies_->patches = std::max(bodies.patches, 1U);
  surface_.points.insert(surface_.points.end(), bodies.points.begin(), bodies.points.end());
  for (const std::uint32_t node : bodies.triangles) {
    surface_.triangles.push_back(node < bodies.points.size() / 3 ? nodes + node : kInvalid);
  }
  for (std::size_t t = 0; t < bodies.triangles.size() / 3; ++t) {
    const std::uint32_t own = t < bodies.trianglePatch.size() ? bodies.trianglePatch[t] : 0;
    surface_.trianglePatch.push_back(patches + std::min(own, bodies_->patches - 1));
  }
}

void MeshRun::Impl::summarizeBodies() {
  const auto first = static_cast<std::uint32_t>(patches_.size());
  const std::vector<PatchSummary> found =
      summarizeGivenPatches(surface_, *field_, first, first + bodies_->patches);
  patches_.insert(patches_.end(), found.begin(), found.end());
}

/// Estimates how many elements the sizes and the largest volumes require; false, with a diagnostic, if they are too many.
bool MeshRun::Impl::limitElements() {
  const double forSizes = expectedTetrahedra(surface_, *field_);
  const double forVolumes = minTetrahedra(surface_, options_.maxVolume, maxVolumes_);
  const double expected = std::max(forSizes, forVolumes);
  const bool hasLattices =
      options_.interior != Interior::kFront && !records_ && !field_->isStretched();
  const double limit =
      std::min(static_cast<double>(options_.maxTetrahedra),
               std::floor(elementsWithin(
                   kAddressableBytes, static_cast<double>(countTriangles(surface_)), hasLattices)));
  if (expected <= limit) {
    expectedTetrahedra_ = static_cast<std::uint32_t>(expected);
    return true;
  }
  Diagnostic tooMany = tooManyElements(expected, limit);
  if (forSizes >= forVolumes) {
    nameMostDemanding(tooMany, grid_, options_, boundsOf(surface_));
  }
  report({tooMany});
  return false;
}

double MeshRun::Impl::frontShare() const {
  const double perTriangle =
      static_cast<double>(expectedTetrahedra_) /
      static_cast<double>(std::max<std::size_t>(countTriangles(surface_), 1));
  const double fullness = (perTriangle - kElementsPerTriangleOfThin) /
                          (kElementsPerTriangle - kElementsPerTriangleOfThin);
  return std::lerp(kFrontShareOfThin, RegionMesher::kFrontShare, std::clamp(fullness, 0.0, 1.0));
}

/// Returns Interior::kFront or Interior::kLattice.
Interior MeshRun::Impl::interior() const {
  if (records_) return Interior::kFront;
  if (options_.interior != Interior::kAuto) return options_.interior;
  return expectedTetrahedra_ < kLatticeFrom ? Interior::kFront : Interior::kLattice;
}

Task<MeshStatus> MeshRun::Impl::fill(Work& work) {
  MeshOptions options = options_;
  options.interior = interior();
  front_.emplace(surface_, *field_, options, *frontMaker_);
  work.beginPart(1.0);
  const MeshStatus status = co_await front_->run(work, frontShare());
  // The progress stays where it is: the rest was for recovery.
  work.beginPart(0.0);
  std::vector<Diagnostic> found = front_->diagnostics();
  for (Diagnostic& diagnostic : found) {
    if (diagnostic.code != DiagnosticCode::kTooManyElements) continue;
    nameMostDemanding(diagnostic, grid_, options_, boundsOf(surface_));
  }
  report(found);
  keepUnfinished();
  if (records_) frontFingerprint_ = fingerprint();
  co_await work.yield();
  co_return status;
}

/// Keeps what the running stage has made so far, and frees its memory.
void MeshRun::Impl::keepUnfinished() {
  if (front_) {
    recovery_ = front_->recovery();
    counters_ = front_->counters();
    latticeCount_ = front_->latticeCount();
    meshes_ = front_->take();
    front_.reset();
  } else if (optimizer_) {
    region().mesh = optimizer_->take();
    optimizer_.reset();
  } else if (limiter_) {
    region().mesh = limiter_->take();
    limiter_.reset();
  }
}

/// Makes the mesh the result.
void MeshRun::Impl::takeResult() {
  if (!meshes_.regions.empty()) result_ = joined(std::exchange(meshes_, {}));
}

void MeshRun::Impl::end() {
  job_.reset();
  snapshot_ = {};
  keepUnfinished();
  takeResult();
}

/// Optimizes each region by itself: none depends on another.
Task<> MeshRun::Impl::optimize(Work& work) {
  const std::vector<double> ends = shareEnds(meshes_);
  for (region_ = 0; region_ < ends.size(); ++region_) {
    work.beginPart(kOrderShare * ends[region_]);
    co_await orderAlongMortonCurve(work, region().mesh);
  }
  if (makeObserver_ != nullptr) {
    observer_ = makeObserver_(recorder_.bytes());
    observer_->begun(meshes_, *field_);
  }
  bool isAnyBetter = false;
  for (region_ = 0; region_ < ends.size(); ++region_) {
    work.beginPart(kOrderShare + (1.0 - kOrderShare) * ends[region_]);
    TetMesh mesh = std::exchange(region().mesh, {});
    if (observer_) {
      optimizer_.emplace(std::move(mesh), *field_, options_.optimization);
      optimizer_->observe(*observer_);
    } else {
      optimizer_.emplace(
          MeshOptimizer::inTiles(std::move(mesh), *field_, options_.optimization, tileRunner()));
    }
    co_await optimizer_->run(work);
    isAnyBetter = isAnyBetter || !optimizer_->hasFoundNothingBetter();
    keepUnfinished();
  }
  hasFoundNothingBetter_ = !isAnyBetter;
}

/// Splits the elements that are larger than permitted; false, with a diagnostic, if that makes too many.
Task<bool> MeshRun::Impl::limitVolumes(Work& work) {
  const std::vector<double> ends = shareEnds(meshes_);
  std::vector<double> needed;  // elements of later regions, at least
  for (std::size_t r = 0; r < ends.size(); ++r) needed.push_back(neededElements(r));
  std::size_t before = 0;  // elements of earlier regions
  for (region_ = 0; region_ < ends.size(); ++region_) {
    work.beginPart(ends[region_]);
    if (const double maxVolume = maxVolumeOf(region_); maxVolume > 0.0) {
      const double others =
          std::accumulate(needed.begin() + static_cast<std::ptrdiff_t>(region_) + 1, needed.end(),
                          static_cast<double>(before + region().coreCount()));
      const double left = std::max(0.0, options_.maxTetrahedra - others);
      limiter_.emplace(std::exchange(region().mesh, {}), maxVolume, static_cast<std::size_t>(left));
      co_await limiter_->run(work);
      reportLimits(before, others);
      keepUnfinished();
    }
    before += region().tetrahedronCount();
    co_await work.yield();
    if (anyError(diagnostics_)) co_return false;
  }
  co_return true;
}

/// Returns the largest volume of elements of a region; 0 for no limit.
double MeshRun::Impl::maxVolumeOf(std::size_t region) const {
  return smallerLimit(options_.maxVolume, region < maxVolumes_.size() ? maxVolumes_[region] : 0.0);
}

/// Returns how many elements a region needs at least for its largest volume.
double MeshRun::Impl::neededElements(std::size_t region) const {
  const RegionMesh& whole = meshes_.regions[region];
  const double maxVolume = maxVolumeOf(region);
  const double own = maxVolume > 0.0 ? tetrafront::neededElements(whole.mesh, maxVolume)
                                     : static_cast<double>(whole.mesh.tetrahedra.size());
  // The sizes of a lattice keep its elements below the limit.
  return own + static_cast<double>(whole.coreCount());
}

/// Reports what the limiter has found in a region, with elements and counts of all regions. `before`: elements of earlier regions;
/// `others`: number of elements outside the region.
void MeshRun::Impl::reportLimits(std::size_t before, double others) {
  std::vector<Diagnostic> found = limiter_->diagnostics();
  for (Diagnostic& diagnostic : found) {
    for (Entity& entity : diagnostic.entities) entity.index += static_cast<std::uint32_t>(before);
    if (diagnostic.code != DiagnosticCode::kTooManyElements) continue;
    diagnostic.values = {diagnostic.values.front() + others,
                         static_cast<double>(options_.maxTetrahedra)};
  }
  report(found);
}

Task<> MeshRun::Impl::measure(Work& work) {
  takeResult();
  QualityAnalysis analysis(MeshView(result_), surface_, *field_);
  co_await work.finish(analysis);
  quality_ = analysis.summary();
  statistics_ = analysis.statistics();
  metricShapes_ = analysis.takeMetricShapes();
}

/// Proves the result exactly. A defect is a mistake of the engine; the run then ends as stalled.
Task<MeshStatus> MeshRun::Impl::verify(Work& work) {
  MeshVerifier verifier(MeshView(result_), surface_);
  co_await work.finish(verifier);
  const MeshDefects& defects = verifier.defects();
  if (defects.count() == 0) co_return MeshStatus::kDone;
  report({diagnose<DiagnosticCode::kVerificationFailed>(defects.count()).about(defects.examples)});
  statistics_ = {};
  co_return MeshStatus::kStalled;
}

}  // namespace tetrafront
