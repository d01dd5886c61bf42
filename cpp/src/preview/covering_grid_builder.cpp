#include "tetrafront/covering_grid.h"

#include <optional>
#include <utility>

#include "base/resumable.h"
#include "base/task.h"
#include "base/tool_job.h"
#include "preview/model_sampler.h"

namespace tetrafront {

namespace {

struct CoverInput {
  Model model;
  double size;
  CoverShape shape;
};

Task<BackgroundGrid> coverModel(Work& work, const CoverInput& input) {
  const ModelPreview samples = co_await sampleModel(work, input.model);
  const std::optional<Bounds> bounds = boundsOf(samples);
  if (!bounds) co_return BackgroundGrid{};
  const auto& [low, high] = *bounds;
  const double size = input.size > 0.0 ? input.size : kUniformPerDiagonal * glm::length(high - low);
  co_return coveringGrid(low, high, size, input.shape);
}

}  // namespace

CoveringGridBuilder::CoveringGridBuilder(Model model, double size, CoverShape shape)
    : SlicedTool(
          makeToolJob<BackgroundGrid>(CoverInput{std::move(model), size, shape}, coverModel)) {}

BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape) {
  CoveringGridBuilder builder(model, size, shape);
  finish(builder);
  return builder.result();
}

}  // namespace tetrafront
