#include "preview/check_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/ids.h"
#include "field/grid_locator.h"
#include "field/size_sources.h"
#include "geom/coordinates.h"
#include "model/check_closure.h"
#include "model/check_model.h"
#include "boundary/boundary.h"
#include "preview/check_coverage.h"
#include "sizing/expected_count.h"
#include "preview/model_sampling.h"
#include "preview/intersecting_patches.h"

namespace tetrafront {
namespace {

/// A model whose volume is not known fills some part of its box.
constexpr double kLeastPart = 0.05;

/// Area of the equilateral triangle of edge 1.
constexpr double kUnitTriangle = 0.4330127018922193;
/// A tetrahedron has at most this many triangles of the boundary.
constexpr double kTrianglesPerTetrahedron = 4.0;

/// Returns a lower estimate of the number of tetrahedra at a drawn surface's triangles. Thin regions
/// have far more than their volume suggests. The largest size on each sampled triangle counts.
double tetrahedraAtTriangles(const ModelPreview& preview, const SizeField& field);

double tetrahedraAtTriangles(const ModelPreview& preview, const SizeField& field) {
  double triangles = 0.0;
  FieldHint hint;
  for (std::size_t t = 0; t < preview.patchTriangles.size() / 3; ++t) {
    std::array<Vec3, 3> corners;
    Vec3 centre(0.0);
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = sampleAt(preview.patchPoints, preview.patchTriangles[3 * t + k]);
      centre += corners[k] * (1.0 / 3.0);
      size = std::max(size, field.sizeAt(corners[k], hint));
    }
    size = std::max(size, field.sizeAt(centre, hint));
    const double twiceArea =
        glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    triangles += 0.5 * twiceArea / (kUnitTriangle * size * size);
  }
  return triangles / kTrianglesPerTetrahedron;
}

}  // namespace

class InputChecker::Impl {
 public:
  Impl(const Model& model, const BackgroundGrid& grid, const MeshOptions& options)
      : model_(&model), grid_(&grid), options_(&options), examiner_(model) {}

  bool advance(std::uint32_t budget) {
    const std::uint32_t patches = patchesWithin(budget);
    switch (stage_) {
      case Stage::kModel:
        if (!examiner_.advance(patches)) break;
        found_ = examiner_.take();
        report(std::move(found_.diagnostics));
        closure_ = checkClosure(*model_, found_);
        report(std::move(closure_.diagnostics));
        sampler_.emplace(*model_, found_);
        stage_ = Stage::kSample;
        break;
      case Stage::kSample:
        if (!sampler_->advance(patches)) break;
        sampled_ = sampler_->take();
        stage_ = Stage::kMeet;
        break;
      case Stage::kMeet:
        report(findIntersectingPatches(*model_, found_, sampled_));
        stage_ = Stage::kClose;
        break;
      case Stage::kClose:
        if (!anyError(diagnostics_)) closeSurface(closure_);
        stage_ = Stage::kGrid;
        break;
      case Stage::kGrid:
        if (!ofGrid_) {
          std::vector<Diagnostic> ofOptions = checkOptions(*options_);
          areSoundOptions_ = ofOptions.empty();
          report(std::move(ofOptions));
          ofGrid_.emplace(*grid_, usesGrid() ? GridPart::kWhole : GridPart::kSources);
        }
        if (ofGrid_->advance(budget)) takeGrid();
        break;
      case Stage::kLocate:
        if (!locator_->advance(budget)) break;
        field_ = SizeField::fromGrid(locator_->take());
        locator_.reset();
        stage_ = Stage::kSizes;
        break;
      case Stage::kSizes:
        checkSizes();
        sampled_.preview.diagnostics = std::move(diagnostics_);
        stage_ = Stage::kFinished;
        break;
      case Stage::kFinished:
        break;
    }
    return stage_ == Stage::kFinished;
  }

  [[nodiscard]] double fraction() const {
    return static_cast<double>(stage_) / static_cast<double>(Stage::kFinished);
  }

  [[nodiscard]] CheckedInput take() { return {std::move(sampled_.preview), std::move(field_)}; }

 private:
  enum class Stage : std::uint8_t {
    kModel,
    kSample,
    kMeet,
    kClose,
    kGrid,
    kLocate,
    kSizes,
    kFinished
  };

  void report(std::vector<Diagnostic> found) {
    for (Diagnostic& diagnostic : found) diagnostics_.push_back(std::move(diagnostic));
  }

