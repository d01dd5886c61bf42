#include "model/check_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/diagnostics.h"
#include "base/ids.h"
#include "base/sort.h"
#include "base/tolerance.h"
#include "geom/coordinates.h"
#include "model/check_patch.h"
#include "model/duplicates.h"
#include "model/resolved_model.h"
#include "model/self_crossing.h"

namespace tetrafront {

namespace {

/// Requirements of a patch type on its outer loop.
struct PatchRule {
  std::uint32_t lines;  ///< 0 for any number
  bool parabolicOnly;
};

PatchRule ruleOf(PatchType type) {
  switch (type) {
    case PatchType::kPlanar:
      return {0, false};
    case PatchType::kIsoparametricTriangle:
      return {3, true};
    case PatchType::kSerendipity:
      return {4, true};
    case PatchType::kBarnhillGregoryNielson:
      return {3, false};
    case PatchType::kTube:
      return {0, false};
    case PatchType::kNielson:
      return {3, false};
    case PatchType::kCoons:
    case PatchType::kGregory:
    case PatchType::kLoft:
      break;
  }
  return {4, false};
}

class ModelChecker {
 public:
  explicit ModelChecker(const Model& model) : model_(&model), movedPoints_(model) {}

  /// Returns false if the model is too small to compute with: all other reports would be wrong.
  bool checkPoints() {
    findUsed();
    for (const PointId point : IdRange<PointId>(model_->points.size())) {
      const Vec3& position = positionOf(point);
      if (!isFinite(position))
        report(diagnose<DiagnosticCode::kNotFinite>(refusedCoordinate(position))
                   .about({entityOf(point)}));
    }
    const std::vector<std::uint8_t> takesPart = usedPoints();
    tolerance_ = toleranceOf(takesPart);
    return isLargeEnough(takesPart);
  }

  void markAllUnusable() {
    found_.usableLines.assign(model_->lines.size(), 0);
    found_.usablePatches.assign(model_->patches.size(), 0);
    for (const PointId point : IdRange<PointId>(model_->points.size()))
      found_.duplicates.points.push_back(point);
    for (const LineId line : IdRange<LineId>(model_->lines.size()))
      found_.duplicates.lines.push_back(line);
  }

  void checkLines() {
    for (const LineId line : IdRange<LineId>(model_->lines.size()))
      found_.usableLines.push_back(checkLine(line) ? 1 : 0);
    resolved_.emplace(*model_, found_.usableLines);
    checkDuplicates(*resolved_);
    checkCourses(*resolved_);
    if (model_->patches.empty()) report(diagnose<DiagnosticCode::kEmptyModel>());
  }

  /// Patches are checked in their order, after the lines.
  void checkPatch(PatchId patch) {
    found_.usablePatches.push_back(isUsable(*resolved_, patch) ? 1 : 0);
  }

  [[nodiscard]] CheckedModel take() { return std::move(found_); }

 private:
  void report(Diagnostic found) { found_.diagnostics.push_back(std::move(found)); }

  bool isLargeEnough(const std::vector<std::uint8_t>& takesPart) {
    PointId farthest(0U);
    double largest = 0.0;
    for (const PointId point : IdRange<PointId>(takesPart.size())) {
      const Vec3& position = positionOf(point);
      if (takesPart[point.index()] == 0 || !isFinite(position) ||
          !(magnitudeOf(position) > largest))
        continue;
      farthest = point;
      largest = magnitudeOf(position);
    }
    if (largest == 0.0 || largest >= kSmallestExtent) return true;
    report(diagnose<DiagnosticCode::kNotFinite>(largest).about({entityOf(farthest)}));
    return false;
  }

  /// Returns the points of lines that patches use, or all points if there are no such lines.
  /// Forgotten points far away do not coarsen the tolerances.
  [[nodiscard]] std::vector<std::uint8_t> usedPoints() const {
    std::vector<std::uint8_t> takesPart(model_->points.size(), 0);
    for (std::size_t line = 0; line < model_->lines.size(); ++line) {
      if (isUsed_[line] == 0) continue;
      for (const std::uint32_t point : model_->lines[line].points)
        if (exists(PointId(point))) takesPart[point] = 1;
    }
    if (std::ranges::count(takesPart, 1) == 0) std::ranges::fill(takesPart, 1);
    return takesPart;
  }

