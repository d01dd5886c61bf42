#include "model/check_patch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "model/check_fold.h"
#include "model/check_holes.h"
#include "model/check_loops.h"
#include "model/check_tube.h"
#include "model/patch_surface.h"

namespace tetrafront {

namespace {

/// Samples per curved line in the search for lines off the plane.
constexpr std::uint32_t kPlaneSamples = 16;
/// The mid-point of an isoparametric patch's line must project into the middle half of the chord;
/// closer to one end, a straight line would run back over itself.
constexpr double kMidPointMargin = 0.25;

/// Number of points off a plane that are named; more would hide the farthest ones.
constexpr std::size_t kMaxNamed = 8;

class PatchCheck {
 public:
  PatchCheck(const ResolvedModel& model, PatchId patch, MovedPointFinder& movedPoints,
             std::vector<Diagnostic>& diagnostics)
      : model_(&model),
        patch_(patch),
        drawn_(&model.model().patches[patch.index()]),
        movedPoints_(&movedPoints),
        diagnostics_(&diagnostics) {}

  bool run() {
    if (drawn_->type == PatchType::kTube) return checkTube();
    return drawn_->type == PatchType::kPlanar ? checkPlanar() : checkCurved();
  }

 private:
  void report(Diagnostic found, const std::vector<LineId>& lines, const Vec3& position) {
    diagnostics_->push_back(std::move(found).about(patchAndLines(patch_, lines)).at(position));
  }

  [[nodiscard]] double extent() const {
    return loopExtent(*model_, spanningLoops(*drawn_), kPlaneSamples);
  }

  // ---- planar ----------------------------------------------------------------------------------

  bool checkPlanar() {
    const LoopPlane plane = loopPlane(*model_, drawn_->loops.front());
    const double size = extent();
    if (!(glm::length(plane.areaVector) > Tolerance(size).area())) {
      report(diagnose<DiagnosticCode::kDegeneratePatch>(), {}, plane.origin);
      return false;
    }
    const PlanarSurface surface(plane.origin, plane.areaVector, plane.firstDirection);
    const bool flat = checkFlatness(surface, size);
    // If the loops leave the plane, they cannot be compared.
    if (flat && checkRepeatedLines()) checkLoopsApart(surface, size);
    return true;
  }

  bool checkFlatness(const PlanarSurface& surface, double size) {
    double worst = kPlaneTolerance * size;
    std::optional<LineId> worstLine;
    Vec3 position(0.0);
    for (const Loop& loop : drawn_->loops) {
      for (const OrientedLine& line : loop) {
        for (std::uint32_t i = 0; i <= kPlaneSamples; ++i) {
          const Vec3 sample = model_->curve(line).position(static_cast<double>(i) / kPlaneSamples);
          const double distance = std::fabs(surface.distance(sample));
          if (distance <= worst) continue;
          worst = distance;
          worstLine = LineId(line.line);
          position = sample;
        }
      }
    }
    if (!worstLine) return true;
    if (!reportMovedPoints(size))
      report(diagnose<DiagnosticCode::kNotPlanar>(worst), {*worstLine}, position);
    return false;
  }

  /// Names the points that the user moved out of the plane, if they can be identified.
  bool reportMovedPoints(double size) {
    const MovedPoints moved = movedPoints_->find(patch_, size);
    if (moved.points.empty()) return false;
    const PointId farthest = moved.points.front();
    report(diagnose<DiagnosticCode::kNotPlanar>(moved.distance), linesThrough(farthest),
           model_->model().points[farthest.index()]);
    for (std::size_t i = 0; i < std::min(moved.points.size(), kMaxNamed); ++i)
      diagnostics_->back().entities.push_back({EntityKind::kPoint, moved.points[i].value});
    return true;
  }

  [[nodiscard]] std::vector<LineId> linesThrough(PointId point) const {
    std::vector<LineId> lines;
    for (const Loop& loop : drawn_->loops) {
      for (const OrientedLine& line : loop) {
        const std::vector<std::uint32_t>& points = model_->model().lines[line.line].points;
        const bool passes = std::ranges::find(points, point.value) != points.end();
        if (passes && std::ranges::find(lines, LineId(line.line)) == lines.end())
          lines.push_back(LineId(line.line));
      }
    }
    return lines;
  }

  /// Checks that no line or point is used twice.
  bool checkRepeatedLines() {
    std::vector<LineStart> starts;
    for (const Loop& loop : drawn_->loops) appendStarts(*model_, loop, starts);
    std::vector<LineId> lines;
    for (const LineStart& start : starts) lines.push_back(start.line);
    stableSort(lines);
    if (const auto twice = std::ranges::adjacent_find(lines); twice != lines.end()) {
      report(diagnose<DiagnosticCode::kLoopsIntersect>(), {*twice}, model_->curve(*twice).start());
      return false;
    }
    const std::optional<RepeatedPoint> twice = findRepeatedPoint(std::move(starts));
    if (!twice) return true;
    report(diagnose<DiagnosticCode::kLoopsIntersect>(), {twice->firstLine, twice->secondLine},
           model_->model().points[twice->point.index()]);
    return false;
  }

  void checkLoopsApart(const PlanarSurface& surface, double size) {
    std::vector<PlaneLoop> loops;
    for (const Loop& loop : drawn_->loops) loops.push_back(layOutLoop(*model_, loop, surface));
    if (const std::optional<LoopContact> contact = findContact(loops, Tolerance(size))) {
      report(diagnose<DiagnosticCode::kLoopsIntersect>(), {contact->firstLine, contact->secondLine},
             surface.evaluate(contact->position).position);
      return;
    }
    if (const std::optional<std::size_t> hole = findMisplacedHole(loops))
      report(diagnose<DiagnosticCode::kHoleOutside>(), {LineId(drawn_->loops[*hole].front().line)},
             surface.evaluate(loops[*hole].points.front()).position);
  }

