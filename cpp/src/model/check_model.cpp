#include "model/check_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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
    case PatchType::kCoons:
      break;
  }
  return {4, false};
}

}  // namespace

class ModelChecker::Impl {
 public:
  explicit Impl(const Model& model) : model_(&model), movedPoints_(model) {}

  bool advance(std::uint32_t budget) {
    const std::size_t patches = model_->patches.size();
    if (!resolved_) {
      checkPoints();
      if (isTooSmall_) {
        markAllUnusable();
        return true;
      }
      checkLines();
      if (patches == 0) report(DiagnosticCode::kEmptyModel, {});
    } else {
      const std::size_t last = found_.usablePatches.size() +
                               std::min<std::size_t>(budget, patches - found_.usablePatches.size());
      while (found_.usablePatches.size() < last) {
        const PatchId patch(found_.usablePatches.size());
        found_.usablePatches.push_back(checkPatch(*resolved_, patch) ? 1 : 0);
      }
    }
    return found_.usablePatches.size() == patches;
  }

  [[nodiscard]] CheckedModel take() { return std::move(found_); }

 private:
  void checkLines() {
    for (const LineId line : IdRange<LineId>(model_->lines.size()))
      found_.usableLines.push_back(checkLine(line) ? 1 : 0);
    resolved_.emplace(*model_, found_.usableLines);
    checkDuplicates(*resolved_);
    checkCourses(*resolved_);
  }

  void report(DiagnosticCode code, std::vector<Entity> entities, std::vector<double> values = {},
              std::optional<Vec3> position = std::nullopt) {
    Diagnostic diagnostic;
    diagnostic.code = code;
    diagnostic.entities = std::move(entities);
    diagnostic.values = std::move(values);
    diagnostic.hasPosition = position.has_value();
    diagnostic.position = position.value_or(Vec3(0.0));
    found_.diagnostics.push_back(std::move(diagnostic));
  }

  void checkPoints() {
    findUsed();
    for (std::uint32_t point = 0; point < model_->points.size(); ++point) {
      const Vec3& position = model_->points[point];
      if (!isFinite(position))
        report(DiagnosticCode::kNotFinite, {{EntityKind::kPoint, point}},
               {refusedCoordinate(position)});
    }
    const std::vector<std::uint8_t> takesPart = usedPoints();
    checkSmallness(takesPart);
    tolerance_ = toleranceOf(takesPart);
  }

  /// If the model is too small to compute with, all other reports would be wrong.
  void markAllUnusable() {
    found_.usableLines.assign(model_->lines.size(), 0);
    found_.usablePatches.assign(model_->patches.size(), 0);
    for (const PointId point : IdRange<PointId>(model_->points.size()))
      found_.duplicates.points.push_back(point);
    for (const LineId line : IdRange<LineId>(model_->lines.size()))
      found_.duplicates.lines.push_back(line);
  }

  void checkSmallness(const std::vector<std::uint8_t>& takesPart) {
    std::uint32_t farthest = 0;
    double largest = 0.0;
    for (std::uint32_t point = 0; point < takesPart.size(); ++point) {
      const Vec3& position = model_->points[point];
      if (takesPart[point] == 0 || !isFinite(position) || !(magnitudeOf(position) > largest))
        continue;
      farthest = point;
      largest = magnitudeOf(position);
    }
    isTooSmall_ = largest > 0.0 && largest < kSmallestExtent;
    if (isTooSmall_)
      report(DiagnosticCode::kNotFinite, {{EntityKind::kPoint, farthest}}, {largest});
  }

  /// Returns the points of lines that patches use, or all points if there are no such lines.
  /// Forgotten points far away do not coarsen the tolerances.
  [[nodiscard]] std::vector<std::uint8_t> usedPoints() const {
    std::vector<std::uint8_t> takesPart(model_->points.size(), 0);
    for (std::size_t line = 0; line < model_->lines.size(); ++line) {
      if (isUsed_[line] == 0) continue;
      for (const std::uint32_t point : model_->lines[line].points)
        if (point < takesPart.size()) takesPart[point] = 1;
    }
    if (std::ranges::count(takesPart, 1) == 0) std::ranges::fill(takesPart, 1);
    return takesPart;
  }