  [[nodiscard]] Tolerance toleranceOf(const std::vector<std::uint8_t>& takesPart) const {
    std::optional<Vec3> low;
    Vec3 high(0.0);
    for (const PointId point : IdRange<PointId>(takesPart.size())) {
      const Vec3& position = positionOf(point);
      if (takesPart[point.index()] == 0 || !isFinite(position)) continue;
      high = low ? glm::max(high, position) : position;
      low = low ? glm::min(*low, position) : position;
    }
    return low ? Tolerance::ofBox(*low, high) : Tolerance(0.0);
  }

  /// Marks the lines that patches use, and the points at which these begin and end.
  void findUsed() {
    isUsed_.assign(model_->lines.size(), 0);
    isCorner_.assign(model_->points.size(), 0);
    for (const Patch& patch : model_->patches) {
      for (const Loop& loop : patch.loops) {
        for (const OrientedLine& walked : loop) {
          if (walked.line >= model_->lines.size()) continue;
          isUsed_[walked.line] = 1;
          for (const bool last : {false, true}) {
            const std::optional<PointId> end = endOf(walked, last);
            if (end && exists(*end)) isCorner_[end->index()] = 1;
          }
        }
      }
    }
  }

  // ---- lines -----------------------------------------------------------------------------------

  /// Checks one line; returns true if a curve can be built from it.
  bool checkLine(LineId line) {
    const Line& drawn = model_->lines[line.index()];
    bool isUsable = true;
    if (!pointCountFits(drawn)) {
      report(
          diagnose<DiagnosticCode::kWrongPointCount>(drawn.points.size()).about({entityOf(line)}));
      isUsable = false;
    } else if (drawn.type == LineType::kCircle && drawn.points.front() != drawn.points.back()) {
      report(diagnose<DiagnosticCode::kOpenCircle>().about({entityOf(line)}));
      isUsable = false;
    }
    for (const PointId point : pointsOf(line)) {
      if (exists(point)) {
        isUsable = isUsable && isFinite(positionOf(point));
        continue;
      }
      report(diagnose<DiagnosticCode::kIndexOutOfRange>(point.value).about({entityOf(line)}));
      isUsable = false;
    }
    for (const Vec3& tangent : {drawn.startTangent, drawn.endTangent}) {
      if (isFinite(tangent)) continue;
      report(
          diagnose<DiagnosticCode::kNotFinite>(refusedCoordinate(tangent)).about({entityOf(line)}));
      isUsable = false;
    }
    return isUsable && checkPositions(line);
  }

  static bool pointCountFits(const Line& line) {
    switch (line.type) {
      case LineType::kStraight:
        return line.points.size() == 2;
      case LineType::kParabolic:
      case LineType::kArc:
        return line.points.size() == 3;
      case LineType::kCircle:
        return line.points.size() == 4;
      case LineType::kHermite:
        return line.points.size() >= 2;
      case LineType::kSpline:
        break;
    }
    return line.points.size() >= 3;
  }

  [[nodiscard]] bool coincide(PointId a, PointId b) const {
    return a == b || glm::length(positionOf(a) - positionOf(b)) <= tolerance_.rounding();
  }

  /// Points with the same position that were reported with a line are not reported again.
  void nameTogether(PointId a, PointId b) {
    namedPairs_.emplace_back(std::min(a, b), std::max(a, b));
  }

  bool checkPositions(LineId line) {
    const std::vector<PointId> points = pointsOf(line);
    const PointId start = points.front();
    if (std::ranges::all_of(points, [&](PointId point) { return coincide(start, point); })) {
      report(diagnose<DiagnosticCode::kZeroLengthLine>()
                 .about({entityOf(line)})
                 .at(positionOf(start)));
      for (const PointId point : points) nameTogether(start, point);
      return false;
    }
    bool distinct = true;
    const auto compare = [&](PointId a, PointId b) {
      if (!coincide(a, b)) return;
      distinct = false;
      nameTogether(a, b);
      report(diagnose<DiagnosticCode::kCoincidentPoints>()
                 .about({entityOf(line), entityOf(a), entityOf(b)})
                 .at(positionOf(b)));
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) compare(points[i], points[i + 1]);
    // A spline may end at its first point, and a circle must. A line of three points cannot, and two
    // points with the same position would leave an invisible gap.
    const bool closed = points.front() == points.back();
    if (points.size() == 3 || (points.size() > 3 && !closed))
      compare(points.front(), points.back());
    return distinct && checkArc(line);
  }

