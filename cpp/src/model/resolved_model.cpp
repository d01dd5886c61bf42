#include "model/resolved_model.h"

#include <algorithm>
#include <optional>
#include <ranges>
#include <utility>

#include "model/end_tangents.h"

namespace tetrafront {

std::vector<Vec3> pointsOf(const Model& model, const Line& line) {
  std::vector<Vec3> points;
  points.reserve(line.points.size());
  for (const std::uint32_t point : line.points) points.push_back(model.points[point]);
  return points;
}

namespace {

std::optional<Vec3> reversed(const std::optional<Vec3>& tangent) {
  if (!tangent) return std::nullopt;
  return -*tangent;
}

}  // namespace

ResolvedModel::ResolvedModel(const Model& model)
    : ResolvedModel(model, std::vector<std::uint8_t>(model.lines.size(), 1)) {}

ResolvedModel::ResolvedModel(const Model& model, std::span<const std::uint8_t> usableLines)
    : model_(&model) {
  curves_.reserve(model.lines.size());
  flipped_.reserve(model.lines.size());
  const std::vector<EndTangents> tangents = endTangents(model, usableLines);
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    if (usableLines[i] == 0) {
      curves_.emplace_back(LineType::kStraight, std::vector<Vec3>{Vec3(0.0), Vec3(1.0)});
      flipped_.push_back(0);
      continue;
    }
    const Line& line = model.lines[i];
    const bool flip =
        std::ranges::lexicographical_compare(std::views::reverse(line.points), line.points);
    std::vector<Vec3> points = pointsOf(model, line);
    if (flip) std::ranges::reverse(points);
    const EndTangents along =
        flip ? EndTangents{reversed(tangents[i].end), reversed(tangents[i].start)} : tangents[i];
    curves_.emplace_back(line.type, std::move(points), along);
    flipped_.push_back(flip ? 1 : 0);
  }
}

PointId ResolvedModel::startPoint(const OrientedLine& line) const {
  const Line& drawn = model_->lines[line.line];
  return PointId(line.reversed ? drawn.points.back() : drawn.points.front());
}

PointId ResolvedModel::endPoint(const OrientedLine& line) const {
  return startPoint({line.line, !line.reversed});
}

}  // namespace tetrafront
