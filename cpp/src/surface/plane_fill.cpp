#include "tetrafront/plane_fill.h"

#include <algorithm>
#include <utility>

#include "base/task.h"
#include "base/trace_bytes.h"
#include "field/grid_access.h"
#include "field/grid_locator_builder.h"
#include "surface/divided_lines.h"
#include "surface/patch_boundary.h"
#include "surface/planar_front.h"
#include "surface/planar_optimizer.h"
#include "surface/short_lines.h"
#include "surface/surface_trace.h"

namespace tetrafront {

namespace {

/// Nodes and triangles that the optimizer visits per call.
constexpr std::uint32_t kVisitsPerCall = 1U << 16U;

/// Returns a model with one planar patch, whose line i is segment i.
Model modelOfLoops(const std::vector<double>& points, const std::vector<std::uint32_t>& loops) {
  Model model;
  Patch patch;
  std::uint32_t first = 0;
  for (const std::uint32_t count : loops) {
    Loop loop;
    double twiceArea = 0.0;
    const Vec3 origin(points[2 * first], points[2 * first + 1], 0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t from = first + i;
      const std::uint32_t to = first + (i + 1) % count;
      const Vec3 position(points[2 * from], points[2 * from + 1], 0.0);
      const Vec3 a = position - origin;
      const Vec3 b = Vec3(points[2 * to], points[2 * to + 1], 0.0) - origin;
      twiceArea += a.x * b.y - a.y * b.x;
      model.points.push_back(position);
      model.lines.push_back({LineType::kStraight, {from, to}});
      loop.push_back({from, false});
    }
    // The outer loop gives the plane its orientation.
    if (patch.loops.empty() && twiceArea < 0.0) {
      std::ranges::reverse(loop);
      for (OrientedLine& line : loop) line.reversed = true;
    }
    patch.loops.push_back(std::move(loop));
    first += count;
  }
  model.patches.push_back(std::move(patch));
  return model;
}

SizeField fieldOf(const BackgroundGrid& grid, double size) {
  SizeField field = SizeField::uniform(size);
  if (!grid.tetrahedra.empty()) {
    Job<GridLocator> job([&](Work& work) { return buildGridLocator(work, grid); });
    field = SizeField::fromGrid(job.finish());
  }
  field.addSources(grid.sources);
  return field;
}

class PlaneFiller {
 public:
  PlaneFiller(const Model& model, const BackgroundGrid& grid, const PlaneOptions& options,
              const FrontExperiment& experiment)
      : options_(options),
        largestSize_(std::max(options.size, largestSizeOf(grid))),
        model_(model),
        surface_(model_, model.patches.front(),
                 PlanarSurface(Vec3(0.0), Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 0.0))),
        field_(fieldOf(grid, options.size)),
        lines_(model_),
        trace_{&recorder_,
               {.order = options.order,
                .seed = options.seed,
                .height = options.height,
                .experiment = experiment}} {}

  PlaneFill fill() {
    if (areFew() && areLoopsSimple() && divide() && numberNodes()) advance();
    fill_.events = bytes_.take();
    return std::move(fill_);
  }

 private:
  [[nodiscard]] IdRange<LineId> lines() const { return IdRange<LineId>(lines_.lineCount()); }

  /// Each segment has at least one side.
  bool areFew() {
    if (lines_.lineCount() <= kMaxPlaneSides) return true;
    fill_.status = PlaneStatus::kTooManySides;
    fill_.culprits = {kMaxPlaneSides};
    return false;
  }

  bool areLoopsSimple() {
    LineDivider whole(model_);
    for (const LineId line : lines()) whole.keepWhole(line, field_, NullSurfaceTrace{});
    whole.numberNodes();
    return isSimple(layOut(whole));
  }

  [[nodiscard]] PatchBoundary layOut(const LineDivider& divider) const {
    return layOutBoundary(model_, model_.model().patches.front(), surface_, field_,
                          divider.lines());
  }

