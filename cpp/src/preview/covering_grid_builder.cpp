#include "tetrafront/covering_grid.h"

#include <memory>
#include <optional>
#include <utility>

#include "base/resumable.h"
#include "base/task.h"
#include "preview/model_sampler.h"

namespace tetrafront {

class CoveringGridBuilder::Impl {
 public:
  Impl(Model model, double size, CoverShape shape)
      : model_(std::move(model)), size_(size), shape_(shape) {}

  bool advance(std::uint32_t budget) { return job_.advance(budget); }
  [[nodiscard]] double fraction() const { return job_.fraction(); }
  [[nodiscard]] const BackgroundGrid& result() const { return grid_; }

 private:
  Task<> coverModel(Work& work) {
    const ModelPreview samples = co_await sampleModel(work, model_);
    const std::optional<Extent> extent = extentOf(samples);
    if (!extent) co_return;
    const auto& [low, high] = *extent;
    const double size = size_ > 0.0 ? size_ : kUniformPerDiagonal * glm::length(high - low);
    grid_ = coveringGrid(low, high, size, shape_);
  }

  Model model_;
  double size_;
  CoverShape shape_;
  BackgroundGrid grid_;
  Job<> job_{[this](Work& work) { return coverModel(work); }};  ///< last: uses the others
};

CoveringGridBuilder::CoveringGridBuilder(Model model, double size, CoverShape shape)
    : impl_(std::make_unique<Impl>(std::move(model), size, shape)) {}
CoveringGridBuilder::CoveringGridBuilder(CoveringGridBuilder&&) noexcept = default;
CoveringGridBuilder& CoveringGridBuilder::operator=(CoveringGridBuilder&&) noexcept = default;
CoveringGridBuilder::~CoveringGridBuilder() = default;

bool CoveringGridBuilder::advance(std::uint32_t budget) { return impl_->advance(budget); }
double CoveringGridBuilder::fraction() const { return impl_->fraction(); }
const BackgroundGrid& CoveringGridBuilder::result() const { return impl_->result(); }

BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape) {
  CoveringGridBuilder coverer(model, size, shape);
  finish(coverer);
  return coverer.result();
}

}  // namespace tetrafront
