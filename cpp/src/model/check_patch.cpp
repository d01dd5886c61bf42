#include "model/check_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "model/check_loops.h"
#include "model/patch_surface.h"

namespace tetrafront {

namespace {

/// A patch of less area than this share of its squared extent has none.
constexpr double kLeastArea = 1e-9;
/// Samples per curved line when looking for lines off the plane.
constexpr std::uint32_t kPlaneSamples = 16;
/// Cells per direction of a Coons patch whose normals are compared.
constexpr int kFoldCells = 16;
/// A normal shorter than this share of the longest belongs to a degenerate corner, where it
/// points anywhere.
constexpr double kLeastNormal = 1e-6;
/// A turn of the normal by more than 90 degrees that persists between parameters this many times
/// halved is a fold and not a bend.
constexpr int kFoldHalvings = 24;

class PatchCheck {
 public:
  PatchCheck(const ResolvedModel& model, std::uint32_t patch, std::vector<Diagnostic>& diagnostics)
      : model_(&model),
        patch_(patch),
        drawn_(&model.model().patches[patch]),
        diagnostics_(&diagnostics) {}

  bool run() { return drawn_->type == PatchType::kPlanar ? checkPlanar() : checkCoons(); }

 private:
  void report(DiagnosticCode code, const std::vector<std::uint32_t>& lines,
              std::optional<Vec3> place, std::vector<double> values = {}) {
    Diagnostic diagnostic;
    diagnostic.code = code;
    diagnostic.entities = {{EntityKind::kPatch, patch_}};
    for (const std::uint32_t line : lines) diagnostic.entities.push_back({EntityKind::kLine, line});
    diagnostic.hasPlace = place.has_value();
    diagnostic.place = place.value_or(Vec3(0.0));
    diagnostic.values = std::move(values);
    diagnostics_->push_back(std::move(diagnostic));
  }

  [[nodiscard]] double extent() const {
    Vec3 low = model_->curve(drawn_->loops.front().front()).start();
    Vec3 high = low;
    for (const Vec3& sample : sampleLoop(*model_, drawn_->loops.front(), kPlaneSamples)) {
      low = glm::min(low, sample);
      high = glm::max(high, sample);
    }
    return glm::length(high - low);
  }

  // ---- planar ----------------------------------------------------------------------------------

  bool checkPlanar() {
    const LoopPlane plane = loopPlane(*model_, drawn_->loops.front());
    const double size = extent();
    if (!(glm::length(plane.areaVector) > kLeastArea * size * size)) {
      report(DiagnosticCode::kDegeneratePatch, {}, plane.origin);
      return false;
    }
    const PlanarSurface surface(plane.origin, plane.areaVector, plane.firstDirection);
    const bool flat = checkFlatness(surface, size);
    // Off its plane a patch's loops cannot be compared.
    if (flat && checkRepeatedLines()) checkLoopsApart(surface, size);
    return true;
  }

  bool checkFlatness(const PlanarSurface& surface, double size) {
    double worst = kPlaneTolerance * size;
    std::optional<std::uint32_t> worstLine;
    Vec3 place(0.0);
    for (const Loop& loop : drawn_->loops) {
      for (const OrientedLine& line : loop) {
        for (std::uint32_t i = 0; i <= kPlaneSamples; ++i) {
          const Vec3 sample = model_->curve(line).position(static_cast<double>(i) / kPlaneSamples);
          const double distance = std::fabs(surface.distance(sample));
          if (distance <= worst) continue;
          worst = distance;
          worstLine = line.line;
          place = sample;
        }
      }
    }
    if (worstLine) report(DiagnosticCode::kNotPlanar, {*worstLine}, place, {worst});
    return !worstLine;
  }

  /// No line twice, no point passed twice.
  bool checkRepeatedLines() {
    std::vector<std::uint32_t> lines;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> starts;  // point, line
    for (const Loop& loop : drawn_->loops) {
      for (const OrientedLine& line : loop) {
        lines.push_back(line.line);
        starts.emplace_back(model_->startPoint(line), line.line);
      }
    }
    std::ranges::sort(lines);
    if (const auto twice = std::ranges::adjacent_find(lines); twice != lines.end()) {
      report(DiagnosticCode::kLoopTouchesItself, {*twice}, model_->curve(*twice).start());
      return false;
    }
    std::ranges::sort(starts);
    const auto samePoint = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::ranges::adjacent_find(starts, samePoint);
    if (twice == starts.end()) return true;
    report(DiagnosticCode::kLoopTouchesItself, {twice->second, std::next(twice)->second},
           model_->model().points[twice->first]);
    return false;
  }

