#include "surface/model_sampling.h"

#include "tetrafront/grid_tools.h"

namespace tetrafront {

std::optional<Extent> extentOf(const ModelPreview& preview) {
  std::optional<Extent> extent;
  for (const std::vector<double>* points : {&preview.linePoints, &preview.patchPoints}) {
    for (std::size_t i = 0; i < points->size() / 3; ++i) {
      const Vec3 place = sampleAt(*points, i);
      if (!extent) extent = {place, place};
      extent = {glm::min(extent->low, place), glm::max(extent->high, place)};
    }
  }
  return extent;
}

BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape) {
  const std::optional<Extent> extent = extentOf(sampleModel(model));
  if (!extent) return {};
  const auto& [low, high] = *extent;
  const double given = size > 0.0 ? size : kUniformPerDiagonal * glm::length(high - low);
  return coveringGrid(low, high, given, shape);
}

}  // namespace tetrafront