  [[nodiscard]] Tolerance toleranceOf(const std::vector<std::uint8_t>& takesPart) const {
    std::optional<Vec3> low;
    Vec3 high(0.0);
    for (std::size_t point = 0; point < takesPart.size(); ++point) {
      const Vec3& position = model_->points[point];
      if (takesPart[point] == 0 || !isFinite(position)) continue;
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
            const std::optional<std::uint32_t> end = endOf(walked, last);
            if (end && *end < isCorner_.size()) isCorner_[*end] = 1;
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
      report(DiagnosticCode::kWrongPointCount, {{EntityKind::kLine, line.value}},
             {static_cast<double>(drawn.points.size())});
      isUsable = false;
    }
    for (const std::uint32_t point : drawn.points) {
      if (point < model_->points.size()) {
        isUsable = isUsable && isFinite(model_->points[point]);
        continue;
      }
      report(DiagnosticCode::kIndexOutOfRange, {{EntityKind::kLine, line.value}},
             {static_cast<double>(point)});
      isUsable = false;
    }
    return isUsable && checkPositions(line);
  }

  static bool pointCountFits(const Line& line) {
    switch (line.type) {
      case LineType::kStraight:
        return line.points.size() == 2;
      case LineType::kParabolic:
        return line.points.size() == 3;
      case LineType::kSpline:
        break;
    }
    return line.points.size() >= 4;
  }

  [[nodiscard]] bool coincide(PointId a, PointId b) const {
    return a == b || glm::length(positionOf(a) - positionOf(b)) <= tolerance_.rounding();
  }

  /// Points with the same position that were reported with a line are not reported again.
  void nameTogether(PointId a, PointId b) {
    namedPairs_.emplace_back(std::min(a, b), std::max(a, b));
  }

  bool checkPositions(LineId line) {
    std::vector<PointId> points;
    for (const std::uint32_t point : model_->lines[line.index()].points)
      points.push_back(PointId(point));
    const PointId start = points.front();
    if (std::ranges::all_of(points, [&](PointId point) { return coincide(start, point); })) {
      report(DiagnosticCode::kZeroLengthLine, {{EntityKind::kLine, line.value}}, {},
             positionOf(start));
      for (const PointId point : points) nameTogether(start, point);
      return false;
    }
    bool distinct = true;
    const auto compare = [&](PointId a, PointId b) {
      if (!coincide(a, b)) return;
      distinct = false;
      nameTogether(a, b);
      report(DiagnosticCode::kCoincidentPoints,
             {{EntityKind::kLine, line.value},
              {EntityKind::kPoint, a.value},
              {EntityKind::kPoint, b.value}},
             {}, positionOf(b));
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i) compare(points[i], points[i + 1]);
    // A spline may end at its first point. A parabola cannot, and two points with the same position
    // would leave an invisible gap.
    const bool closed = points.front() == points.back();
    if (points.size() > 2 && (!closed || model_->lines[line.index()].type == LineType::kParabolic))
      compare(points.front(), points.back());
    return distinct;
  }

  /// Points and lines drawn twice are harmless unless the surface uses both.
  void checkDuplicates(const ResolvedModel& resolved) {
    found_.duplicates = findDuplicates(resolved, found_.usableLines, tolerance_);
    const auto reportPair = [&](DiagnosticCode code, EntityKind kind, std::uint32_t first,
                                std::uint32_t second, const std::vector<std::uint8_t>& matters,
                                const Vec3& position) {
      report(code, {{kind, first}, {kind, second}}, {}, position);
      if (matters[first] == 0 || matters[second] == 0)
        found_.diagnostics.back().severity = Severity::kWarning;
    };
    stableSort(namedPairs_);
    for (const PointId point : IdRange<PointId>(model_->points.size())) {
      const PointId first = found_.duplicates.points[point.index()];
      if (first == point || std::ranges::binary_search(namedPairs_, std::pair(first, point)))
        continue;
      reportPair(DiagnosticCode::kDuplicatePoints, EntityKind::kPoint, first.value, point.value,
                 isCorner_, positionOf(point));
    }
    for (const LineId line : IdRange<LineId>(model_->lines.size())) {
      const LineId first = found_.duplicates.lines[line.index()];
      if (first == line) continue;
      reportPair(DiagnosticCode::kDuplicateLines, EntityKind::kLine, first.value, line.value,
                 isUsed_, resolved.curve(line).position(0.5));
    }
  }

  void checkCourses(const ResolvedModel& resolved) {
    crosses_.assign(model_->lines.size(), 0);
    for (const LineId line : IdRange<LineId>(model_->lines.size())) {
      if (found_.usableLines[line.index()] == 0) continue;
      const std::optional<Vec3> position = findSelfCrossing(resolved.curve(line));
      if (!position) continue;
      crosses_[line.index()] = 1;
      report(DiagnosticCode::kLineSelfIntersection, {{EntityKind::kLine, line.value}}, {},
             position);
      if (isUsed_[line.index()] == 0) found_.diagnostics.back().severity = Severity::kWarning;
    }
  }

  // ---- patches ---------------------------------------------------------------------------------

