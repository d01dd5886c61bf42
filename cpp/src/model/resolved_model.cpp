#include "model/resolved_model.h"

#include <algorithm>
#include <utility>

namespace tetrafront {

std::vector<Vec3> pointsOf(const Model& model, const Line& line) {
  std::vector<Vec3> points;
  points.reserve(line.points.size());
  for (const std::uint32_t point : line.points) points.push_back(model.points[point]);
  return points;
}

ResolvedModel::ResolvedModel(const Model& model) : model_(&model) {
  curves_.reserve(model.lines.size());
  flipped_.reserve(model.lines.size());
  for (const Line& line : model.lines) {
    const bool flip = line.points.front() > line.points.back();
    std::vector<Vec3> points = pointsOf(model, line);
    if (flip) std::ranges::reverse(points);
    curves_.emplace_back(line.type, std::move(points));
    flipped_.push_back(flip ? 1 : 0);
  }
}

std::uint32_t ResolvedModel::startPoint(const OrientedLine& line) const {
  const Line& drawn = model_->lines[line.line];
  return line.reversed ? drawn.points.back() : drawn.points.front();
}

std::uint32_t ResolvedModel::endPoint(const OrientedLine& line) const {
  return startPoint({line.line, !line.reversed});
}

}  // namespace tetrafront
