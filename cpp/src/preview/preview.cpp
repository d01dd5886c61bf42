#include "tetrafront/preview.h"

#include <memory>
#include <utility>

#include "base/task.h"
#include "preview/check_input.h"

namespace tetrafront {

class ModelPreviewer::Impl {
 public:
  Impl(Model model, BackgroundGrid grid, const MeshOptions& options)
      : model_(std::move(model)), grid_(std::move(grid)), options_(options) {}

  bool advance(std::uint32_t budget) { return job_.advance(budget); }
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const ModelPreview& result() const { return preview_; }

 private:
  Task<> makePreview(Work& work) {
    CheckedInput checked = co_await checkInput(work, model_, grid_, options_);
    preview_ = std::move(checked.preview);
  }

  Model model_;
  BackgroundGrid grid_;
  MeshOptions options_;
  ModelPreview preview_;
  Job<> job_{[this](Work& work) { return makePreview(work); }};  ///< last: uses the others
};

ModelPreviewer::ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options)
    : impl_(std::make_unique<Impl>(std::move(model), std::move(grid), options)) {}
ModelPreviewer::ModelPreviewer(ModelPreviewer&&) noexcept = default;
ModelPreviewer& ModelPreviewer::operator=(ModelPreviewer&&) noexcept = default;
ModelPreviewer::~ModelPreviewer() = default;

bool ModelPreviewer::advance(std::uint32_t budget) { return impl_->advance(budget); }
double ModelPreviewer::fraction() const { return impl_->fraction(); }
const ModelPreview& ModelPreviewer::result() const { return impl_->result(); }

ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                          const MeshOptions& options) {
  return checkInput(model, grid, options).preview;
}

}  // namespace tetrafront