  // ---- tubes -----------------------------------------------------------------------------------

  bool checkTube() {
    if (!checkRepeatedLines()) return false;
    const std::optional<TubeDefect> defect = findTubeDefect(*model_, *drawn_, Tolerance(extent()));
    if (!defect) return true;
    if (!defect->isContact) {
      report(diagnose<DiagnosticCode::kDegeneratePatch>(), {}, defect->position);
      return false;
    }
    std::vector<LineId> lines;
    for (const Loop& loop : drawn_->loops) lines.push_back(LineId(loop.front().line));
    report(diagnose<DiagnosticCode::kLoopsIntersect>(), lines, defect->position);
    return false;
  }

  // ---- curved ----------------------------------------------------------------------------------

  bool checkCurved() {
    if (!checkSeams() || !checkCorners() || !checkSections()) return false;
    const UnitSurface surface = unitSurface(*model_, *drawn_);
    const SmoothCorners corners =
        isIsoparametric() ? SmoothCorners::kFold : SmoothCorners::kAllowed;
    const std::optional<SurfaceDefect> defect =
        findSurfaceDefect(surface, corners, Tolerance(extent()));
    if (!defect) {
      checkHoles();
      return true;
    }
    report(diagnose<DiagnosticCode::kDegeneratePatch>(), offCentreLines(), defect->position);
    return !defect->hasNoArea;
  }

  void checkHoles() {
    if (drawn_->loops.size() < 2) return;
    std::optional<Diagnostic> defect =
        findHoleDefect(*model_, patch_, PatchSurface(*model_, *drawn_));
    if (defect) diagnostics_->push_back(std::move(*defect));
  }

  [[nodiscard]] bool isIsoparametric() const {
    return drawn_->type == PatchType::kIsoparametricTriangle ||
           drawn_->type == PatchType::kSerendipity;
  }

  /// Finds the lines of an isoparametric patch whose mid-points are too close to one end.
  [[nodiscard]] std::vector<LineId> offCentreLines() const {
    std::vector<LineId> lines;
    if (!isIsoparametric()) return lines;
    for (const OrientedLine& line : drawn_->loops.front()) {
      const std::span<const Vec3> points = model_->curve(LineId(line.line)).points();
      const Vec3 chord = points[2] - points[0];
      const double foot = glm::dot(points[1] - points[0], chord) / glm::dot(chord, chord);
      if (foot < kMidPointMargin || foot > 1.0 - kMidPointMargin)
        lines.push_back(LineId(line.line));
    }
    return lines;
  }

  /// Checks that a line is used twice only as a seam: in both directions, by opposite lines of a
  /// quadrilateral (as in a tube).
  bool checkSeams() {
    const Loop& loop = drawn_->loops.front();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (std::size_t k = i + 1; k < loop.size(); ++k) {
        const bool seam = loop.size() == 4 && k == i + 2 && loop[i].reversed != loop[k].reversed;
        if (loop[i].line != loop[k].line || seam) continue;
        report(diagnose<DiagnosticCode::kLoopsIntersect>(), {LineId(loop[i].line)},
               model_->curve(LineId(loop[i].line)).start());
        return false;
      }
    }
    return true;
  }

  /// Checks that opposite corners of a quadrilateral, or all corners of a triangle, are distinct:
  /// equation (14) does not make a cone from a closed line.
  bool checkCorners() {
    const Loop& loop = drawn_->loops.front();
    const std::size_t apart = loop.size() == 4 ? 2 : 1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t k = (i + apart) % loop.size();
      if (model_->startPoint(loop[i]) != model_->startPoint(loop[k])) continue;
      report(diagnose<DiagnosticCode::kLoopsIntersect>(),
             {LineId(loop[i].line), LineId(loop[k].line)}, model_->curve(loop[i]).start());
      return false;
    }
    return true;
  }

  /// Checks that the sections of a loft run from its fourth line to its second, each further along than the one before.
  bool checkSections() {
    if (drawn_->type != PatchType::kLoft) return true;
    const Loop& loop = drawn_->loops.front();
    const OrientedCurve sides[2] = {model_->curve(loop[3]).reverse(), model_->curve(loop[1])};
    double before[2] = {0.0, 0.0};
    for (const OrientedLine& section : drawn_->sections) {
      const OrientedCurve curve = model_->curve(section);
      const Vec3 ends[2] = {curve.position(0.0), curve.position(1.0)};
      for (int side = 0; side < 2; ++side) {
        const std::optional<double> t = parameterOfPoint(sides[side], ends[side]);
        if (t && *t > before[side] && *t < 1.0) {
          before[side] = *t;
          continue;
        }
        report(diagnose<DiagnosticCode::kMisplacedSection>(), {LineId(section.line)}, ends[side]);
        return false;
      }
    }
    return true;
  }

  const ResolvedModel* model_;
  PatchId patch_;
  const Patch* drawn_;
  MovedPointFinder* movedPoints_;
  std::vector<Diagnostic>* diagnostics_;
};

}  // namespace

bool checkPatchShape(const ResolvedModel& model, PatchId patch, MovedPointFinder& movedPoints,
                     std::vector<Diagnostic>& diagnostics) {
  return PatchCheck(model, patch, movedPoints, diagnostics).run();
}

}  // namespace tetrafront
