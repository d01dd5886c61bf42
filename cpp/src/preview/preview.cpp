#include "tetrafront/preview.h"

#include <utility>

#include "base/task.h"
#include "base/tool_job.h"
#include "preview/check_input.h"
#include "preview/model_sampler.h"

namespace tetrafront {

namespace {

struct PreviewInput {
  Model model;
  BackgroundGrid grid;
  MeshOptions options;
  bool samplesOnly;
};

Task<ModelPreview> makePreview(Work& work, const PreviewInput& input) {
  if (input.samplesOnly) {
    ModelPreview samples = co_await sampleModel(work, input.model);
    co_return samples;
  }
  CheckedInput checked = co_await checkInput(work, input.model, input.grid, input.options);
  co_return std::move(checked.preview);
}

}  // namespace

ModelPreviewer::ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options,
                               bool samplesOnly)
    : SlicedTool(makeToolJob<ModelPreview>(
          PreviewInput{std::move(model), std::move(grid), options, samplesOnly}, makePreview)) {}

ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                          const MeshOptions& options) {
  return checkInput(model, grid, options).preview;
}

}  // namespace tetrafront