  /// Checks that the points of an arc or circle define one.
  bool checkArc(LineId line) {
    const Line& drawn = model_->lines[line.index()];
    if (drawn.type != LineType::kArc && drawn.type != LineType::kCircle) return true;
    const Vec3& start = model_->points[drawn.points[0]];
    const Vec3 second = model_->points[drawn.points[1]] - start;
    const Vec3 third = model_->points[drawn.points[2]] - start;
    const double longest =
        std::max({glm::length(second), glm::length(third), glm::length(third - second)});
    if (glm::length(glm::cross(second, third)) > Tolerance(longest).area()) return true;
    report(diagnose<DiagnosticCode::kCollinearPoints>().about({entityOf(line)}).at(start + second));
    return false;
  }

  /// Points and lines drawn twice are harmless unless the surface uses both.
  void checkDuplicates(const ResolvedModel& resolved) {
    found_.duplicates = findDuplicates(resolved, found_.usableLines, tolerance_);
    const auto reportPair = [&](Diagnostic found, auto first, auto second,
                                const std::vector<std::uint8_t>& isUsed, const Vec3& position) {
      const bool matters = isUsed[first.index()] != 0 && isUsed[second.index()] != 0;
      report(std::move(found)
                 .about({entityOf(first), entityOf(second)})
                 .at(position)
                 .withSeverity(matters ? Severity::kError : Severity::kWarning));
    };
    stableSort(namedPairs_);
    for (const PointId point : IdRange<PointId>(model_->points.size())) {
      const PointId first = found_.duplicates.points[point.index()];
      if (first == point || std::ranges::binary_search(namedPairs_, std::pair(first, point)))
        continue;
      reportPair(diagnose<DiagnosticCode::kDuplicatePoints>(), first, point, isCorner_,
                 positionOf(point));
    }
    for (const LineId line : IdRange<LineId>(model_->lines.size())) {
      const LineId first = found_.duplicates.lines[line.index()];
      if (first == line) continue;
      reportPair(diagnose<DiagnosticCode::kDuplicateLines>(), first, line, isUsed_,
                 resolved.curve(line).position(0.5));
    }
  }

  void checkCourses(const ResolvedModel& resolved) {
    crosses_.assign(model_->lines.size(), 0);
    for (const LineId line : IdRange<LineId>(model_->lines.size())) {
      if (found_.usableLines[line.index()] == 0) continue;
      const std::optional<Vec3> position = findSelfCrossing(resolved.curve(line));
      if (!position) continue;
      crosses_[line.index()] = 1;
      const bool isUsed = isUsed_[line.index()] != 0;
      report(diagnose<DiagnosticCode::kLineSelfIntersection>()
                 .about({entityOf(line)})
                 .at(*position)
                 .withSeverity(isUsed ? Severity::kError : Severity::kWarning));
    }
  }

  // ---- patches ---------------------------------------------------------------------------------

  /// Checks one patch; returns true if its surface can be evaluated.
  bool isUsable(const ResolvedModel& resolved, PatchId patch) {
    const Patch& drawn = model_->patches[patch.index()];
    if (!checkLineIndices(patch)) return false;
    const PatchRule rule = ruleOf(drawn.type);
    bool isUsable = checkLoops(patch, rule);
    isUsable = checkChains(patch) && isUsable;
    for (const Loop& loop : drawn.loops)
      for (const OrientedLine& line : loop)
        isUsable = isUsable && found_.usableLines[line.line] != 0;
    for (const OrientedLine& section : drawn.sections)
      isUsable = isUsable && found_.usableLines[section.line] != 0;
    return isUsable && checkShape(resolved, patch);
  }

  /// If a loop intersects itself, or a patch folds, because one of its lines does, only the line is
  /// reported.
  bool checkShape(const ResolvedModel& resolved, PatchId patch) {
    const std::size_t before = found_.diagnostics.size();
    const bool isUsable = checkPatchShape(resolved, patch, movedPoints_, found_.diagnostics);
    const auto isKnown = [&](const Diagnostic& diagnostic) {
      const bool isAboutLines = diagnostic.code == DiagnosticCode::kLoopsIntersect ||
                                diagnostic.code == DiagnosticCode::kDegeneratePatch;
      return isAboutLines && diagnostic.entities.size() > 1 &&
             std::ranges::all_of(diagnostic.entities, [&](const Entity& entity) {
               return entity.kind != EntityKind::kLine || crosses_[entity.index] != 0;
             });
    };
    const auto from = found_.diagnostics.begin() + static_cast<std::ptrdiff_t>(before);
    found_.diagnostics.erase(std::remove_if(from, found_.diagnostics.end(), isKnown),
                             found_.diagnostics.end());
    return isUsable;
  }

