#include "tetrafront/preview.h"

#include <utility>

#include "base/task.h"
#include "base/tool_job.h"
#include "preview/check_input.h"

namespace tetrafront {

namespace {

struct PreviewInput {
  Model model;
  BackgroundGrid grid;
  MeshOptions options;
};

Task<ModelPreview> makePreview(Work& work, const PreviewInput& input) {
  CheckedInput checked = co_await checkInput(work, input.model, input.grid, input.options);
  co_return std::move(checked.preview);
}

}  // namespace

ModelPreviewer::ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options)
    : SlicedTool(makeToolJob<ModelPreview>(PreviewInput{std::move(model), std::move(grid), options},
                                           makePreview)) {}

ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                          const MeshOptions& options) {
  return checkInput(model, grid, options).preview;
}

}  // namespace tetrafront