  /// Checks one patch; returns true if its surface can be evaluated.
  bool checkPatch(const ResolvedModel& resolved, PatchId patch) {
    const Patch& drawn = model_->patches[patch.index()];
    if (!checkLineIndices(patch)) return false;
    const PatchRule rule = ruleOf(drawn.type);
    bool isUsable = checkLoops(patch, rule);
    isUsable = checkChains(patch) && isUsable;
    for (const Loop& loop : drawn.loops)
      for (const OrientedLine& line : loop)
        isUsable = isUsable && found_.usableLines[line.line] != 0;
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
    for (const Loop& loop : model_->patches[patch.index()].loops) {
      for (const OrientedLine& line : loop) {
        if (line.line < model_->lines.size()) continue;
        report(DiagnosticCode::kIndexOutOfRange, {{EntityKind::kPatch, patch.value}},
               {static_cast<double>(line.line)});
        exist = false;
      }
    }
    return exist;
  }

  bool checkLoops(PatchId patch, const PatchRule& rule) {
    const Patch& drawn = model_->patches[patch.index()];
    const std::size_t given = drawn.loops.empty() ? 0 : drawn.loops.front().size();
    bool fits = rule.lines == 0 ? given > 0 : given == rule.lines;
    // A hole without lines is ignored.
    for (const Loop& loop : drawn.loops) fits = fits && !loop.empty();
    if (!fits)
      report(DiagnosticCode::kWrongLineCount, {{EntityKind::kPatch, patch.value}},
             {static_cast<double>(given), static_cast<double>(std::max(rule.lines, 1U))});
    if (!rule.parabolicOnly || drawn.loops.empty()) return fits;
    for (const OrientedLine& line : drawn.loops.front()) {
      if (model_->lines[line.line].type == LineType::kParabolic) continue;
      report(DiagnosticCode::kWrongLineType,
             {{EntityKind::kPatch, patch.value}, {EntityKind::kLine, line.line}});
      fits = false;
    }
    return fits;
  }

  /// Checks that each line begins at the end point of the previous one.
  bool checkChains(PatchId patch) {
    bool closed = true;
    for (const Loop& loop : model_->patches[patch.index()].loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::optional<std::uint32_t> end = endOf(loop[i], true);
        const std::optional<std::uint32_t> next = endOf(loop[(i + 1) % loop.size()], false);
        if (end && next && *end == *next) continue;
        closed = false;
        if (!end || !next) continue;  // a line without points is reported as such
        std::vector<Entity> entities{{EntityKind::kPatch, patch.value},
                                     {EntityKind::kLine, loop[i].line}};
        std::optional<Vec3> position;
        if (*end < model_->points.size()) {
          entities.push_back({EntityKind::kPoint, *end});
          if (isFinite(model_->points[*end])) position = model_->points[*end];
        }
        report(DiagnosticCode::kLoopNotClosed, std::move(entities), {}, position);
      }
    }
    return closed;
  }

  [[nodiscard]] const Vec3& positionOf(PointId point) const {
    return model_->points[point.index()];
  }

  [[nodiscard]] std::optional<std::uint32_t> endOf(const OrientedLine& line, bool last) const {
    const std::vector<std::uint32_t>& points = model_->lines[line.line].points;
    if (points.empty()) return std::nullopt;
    return last != line.reversed ? points.back() : points.front();
  }

  const Model* model_;
  MovedPointFinder movedPoints_;
  CheckedModel found_;
  std::optional<ResolvedModel> resolved_;
  Tolerance tolerance_{0.0};  ///< relative to the box of the used points
  bool isTooSmall_ = false;
  std::vector<std::uint8_t> isUsed_;    ///< per line: 1 if a patch uses it
  std::vector<std::uint8_t> isCorner_;  ///< per point: 1 if it is an end of a used line
  std::vector<std::uint8_t> crosses_;   ///< per line: 1 if it intersects itself
  /// Points with the same position, lower first, that a line's diagnostic names.
  std::vector<std::pair<PointId, PointId>> namedPairs_;
};

ModelChecker::ModelChecker(const Model& model) : impl_(std::make_unique<Impl>(model)) {}
ModelChecker::ModelChecker(ModelChecker&&) noexcept = default;
ModelChecker& ModelChecker::operator=(ModelChecker&&) noexcept = default;
ModelChecker::~ModelChecker() = default;

bool ModelChecker::advance(std::uint32_t budget) { return impl_->advance(budget); }
CheckedModel ModelChecker::take() { return impl_->take(); }

CheckedModel checkModel(const Model& model) {
  ModelChecker checker(model);
  while (!checker.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return checker.take();
}

std::vector<Diagnostic> diagnoseModel(const Model& model) {
  return std::move(checkModel(model).diagnostics);
}

}  // namespace tetrafront