  /// The sampled patches as one surface, turned outward. One body needs no more than the turning
  /// of its patches; several are nested by the check that meshes undergo.
  void closeSurface(const Closure& closure) {
    // A surface of which some patch cannot be sampled encloses nothing.
    if (std::ranges::count(sampled_.isJoined, 0) > 0) return;
    SurfaceMesh surface = surfaceOf(closure);
    const bool isOneBody =
        closure.isPlain &&
        std::ranges::all_of(closure.component, [](std::uint32_t first) { return first == 0; });
    if (isOneBody) {
      volume_ = std::fabs(enclosedVolume(surface));
      return;
    }
    std::vector<Diagnostic> found;
    const BoundaryResult closed =
        closeBoundary(surface, BoundarySource::kDrawnPatches, found, options_->enclosed);
    // Samples are too coarse to be blamed for what lies where: that is left to the mesh.
    const auto isPlacing = [](const Diagnostic& diagnostic) {
      return diagnostic.severity == Severity::kError &&
             diagnostic.code != DiagnosticCode::kDanglingSheet;
    };
    if (std::ranges::any_of(found, isPlacing)) return;
    if (closed.isValid) volume_ = enclosedVolume(surface);
    for (Diagnostic& diagnostic : found) {
      if (diagnostic.code == DiagnosticCode::kReorientedPatch) continue;
      // The samples' triangles are nobody else's.
      std::erase_if(diagnostic.entities,
                    [](const Entity& entity) { return entity.kind == EntityKind::kTriangle; });
      diagnostics_.push_back(std::move(diagnostic));
    }
  }

  [[nodiscard]] SurfaceMesh surfaceOf(const Closure& closure) const {
    const ModelPreview& preview = sampled_.preview;
    SurfaceMesh surface;
    const auto highest = std::ranges::max_element(sampled_.nodes);
    std::vector<std::uint32_t> numbers(highest == sampled_.nodes.end() ? 0 : *highest + 1,
                                       kNoIndex);
    const auto numberOf = [&](std::uint32_t point) {
      std::uint32_t& number = numbers[sampled_.nodes[point]];
      if (number == kNoIndex) {
        number = static_cast<std::uint32_t>(surface.points.size() / 3);
        for (std::size_t axis = 0; axis < 3; ++axis)
          surface.points.push_back(preview.patchPoints[3 * std::size_t{point} + axis]);
      }
      return number;
    };
    for (std::uint32_t patch = 0; patch < model_->patches.size(); ++patch) {
      for (std::uint32_t t = preview.patchOffsets[patch]; t < preview.patchOffsets[patch + 1];
           ++t) {
        std::array<std::uint32_t, 3> nodes{};
        for (std::size_t k = 0; k < 3; ++k)
          nodes[k] = numberOf(preview.patchTriangles[3 * std::size_t{t} + k]);
        // The tip of a side without length.
        if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[2] == nodes[0]) continue;
        if (closure.isTurned[patch] != 0) std::swap(nodes[1], nodes[2]);
        surface.triangles.insert(surface.triangles.end(), nodes.begin(), nodes.end());
        surface.trianglePatch.push_back(patch);
      }
    }
    return surface;
  }

  // ---- sizes -----------------------------------------------------------------------------------

  [[nodiscard]] bool usesGrid() const { return options_->size == 0.0; }

  /// Sizes are known where nothing is wrong with them.
  void takeGrid() {
    std::vector<Diagnostic> found = ofGrid_->take();
    const bool known = found.empty() && areSoundOptions_;
    report(std::move(found));
    stage_ = Stage::kSizes;
    if (!known) return;
    if (!usesGrid()) {
      field_ = SizeField::uniform(options_->size);
      return;
    }
    locator_.emplace(*grid_, options_->gradation - 1.0);
    stage_ = Stage::kLocate;
  }

  void checkSizes() {
    if (!field_) return;
    field_->addSources(grid_->sources);
    if (usesGrid()) report(checkCoverage(*model_, sampled_.preview, *field_));
    const std::optional<Extent> extent = extentOf(sampled_.preview);
    if (!extent) return;
    checkLargest(*extent);
    checkCount(*extent);
  }

  void checkLargest(const Extent& extent) {
    const std::vector<double>& points = sampled_.preview.linePoints;
    if (points.empty()) return;
    FieldHint hint;
    double smallest = field_->sizeAt(sampleAt(points, 0), hint);
    for (std::size_t i = 1; i < points.size() / 3; ++i)
      smallest = std::min(smallest, field_->sizeAt(sampleAt(points, i), hint));
    const Vec3 across = extent.high - extent.low;
    const double largest = std::max(across.x, std::max(across.y, across.z));
    if (!(smallest > largest)) return;
    Diagnostic tooLarge;
    tooLarge.code = DiagnosticCode::kSizeTooLarge;
    tooLarge.severity = Severity::kWarning;
    tooLarge.values = {smallest, largest};
    diagnostics_.push_back(std::move(tooLarge));
  }

  void checkCount(const Extent& extent) {
    const Vec3 across = extent.high - extent.low;
    const double volume = volume_.value_or(kLeastPart * across.x * across.y * across.z);
    const double expected = std::max(volume * tetrahedraPerVolume(extent.low, extent.high, *field_),
                                     tetrahedraAtTriangles(sampled_.preview, *field_));
    if (expected <= static_cast<double>(options_->maxTetrahedra)) return;
    Diagnostic tooMany;
    tooMany.code = DiagnosticCode::kTooManyElements;
    tooMany.values = {cappedCount(expected), static_cast<double>(options_->maxTetrahedra)};
    diagnostics_.push_back(std::move(tooMany));
  }

  const Model* model_;
  const BackgroundGrid* grid_;
  const MeshOptions* options_;
  Stage stage_ = Stage::kModel;
  ModelChecker examiner_;
  CheckedModel found_;
  Closure closure_;
  std::optional<SurfaceSampler> sampler_;
  std::vector<Diagnostic> diagnostics_;
  SampledModel sampled_;
  std::optional<double> volume_;  ///< enclosed, where the surface closes
  bool areSoundOptions_ = false;
  std::optional<BackgroundGridCheck> ofGrid_;
  std::optional<GridLocatorBuilder> locator_;
  std::optional<SizeField> field_;
};