  bool isSimple(const PatchBoundary& boundary) {
    const std::optional<LoopProblem> problem = findLoopProblem(boundary);
    if (!problem) return true;
    const auto [kind, first, second] = *problem;
    fill_.culprits = {first, second};
    switch (kind) {
      case LoopProblem::Kind::kCrossing:
        fill_.status = PlaneStatus::kCrossing;
        for (std::uint32_t& culprit : fill_.culprits)
          culprit = boundary.origins[culprit].line.value;
        std::ranges::sort(fill_.culprits);
        return false;
      case LoopProblem::Kind::kHoleOutside:
        fill_.status = PlaneStatus::kHoleOutside;
        return false;
      case LoopProblem::Kind::kNestedHoles:
        fill_.status = PlaneStatus::kNestedHoles;
        return false;
    }
    return false;
  }

  bool divide() {
    if (!options_.divide) {
      for (const LineId line : lines()) lines_.keepWhole(line, field_, trace_);
      return true;
    }
    if (!divideEachLine()) return false;
    const std::vector<SizeSource> sources = sourcesAtShortLines(model_, lines_.lines().divisions);
    if (sources.empty()) return true;
    field_.addSources(sources);
    return divideEachLine();
  }

  /// Returns false if there are too many sides.
  bool divideEachLine() {
    std::size_t sides = 0;
    for (const LineId line : lines()) {
      // A lower estimate saves the walk along a line whose size was mistyped.
      const bool isLong = model_.curve(line).length() > largestSize_ * kMaxPlaneSides;
      if (!isLong) sides += lines_.divide(line, field_, trace_).sideCount();
      const bool isDivided =
          !isLong && lines_.lines().divisions[line.index()].status == LineDivisionStatus::kDivided;
      if (isDivided && sides <= kMaxPlaneSides) continue;
      fill_.status = PlaneStatus::kTooManySides;
      fill_.culprits = {line.value};
      return false;
    }
    return true;
  }

  bool numberNodes() {
    lines_.numberNodes();
    PatchBoundary boundary = layOut(lines_);
    if (!isSimple(boundary)) return false;
    trace_->numbered(lines_.lines());
    trace_->patch(PatchId(0U), boundary, false, false);
    mesh_ = std::move(boundary.mesh);
    return true;
  }

  void advance() {
    const PatchMetric metric(surface_, field_);
    BasicPlanarFront<RecordingSurfaceTrace> front(metric, mesh_, trace_);
    const bool isOver = front.advance(options_.maxSteps);
    const PlanarFrontEnd end = !isOver              ? PlanarFrontEnd::kStopped
                               : front.hasStalled() ? PlanarFrontEnd::kStalled
                                                    : PlanarFrontEnd::kCovered;
    trace_->ended(mesh_, end);
    fill_.status = static_cast<PlaneStatus>(end);
    if (end == PlanarFrontEnd::kCovered && options_.improve) {
      PlanarOptimizer optimizer(metric, mesh_);
      while (!optimizer.advance(kVisitsPerCall)) {
      }
      trace_->improved(mesh_);
    }
    takeMesh();
  }

  void takeMesh() {
    for (const Vec2& node : mesh_.plane) fill_.points.insert(fill_.points.end(), {node.x, node.y});
    for (const PlanarMesh::Triangle& triangle : mesh_.triangles)
      for (const PlanarNodeId node : triangle) fill_.triangles.push_back(node.value);
  }

  PlaneOptions options_;
  double largestSize_;
  ResolvedModel model_;
  PatchSurface surface_;
  SizeField field_;
  LineDivider lines_;
  TraceBytes bytes_;
  SurfaceRecorder recorder_{bytes_};
  RecordingSurfaceTrace trace_;
  PlanarMesh mesh_;
  PlaneFill fill_;
};

}  // namespace

PlaneFill fillPlane(const std::vector<double>& points, const std::vector<std::uint32_t>& loops,
                    const BackgroundGrid& grid, const PlaneOptions& options,
                    const FrontExperiment& experiment) {
  const Model model = modelOfLoops(points, loops);
  return PlaneFiller(model, grid, options, experiment).fill();
}

}  // namespace tetrafront
