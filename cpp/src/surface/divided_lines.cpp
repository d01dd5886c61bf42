#include "surface/divided_lines.h"

#include <algorithm>
#include <map>

#include "base/sort.h"
#include "model/patch_surface.h"
#include "surface/rules.h"
#include "surface/surface_trace.h"

namespace tetrafront {

namespace {

struct EndPoints {
  PointId first;
  PointId last;
};

EndPoints endPointsOf(const Model& model, LineId line) {
  const std::vector<std::uint32_t>& points = model.lines[line.index()].points;
  return {PointId(points.front()), PointId(points.back())};
}

}  // namespace

LineDivider::LineDivider(const ResolvedModel& model) : model_(&model) {
  const std::size_t count = model.model().lines.size();
  lines_.divisions.resize(count);
  lines_.nodes.resize(count);
  findUsedLines();
  findMinSides();
}

void LineDivider::findUsedLines() {
  const Model& model = model_->model();
  isUsed_.assign(model.lines.size(), 0);
  for (const Patch& patch : model.patches)
    for (const Loop& loop : patch.loops)
      for (const OrientedLine& line : loop) isUsed_[line.line] = 1;
  for (const LineId line : IdRange<LineId>(lineCount())) {
    if (!isUsed(line)) continue;
    const EndPoints ends = endPointsOf(model, line);
    endPoints_.push_back(ends.first);
    endPoints_.push_back(ends.last);
  }
  sortUnique(endPoints_);
}

void LineDivider::findMinSides() {
  const Model& model = model_->model();
  minSides_.assign(model.lines.size(), 1);
  std::map<std::pair<PointId, PointId>, LineId> lineBetween;
  for (const LineId line : IdRange<LineId>(lineCount())) {
    if (!isUsed(line)) continue;
    const EndPoints ends = endPointsOf(model, line);
    if (ends.first == ends.last) {
      minSides_[line.index()] = kMinSidesOfClosedLine;
      continue;
    }
    const auto [entry, isFirst] = lineBetween.try_emplace(std::minmax(ends.first, ends.last), line);
    if (isFirst) continue;
    minSides_[line.index()] = kMinSidesOfParallelLine;
    minSides_[entry->second.index()] = kMinSidesOfParallelLine;
  }
  for (const Patch& patch : model.patches) {
    if (patch.type == PatchType::kPlanar) continue;
    const bool isTube = patch.type == PatchType::kTube;
    for (const Loop& loop : spanningLoops(patch)) {
      for (const OrientedLine& line : loop) {
        std::uint32_t& sides = minSides_[line.line];
        if (sides == kMinSidesOfClosedLine) sides = kMinSidesAtSeam;
        const auto lines = static_cast<std::uint32_t>(loop.size());
        if (isTube) sides = std::max(sides, (kMinSidesAtSeam + lines - 1) / lines);
      }
    }
  }
}

template <class Trace>
const LineDivision& LineDivider::divide(LineId line, const SizeField& field, Trace trace) {
  LineDivision& division = lines_.divisions[line.index()];
  const Curve& curve = model_->curve(line);
  trace->line(line, curve);
  division = divideLine(curve, field, minSides_[line.index()], trace);
  trace->divided(division);
  return division;
}

template <class Trace>
const LineDivision& LineDivider::keepWhole(LineId line, const SizeField& field, Trace trace) {
  LineDivision& division = lines_.divisions[line.index()];
  const Curve& curve = model_->curve(line);
  FieldHint hint;
  division = {};
  division.parameters = {0.0, 1.0};
  division.nodes = {curve.position(0.0), curve.position(1.0)};
  division.length = curve.length() / field.sizeAt(curve.position(0.5), hint);
  trace->line(line, curve);
  trace->divided(division);
  return division;
}

template <class Trace>
void LineDivider::halveSides(const std::set<LineSide>& sides, Trace trace) {
  // In descending order, so that the indices of the other sides stay valid.
  for (auto entry = sides.rbegin(); entry != sides.rend(); ++entry) {
    const auto& [line, side] = *entry;
    halveSide(model_->curve(line), side, lines_.divisions[line.index()]);
    trace->halved(line, side, lines_.divisions[line.index()]);
  }
  numberNodes();
}

template const LineDivision& LineDivider::divide(LineId, const SizeField&, NullSurfaceTrace);
template const LineDivision& LineDivider::divide(LineId, const SizeField&, RecordingSurfaceTrace);
template const LineDivision& LineDivider::keepWhole(LineId, const SizeField&, NullSurfaceTrace);
template const LineDivision& LineDivider::keepWhole(LineId, const SizeField&,
                                                    RecordingSurfaceTrace);
template void LineDivider::halveSides(const std::set<LineSide>&, NullSurfaceTrace);
template void LineDivider::halveSides(const std::set<LineSide>&, RecordingSurfaceTrace);

void LineDivider::numberNodes() {
  const auto nodeAt = [&](PointId point) {
    const auto entry = std::ranges::lower_bound(endPoints_, point);
    return NodeId(static_cast<std::size_t>(entry - endPoints_.begin()));
  };
  std::size_t next = endPoints_.size();
  for (const LineId line : IdRange<LineId>(lineCount())) {
    if (!isUsed(line)) continue;
    const EndPoints ends = endPointsOf(model_->model(), line);
    std::vector<NodeId>& nodes = lines_.nodes[line.index()];
    nodes.assign(lines_.divisions[line.index()].nodes.size(), {});
    nodes.front() = nodeAt(ends.first);
    nodes.back() = nodeAt(ends.last);
    if (model_->isFlipped(line)) std::swap(nodes.front(), nodes.back());
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = NodeId(next++);
  }
  lines_.nodeCount = static_cast<std::uint32_t>(next);
}

void LineDivider::writeTo(SurfaceMesh& mesh) const {
  const auto append = [&](const Vec3& position) {
    mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
  };
  for (const PointId point : endPoints_) append(model_->model().points[point.index()]);
  for (const LineId line : IdRange<LineId>(lineCount())) {
    const std::vector<NodeId>& nodes = lines_.nodes[line.index()];
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (i > 0) append(lines_.divisions[line.index()].nodes[i]);
      mesh.sides.insert(mesh.sides.end(), {nodes[i].value, nodes[i + 1].value});
      mesh.sideLine.push_back(line.value);
    }
  }
}

}  // namespace tetrafront
