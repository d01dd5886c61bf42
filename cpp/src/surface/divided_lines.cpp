#include "surface/divided_lines.h"

#include <algorithm>
#include <map>

#include "base/sort.h"

namespace tetrafront {

namespace {

/// A closed line needs three sides to enclose an area. Two lines between the same points need two sides each: one
/// side would do for one of them, but the result must not depend on which.
constexpr std::uint32_t kMinSidesOfClosedLine = 3;
constexpr std::uint32_t kMinSidesOfParallelLine = 2;
/// A closed line of a patch with a seam: with fewer sides, an edge could connect a node to both copies of a node of
/// the seam, which are the same node of the surface.
constexpr std::uint32_t kMinSidesAtSeam = 6;

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
  for (std::size_t line = 0; line < isUsed_.size(); ++line) {
    if (isUsed_[line] == 0) continue;
    endPoints_.push_back(model.lines[line].points.front());
    endPoints_.push_back(model.lines[line].points.back());
  }
  sortUnique(endPoints_);
}

void LineDivider::findMinSides() {
  const Model& model = model_->model();
  minSides_.assign(model.lines.size(), 1);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> lineBetween;
  for (std::size_t line = 0; line < isUsed_.size(); ++line) {
    if (isUsed_[line] == 0) continue;
    const std::vector<std::uint32_t>& points = model.lines[line].points;
    if (points.front() == points.back()) {
      minSides_[line] = kMinSidesOfClosedLine;
      continue;
    }
    const auto [entry, isFirst] =
        lineBetween.try_emplace(std::minmax(points.front(), points.back()), line);
    if (isFirst) continue;
    minSides_[line] = kMinSidesOfParallelLine;
    minSides_[entry->second] = kMinSidesOfParallelLine;
  }
  for (const Patch& patch : model.patches) {
    if (patch.type == PatchType::kPlanar) continue;
    for (const OrientedLine& line : patch.loops.front())
      if (minSides_[line.line] == kMinSidesOfClosedLine) minSides_[line.line] = kMinSidesAtSeam;
  }
}

const LineDivision& LineDivider::divide(LineId line, const SizeField& field) {
  LineDivision& division = lines_.divisions[line.index()];
  division = divideLine(model_->curve(line), field, minSides_[line.index()]);
  return division;
}

void LineDivider::halveSides(const std::set<LineSide>& sides) {
  // In descending order, so that the indices of the other sides stay valid.
  for (auto entry = sides.rbegin(); entry != sides.rend(); ++entry) {
    const auto& [line, side] = *entry;
    halveSide(model_->curve(line), side, lines_.divisions[line.index()]);
  }
  numberNodes();
}

void LineDivider::numberNodes() {
  const auto nodeAt = [&](std::uint32_t point) {
    const auto entry = std::ranges::lower_bound(endPoints_, point);
    return NodeId(static_cast<std::size_t>(entry - endPoints_.begin()));
  };
  std::size_t next = endPoints_.size();
  for (std::uint32_t line = 0; line < isUsed_.size(); ++line) {
    if (isUsed_[line] == 0) continue;
    const std::vector<std::uint32_t>& points = model_->model().lines[line].points;
    std::vector<NodeId>& nodes = lines_.nodes[line];
    nodes.assign(lines_.divisions[line].nodes.size(), {});
    nodes.front() = nodeAt(points.front());
    nodes.back() = nodeAt(points.back());
    if (model_->isFlipped(LineId(line))) std::swap(nodes.front(), nodes.back());
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) nodes[i] = NodeId(next++);
  }
}

void LineDivider::writeTo(SurfaceMesh& mesh) const {
  const auto append = [&](const Vec3& position) {
    mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
  };
  for (const std::uint32_t point : endPoints_) append(model_->model().points[point]);
  for (std::uint32_t line = 0; line < isUsed_.size(); ++line) {
    const std::vector<NodeId>& nodes = lines_.nodes[line];
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      if (i > 0) append(lines_.divisions[line].nodes[i]);
      mesh.sides.insert(mesh.sides.end(), {nodes[i].value, nodes[i + 1].value});
      mesh.sideLine.push_back(line);
    }
  }
}

}  // namespace tetrafront
