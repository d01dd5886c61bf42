#include "model/check_holes.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "model/check_loops.h"
#include "model/patch_projection.h"

namespace tetrafront {

namespace {

/// Samples per line, straight ones included: in the plane of a curved patch no line is straight.
constexpr std::uint32_t kHoleSamples = 32;

class HoleCheck {
 public:
  HoleCheck(const ResolvedModel& model, PatchId patch, const PatchSurface& surface)
      : model_(&model),
        patch_(patch),
        drawn_(&model.model().patches[patch.index()]),
        surface_(&surface),
        projection_(surface) {}

  std::optional<Diagnostic> run() {
    if (std::optional<Diagnostic> repeated = findRepetition()) return repeated;
    std::vector<PlaneLoop> loops{layOutBorder()};
    for (std::size_t hole = 1; hole < drawn_->loops.size(); ++hole) {
      loops.push_back(layOutHole(drawn_->loops[hole]));
      if (worst_ > kHoleTolerance * loopExtent(*model_, {&drawn_->loops[hole], 1}, kHoleSamples))
        return defect(diagnose<DiagnosticCode::kHoleOffPatch>(worst_), {worstLine_},
                      worstPosition_);
    }
    if (const std::optional<LoopContact> contact =
            findContact(loops, Tolerance(extentInPlane(loops))))
      return defect(diagnose<DiagnosticCode::kLoopsIntersect>(),
                    {contact->firstLine, contact->secondLine},
                    surface_->evaluate(contact->position).position);
    if (const std::optional<std::size_t> hole = findMisplacedHole(loops))
      return defect(diagnose<DiagnosticCode::kHoleOutside>(),
                    {LineId(drawn_->loops[*hole].front().line)},
                    surface_->evaluate(loops[*hole].points.front()).position);
    return std::nullopt;
  }

 private:
  [[nodiscard]] Diagnostic defect(Diagnostic found, const std::vector<LineId>& lines,
                                  const Vec3& position) const {
    return std::move(found).about(patchAndLines(patch_, lines)).at(position);
  }

  /// Checks that holes share no line or point with each other, with themselves, or with the outer
  /// loop. The outer loop may use its own seam twice.
  [[nodiscard]] std::optional<Diagnostic> findRepetition() const {
    std::vector<LineStart> starts;
    appendStarts(*model_, drawn_->loops.front(), starts);
    stableSort(starts);
    const auto seams = std::ranges::unique(starts, {}, &LineStart::point);
    starts.erase(seams.begin(), seams.end());
    for (const Loop& hole : std::span(drawn_->loops).subspan(1))
      appendStarts(*model_, hole, starts);
    const std::optional<RepeatedPoint> twice = findRepeatedPoint(std::move(starts));
    if (!twice) return std::nullopt;
    return defect(diagnose<DiagnosticCode::kLoopsIntersect>(),
                  {twice->firstLine, twice->secondLine},
                  model_->model().points[twice->point.index()]);
  }

  [[nodiscard]] PlaneLoop layOutBorder() const {
    PlaneLoop result;
    const Loop& outer = drawn_->loops.front();
    for (std::size_t position = 0; position < outer.size(); ++position) {
      result.points.push_back(
          surface_->boundaryToPlane(position, 0.0, model_->curve(outer[position]).start()));
      result.lines.push_back(LineId(outer[position].line));
    }
    return result;
  }

  /// Records the sample farthest from the patch.
  PlaneLoop layOutHole(const Loop& loop) {
    PlaneLoop result;
    worst_ = 0.0;
    for (const OrientedLine& line : loop) {
      const OrientedCurve curve = model_->curve(line);
      for (std::uint32_t i = 0; i < kHoleSamples; ++i) {
        const Vec3 position = curve.position(static_cast<double>(i) / kHoleSamples);
        const PatchProjection::Foot foot = projection_.project(position);
        result.points.push_back(foot.plane);
        result.lines.push_back(LineId(line.line));
        if (foot.distance <= worst_) continue;
        worst_ = foot.distance;
        worstLine_ = LineId(line.line);
        worstPosition_ = position;
      }
    }
    return result;
  }

  static double extentInPlane(const std::vector<PlaneLoop>& loops) {
    double extent = 0.0;
    for (const Vec2& point : loops.front().points)
      extent = std::max(extent, glm::length(point - loops.front().points.front()));
    return extent;
  }

  const ResolvedModel* model_;
  PatchId patch_;
  const Patch* drawn_;
  const PatchSurface* surface_;
  PatchProjection projection_;
  double worst_ = 0.0;
  LineId worstLine_;
  Vec3 worstPosition_{0.0};
};

}  // namespace

std::optional<Diagnostic> findHoleDefect(const ResolvedModel& model, PatchId patch,
                                         const PatchSurface& surface) {
  return HoleCheck(model, patch, surface).run();
}

}  // namespace tetrafront