bool anyError(const std::vector<Diagnostic>& diagnostics) {
  return std::ranges::any_of(diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::kError;
  });
}

std::vector<Diagnostic> checkOptions(const MeshOptions& options) {
  const std::array<double, 3> given{options.size, options.growth, options.gradation};
  const std::array<bool, 3> sound{
      options.size >= 0.0 && options.size <= kLargestCoordinate,
      options.growth >= 0.0 && options.growth <= kMostGrowth,
      options.gradation == 0.0 || (options.gradation > 1.0 && options.gradation <= kMostGradation)};
  std::vector<Diagnostic> found;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (sound[i]) continue;
    Diagnostic bad;
    bad.code = DiagnosticCode::kOptionOutOfRange;
    bad.values = {static_cast<double>(i), given[i]};
    found.push_back(std::move(bad));
  }
  return found;
}

InputChecker::InputChecker(const Model& model, const BackgroundGrid& grid,
                           const MeshOptions& options)
    : impl_(std::make_unique<Impl>(model, grid, options)) {}
InputChecker::InputChecker(InputChecker&&) noexcept = default;
InputChecker& InputChecker::operator=(InputChecker&&) noexcept = default;
InputChecker::~InputChecker() = default;

bool InputChecker::advance(std::uint32_t budget) { return impl_->advance(budget); }
double InputChecker::fraction() const { return impl_->fraction(); }
CheckedInput InputChecker::take() { return impl_->take(); }

CheckedInput checkInput(const Model& model, const BackgroundGrid& grid,
                        const MeshOptions& options) {
  InputChecker examiner(model, grid, options);
  while (!examiner.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return examiner.take();
}

class ModelPreviewer::Impl {
 public:
  Impl(Model model, BackgroundGrid grid, const MeshOptions& options)
      : model_(std::move(model)),
        grid_(std::move(grid)),
        options_(options),
        examiner_(model_, grid_, options_) {}

  bool advance(std::uint32_t budget) {
    if (!isFinished_ && examiner_.advance(budget)) {
      isFinished_ = true;
      preview_ = std::move(examiner_.take().preview);
    }
    return isFinished_;
  }
  [[nodiscard]] double fraction() const { return examiner_.fraction(); }
  [[nodiscard]] const ModelPreview& result() const { return preview_; }

 private:
  Model model_;
  BackgroundGrid grid_;
  MeshOptions options_;
  InputChecker examiner_;
  bool isFinished_ = false;
  ModelPreview preview_;
};

ModelPreviewer::ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(grid), options)) {}
ModelPreviewer::ModelPreviewer(ModelPreviewer&&) noexcept = default;
ModelPreviewer& ModelPreviewer::operator=(ModelPreviewer&&) noexcept = default;
ModelPreviewer::~ModelPreviewer() = default;

bool ModelPreviewer::advance(std::uint32_t budget) { return impl_->advance(std::max(budget, 1U)); }
double ModelPreviewer::fraction() const { return impl_->fraction(); }
const ModelPreview& ModelPreviewer::result() const { return impl_->result(); }

ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                          const MeshOptions& options) {
  return checkInput(model, grid, options).preview;
}

}  // namespace tetrafront
