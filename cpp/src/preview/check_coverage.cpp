#include "preview/check_coverage.h"

#include <cstdint>
#include <utility>

#include "base/diagnostics.h"
#include "preview/model_sampler.h"
#include "preview/surface_sampler.h"

namespace tetrafront {
namespace {

/// Intervals between the samples of a straight line. A grid of few tetrahedra has no smaller notches.
constexpr int kStraightIntervals = 48;

class CoverageCheck {
 public:
  CoverageCheck(const Model& model, const ModelPreview& preview, const SizeField& field)
      : model_(&model),
        preview_(&preview),
        field_(&field),
        isPointOutside_(model.points.size(), 0),
        isLineOutside_(model.lines.size(), 0) {}

  std::vector<Diagnostic> run() {
    for (std::uint32_t line = 0; line < model_->lines.size(); ++line) {
      if (isSampled(line)) checkLine(line);
    }
    for (std::uint32_t patch = 0; patch < model_->patches.size(); ++patch) checkPatch(patch);
    return std::move(found_);
  }

 private:
  /// The samples that are not covered.
  struct Outside {
    std::size_t count = 0;
    Vec3 first{0.0};
  };

  void check(const Vec3& position, Outside& outside) {
    if (field_->covers(position, hint_)) return;
    if (outside.count++ == 0) outside.first = position;
  }

  void report(EntityKind kind, std::uint32_t index, const Outside& outside) {
    found_.push_back(diagnose<DiagnosticCode::kOutsideBackgroundGrid>(outside.count)
                         .about({{kind, index}})
                         .at(outside.first));
  }

  [[nodiscard]] bool isSampled(std::uint32_t line) const {
    return preview_->lineOffsets[line + 1] > preview_->lineOffsets[line];
  }

  void checkLine(std::uint32_t line) {
    for (const std::uint32_t point : model_->lines[line].points) {
      if (isPointOutside_[point] == 0) checkPoint(point);
      isLineOutside_[line] |= isPointOutside_[point];
    }
    if (isLineOutside_[line] != 0) return;
    Outside outside;
    const std::size_t first = preview_->lineOffsets[line];
    const std::size_t last = preview_->lineOffsets[line + 1];
    for (std::size_t i = first; i < last; ++i) check(sampleAt(preview_->linePoints, i), outside);
    if (last - first == 2) {  // a straight line has two samples
      const Vec3 from = sampleAt(preview_->linePoints, first);
      const Vec3 to = sampleAt(preview_->linePoints, first + 1);
      for (int k = 1; k < kStraightIntervals; ++k)
        check(from + (static_cast<double>(k) / kStraightIntervals) * (to - from), outside);
    }
    if (outside.count == 0) return;
    isLineOutside_[line] = 1;
    report(EntityKind::kLine, line, outside);
  }

  void checkPoint(std::uint32_t point) {
    Outside outside;
    check(model_->points[point], outside);
    if (outside.count == 0) return;
    isPointOutside_[point] = 1;
    report(EntityKind::kPoint, point, outside);
  }

  void checkPatch(std::uint32_t patch) {
    const std::size_t first = preview_->patchOffsets[patch];
    const std::size_t last = preview_->patchOffsets[patch + 1];
    if (first == last) return;
    for (const Loop& loop : model_->patches[patch].loops) {
      for (const OrientedLine& walked : loop) {
        if (isLineOutside_[walked.line] != 0) return;
      }
    }
    Outside outside;
    for (std::size_t t = first; t < last; ++t) {
      Vec3 centroid(0.0);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 corner = sampleAt(preview_->patchPoints, preview_->patchTriangles[3 * t + k]);
        check(corner, outside);
        centroid += corner;
      }
      // The triangles of a planar patch may span it from border to border. A curved patch has a fine lattice, and the
      // centroids of its triangles do not lie on it.
      if (model_->patches[patch].type == PatchType::kPlanar) check(centroid * (1.0 / 3.0), outside);
    }
    if (outside.count > 0) report(EntityKind::kPatch, patch, outside);
  }

  const Model* model_;
  const ModelPreview* preview_;
  const SizeField* field_;
  FieldHint hint_;
  std::vector<std::uint8_t> isPointOutside_;
  std::vector<std::uint8_t> isLineOutside_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> checkCoverage(const Model& model, const ModelPreview& preview,
                                      const SizeField& field) {
  return CoverageCheck(model, preview, field).run();
}

std::vector<Diagnostic> checkCoverage(const Model& model, const SizeField& field) {
  return checkCoverage(model, sampleModel(model), field);
}

}  // namespace tetrafront
