#include "preview/check_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "field/check_background_grid.h"
#include "field/grid_locator_builder.h"
#include "model/check_closure.h"
#include "preview/check_coverage.h"
#include "preview/intersecting_patches.h"
#include "preview/model_sampler.h"
#include "preview/sampled_volume.h"
#include "preview/surface_sampler.h"
#include "sizing/check_options.h"
#include "sizing/expected_count.h"
#include "sizing/memory_limit.h"
#include "sizing/most_demanding.h"
#include "sizing/volume_sizes.h"

namespace tetrafront {
namespace {

/// Volume of a model whose volume is not known / volume of its box: a lower estimate.
constexpr double kMinFilledPart = 0.05;
/// Area of the equilateral triangle with edges of length 1.
constexpr double kUnitTriangleArea = 0.4330127018922193;
/// Largest number of boundary triangles that one tetrahedron can have.
constexpr double kTrianglesPerTetrahedron = 4.0;

/// Returns a lower estimate of the number of tetrahedra at a drawn surface's triangles. Thin regions have far more than
/// their volume suggests. The largest size on each sampled triangle counts.
double tetrahedraAtTriangles(const ModelPreview& preview, const SizeField& field) {
  double triangles = 0.0;
  FieldHint hint;
  for (std::size_t t = 0; t < preview.patchTriangles.size() / 3; ++t) {
    std::array<Vec3, 3> corners;
    Vec3 centroid(0.0);
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = sampleAt(preview.patchPoints, preview.patchTriangles[3 * t + k]);
      centroid += corners[k] * (1.0 / 3.0);
      size = std::max(size, field.sizeAt(corners[k], hint));
    }
    size = std::max(size, field.sizeAt(centroid, hint));
    const double twiceArea =
        glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    triangles += 0.5 * twiceArea / (kUnitTriangleArea * size * size);
  }
  return triangles / kTrianglesPerTetrahedron;
}

class InputCheck {
 public:
  InputCheck(const Model& model, const BackgroundGrid& grid, const MeshOptions& options)
      : model_(&model), grid_(&grid), options_(&options) {}

  Task<CheckedInput> run(Work& work) {
    work.beginPart(0.8);
    co_await checkShape(work);
    work.beginPart(0.9);
    co_await findField(work);
    co_await work.yield();
    if (field_) checkSizes();
    sampled_.preview.diagnostics = std::move(diagnostics_);
    co_return CheckedInput{std::move(sampled_.preview), std::move(field_), std::move(boundary_)};
  }

 private:
  void report(std::vector<Diagnostic> found) {
    for (Diagnostic& diagnostic : found) diagnostics_.push_back(std::move(diagnostic));
  }

  // ---- points, lines, patches, and the surface that they form ------------------------------------

  Task<> checkShape(Work& work) {
    work.beginPart(0.35);
    CheckedModel found = co_await checkModel(work, *model_);
    report(std::move(found.diagnostics));
    Closure closure = checkClosure(*model_, found);
    report(std::move(closure.diagnostics));
    work.beginPart(0.7);
    // A member, because sampled triangles also limit the sizes.
    SampledModel sampled = co_await sampleSurface(work, *model_, found);
    sampled_ = std::move(sampled);
    report(findIntersectingPatches(*model_, found, sampled_));
    work.beginPart(1.0);
    co_await work.yield();
    if (anyError(diagnostics_)) co_return;
    SampledVolume enclosed = findSampledVolume(*model_, sampled_, closure, options_->innerShells);
    volume_ = enclosed.volume;
    boundary_ = std::move(enclosed.boundary);
    report(std::move(enclosed.diagnostics));
    co_await work.yield();
  }

  // ---- sizes -----------------------------------------------------------------------------------

  [[nodiscard]] bool needsGrid() const { return options_->size == 0.0; }

  /// Makes the size field if options and grid are valid.
  Task<> findField(Work& work) {
    std::vector<Diagnostic> ofOptions = checkOptions(*options_);
    const bool areOptionsValid = ofOptions.empty();
    report(std::move(ofOptions));
    const GridPart part = needsGrid() ? GridPart::kWhole : GridPart::kSources;
    std::vector<Diagnostic> found = co_await checkBackgroundGrid(work, *grid_, part);
    const bool isValid = areOptionsValid && found.empty();
    report(std::move(found));
    if (!isValid) co_return;
    if (needsGrid()) {
      GridLocator locator = co_await buildGridLocator(work, *grid_, options_->gradation - 1.0);
      field_ = SizeField::fromGrid(std::move(locator));
    } else {
      field_ = SizeField::uniform(options_->size);
    }
    field_->capSizes(sizeForVolume(options_->maxVolume), {});
    field_->addSources(grid_->sources);
  }

  void checkSizes() {
    if (needsGrid()) report(checkCoverage(*model_, sampled_.preview, *field_));
    const std::optional<Bounds> bounds = boundsOf(sampled_.preview);
    if (!bounds) return;
    checkLargestSize(*bounds);
    checkCount(*bounds);
  }

  void checkLargestSize(const Bounds& bounds) {
    const std::vector<double>& points = sampled_.preview.linePoints;
    if (points.empty()) return;
    FieldHint hint;
    double smallest = field_->sizeAt(sampleAt(points, 0), hint);
    for (std::size_t i = 1; i < points.size() / 3; ++i)
      smallest = std::min(smallest, field_->sizeAt(sampleAt(points, i), hint));
    const Vec3 edges = bounds.high - bounds.low;
    const double largest = std::max(edges.x, std::max(edges.y, edges.z));
    if (!(smallest > largest)) return;
    diagnostics_.push_back(diagnose<DiagnosticCode::kSizeTooLarge>(smallest, largest)
                               .withSeverity(Severity::kWarning));
  }

  void checkCount(const Bounds& bounds) {
    const Vec3 edges = bounds.high - bounds.low;
    const double volume = volume_.value_or(kMinFilledPart * edges.x * edges.y * edges.z);
    const double atTriangles = tetrahedraAtTriangles(sampled_.preview, *field_);
    const double expected =
        std::max(volume * tetrahedraPerVolume(bounds.low, bounds.high, *field_), atTriangles);
    const bool hasLattices = options_->interior != Interior::kFront && !field_->isStretched();
    const double limit =
        std::min(static_cast<double>(options_->maxTetrahedra),
                 std::floor(elementsWithin(kAddressableBytes,
                                           kTrianglesPerTetrahedron * atTriangles, hasLattices)));
    if (expected <= limit) return;
    Diagnostic& tooMany = diagnostics_.emplace_back(tooManyElements(expected, limit));
    nameMostDemanding(tooMany, *grid_, *options_, bounds);
  }

  const Model* model_;
  const BackgroundGrid* grid_;
  const MeshOptions* options_;
  std::vector<Diagnostic> diagnostics_;
  SampledModel sampled_;
  std::optional<double> volume_;  ///< enclosed, if the surface is closed
  SurfaceMesh boundary_;
  std::optional<SizeField> field_;
};

}  // namespace

Task<CheckedInput> checkInput(Work& work, const Model& model, const BackgroundGrid& grid,
                              const MeshOptions& options) {
  InputCheck check(model, grid, options);
  CheckedInput checked = co_await check.run(work);
  co_return checked;
}

CheckedInput checkInput(const Model& model, const BackgroundGrid& grid,
                        const MeshOptions& options) {
  Job job([&](Work& work) { return checkInput(work, model, grid, options); });
  return job.finish();
}

}  // namespace tetrafront