  void checkLoopsApart(const PlanarSurface& surface, double size) {
    std::vector<PlaneLoop> loops;
    for (const Loop& loop : drawn_->loops) loops.push_back(layOutLoop(*model_, loop, surface));
    if (const std::optional<LoopContact> contact = findContact(loops, size)) {
      report(DiagnosticCode::kLoopTouchesItself, {contact->firstLine, contact->secondLine},
             surface.evaluate(contact->place).position);
      return;
    }
    if (const std::optional<std::size_t> hole = findMisplacedHole(loops))
      report(DiagnosticCode::kHoleOutside, {drawn_->loops[*hole].front().line},
             surface.evaluate(loops[*hole].points.front()).position);
  }

  // ---- Coons -----------------------------------------------------------------------------------

  bool checkCoons() {
    if (!checkCorners()) return false;
    const Loop& loop = drawn_->loops.front();
    const CoonsSurface surface({model_->curve(loop[0]), model_->curve(loop[1]),
                                model_->curve(loop[2]).reverse(),
                                model_->curve(loop[3]).reverse()});
    const auto centre = [](int cell) { return (cell + 0.5) / kFoldCells; };
    std::array<std::array<Vec3, kFoldCells>, kFoldCells> normals;
    double longest = 0.0;
    for (int j = 0; j < kFoldCells; ++j) {
      for (int i = 0; i < kFoldCells; ++i) {
        normals[j][i] = normalAt(surface, {centre(i), centre(j)});
        longest = std::max(longest, glm::length(normals[j][i]));
      }
    }
    const double size = extent();
    if (!(longest > kLeastArea * size * size)) {
      report(DiagnosticCode::kDegeneratePatch, {}, surface.evaluateUnit({0.5, 0.5}).position);
      return false;
    }
    leastNormal_ = kLeastNormal * longest;
    for (int j = 0; j < kFoldCells; ++j) {
      for (int i = 0; i < kFoldCells; ++i) {
        const Vec2 here(centre(i), centre(j));
        if ((i + 1 < kFoldCells && foldsBetween(surface, here, {centre(i + 1), centre(j)})) ||
            (j + 1 < kFoldCells && foldsBetween(surface, here, {centre(i), centre(j + 1)}))) {
          report(DiagnosticCode::kDegeneratePatch, {}, surface.evaluateUnit(here).position);
          return true;
        }
      }
    }
    return true;
  }

  static Vec3 normalAt(const CoonsSurface& surface, const Vec2& unit) {
    const SurfacePoint point = surface.evaluateUnit(unit);
    return glm::cross(point.alongXi, point.alongEta);
  }

  /// True if the normal turns by more than 90 degrees from one parameter to the other, however
  /// near each other these are.
  [[nodiscard]] bool foldsBetween(const CoonsSurface& surface, Vec2 from, Vec2 to) const {
    Vec3 normalFrom = normalAt(surface, from);
    Vec3 normalTo = normalAt(surface, to);
    if (glm::length(normalFrom) < leastNormal_ || glm::length(normalTo) < leastNormal_)
      return false;
    for (int halving = 0; halving < kFoldHalvings; ++halving) {
      if (glm::dot(normalFrom, normalTo) >= 0.0) return false;
      const Vec2 middle = 0.5 * (from + to);
      const Vec3 normal = normalAt(surface, middle);
      // A bend keeps its area; a fold has none where it turns.
      if (glm::length(normal) < leastNormal_) return true;
      if (glm::dot(normalFrom, normal) < 0.0) {
        to = middle;
        normalTo = normal;
      } else {
        from = middle;
        normalFrom = normal;
      }
    }
    return true;
  }

  /// Opposite corners apart; a line used twice only as a seam, walked both ways by opposite lines
  /// of the loop (a tube has one).
  bool checkCorners() {
    const Loop& loop = drawn_->loops.front();
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = i + 1; k < 4; ++k) {
        const bool seam = k == i + 2 && loop[i].reversed != loop[k].reversed;
        if (loop[i].line != loop[k].line || seam) continue;
        report(DiagnosticCode::kLoopTouchesItself, {loop[i].line},
               model_->curve(loop[i].line).start());
        return false;
      }
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (model_->startPoint(loop[i]) != model_->startPoint(loop[i + 2])) continue;
      report(DiagnosticCode::kLoopTouchesItself, {loop[i].line, loop[i + 2].line},
             model_->curve(loop[i]).start());
      return false;
    }
    return true;
  }

  const ResolvedModel* model_;
  std::uint32_t patch_;
  const Patch* drawn_;
  std::vector<Diagnostic>* diagnostics_;
  double leastNormal_ = 0.0;
};

}  // namespace

bool checkPatchShape(const ResolvedModel& model, std::uint32_t patch,
                     std::vector<Diagnostic>& diagnostics) {
  return PatchCheck(model, patch, diagnostics).run();
}

}  // namespace tetrafront