  bool checkLineIndices(PatchId patch) {
    bool exist = true;
    const auto check = [&](const Loop& lines) {
      for (const OrientedLine& line : lines) {
        if (line.line < model_->lines.size()) continue;
        report(diagnose<DiagnosticCode::kIndexOutOfRange>(line.line).about({entityOf(patch)}));
        exist = false;
      }
    };
    const Patch& drawn = model_->patches[patch.index()];
    for (const Loop& loop : drawn.loops) check(loop);
    check(drawn.sections);
    return exist;
  }

  bool checkLoops(PatchId patch, const PatchRule& rule) {
    const Patch& drawn = model_->patches[patch.index()];
    const std::size_t given = drawn.loops.empty() ? 0 : drawn.loops.front().size();
    if (drawn.type == PatchType::kTube && drawn.loops.size() != 2) {
      report(
          diagnose<DiagnosticCode::kWrongLoopCount>(drawn.loops.size()).about({entityOf(patch)}));
      return false;
    }
    bool fits = rule.lines == 0 ? given > 0 : given == rule.lines;
    // A hole without lines is ignored.
    for (const Loop& loop : drawn.loops) fits = fits && !loop.empty();
    if (!fits)
      report(diagnose<DiagnosticCode::kWrongLineCount>(given, std::max(rule.lines, 1U))
                 .about({entityOf(patch)}));
    if (!rule.parabolicOnly || drawn.loops.empty()) return fits;
    for (const OrientedLine& line : drawn.loops.front()) {
      if (model_->lines[line.line].type == LineType::kParabolic) continue;
      report(diagnose<DiagnosticCode::kWrongLineType>().about(
          {entityOf(patch), entityOf(LineId(line.line))}));
      fits = false;
    }
    return fits;
  }

  /// Checks that each line begins at the end point of the previous one.
  bool checkChains(PatchId patch) {
    bool closed = true;
    for (const Loop& loop : model_->patches[patch.index()].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::optional<PointId> end = endOf(loop[i], true);
        const std::optional<PointId> next = endOf(loop[(i + 1) % loop.size()], false);
        if (end && next && *end == *next) continue;
        closed = false;
        if (!end || !next) continue;  // a line without points is reported as such
        Diagnostic open = diagnose<DiagnosticCode::kLoopNotClosed>().about(
            {entityOf(patch), entityOf(LineId(loop[i].line))});
        if (exists(*end)) {
          open.entities.push_back(entityOf(*end));
          if (isFinite(positionOf(*end))) open = std::move(open).at(positionOf(*end));
        }
        report(std::move(open));
      }
    }
    return closed;
  }

  [[nodiscard]] const Vec3& positionOf(PointId point) const {
    return model_->points[point.index()];
  }

  [[nodiscard]] bool exists(PointId point) const { return point.index() < model_->points.size(); }

  [[nodiscard]] std::vector<PointId> pointsOf(LineId line) const {
    const std::vector<std::uint32_t>& points = model_->lines[line.index()].points;
    return {points.begin(), points.end()};
  }

  [[nodiscard]] std::optional<PointId> endOf(const OrientedLine& line, bool last) const {
    const std::vector<std::uint32_t>& points = model_->lines[line.line].points;
    if (points.empty()) return std::nullopt;
    return PointId(last != line.reversed ? points.back() : points.front());
  }

  const Model* model_;
  MovedPointFinder movedPoints_;
  CheckedModel found_;
  std::optional<ResolvedModel> resolved_;
  Tolerance tolerance_{0.0};            ///< relative to the box of the used points
  std::vector<std::uint8_t> isUsed_;    ///< per line: 1 if a patch uses it
  std::vector<std::uint8_t> isCorner_;  ///< per point: 1 if it is an end of a used line
  std::vector<std::uint8_t> crosses_;   ///< per line: 1 if it intersects itself
  /// Points with the same position, lower first, that a line's diagnostic names.
  std::vector<std::pair<PointId, PointId>> namedPairs_;
};

}  // namespace

Task<CheckedModel> checkModel(Work& work, const Model& model) {
  ModelChecker checker(model);
  work.beginPart(0.2);
  if (!checker.checkPoints()) {
    checker.markAllUnusable();
    co_return checker.take();
  }
  checker.checkLines();
  co_await work.yield();
  work.beginPart(1.0);
  for (const PatchId patch : IdRange<PatchId>(model.patches.size())) {
    checker.checkPatch(patch);
    co_await work.spend(kUnitsPerPatch);
  }
  co_return checker.take();
}

CheckedModel checkModel(const Model& model) {
  Job job([&](Work& work) { return checkModel(work, model); });
  return job.finish();
}

std::vector<Diagnostic> diagnoseModel(const Model& model) {
  return std::move(checkModel(model).diagnostics);
}

}  // namespace tetrafront
