#include "preview/model_sampling.h"

#include <limits>
#include <utility>

#include "tetrafront/grid_tools.h"

namespace tetrafront {

bool ModelSampler::advance(std::uint32_t budget) {
  const std::size_t patches = model_->patches.size();
  const std::uint32_t count = patchesWithin(budget);
  const bool isSampling = sampler_.has_value();
  looks_ = std::min(looks_ + count, isSampling ? 2 * patches : patches);
  if (isSampling) return sampler_->advance(count);
  if (examiner_.advance(count)) {
    found_ = examiner_.take();
    sampler_.emplace(*model_, found_);
    looks_ = patches;
  }
  return false;
}

double ModelSampler::fraction() const {
  const std::size_t patches = model_->patches.size();
  return patches == 0 ? 0.0 : static_cast<double>(looks_) / static_cast<double>(2 * patches);
}

ModelPreview ModelSampler::take() {
  ModelPreview preview = sampler_->take().preview;
  preview.diagnostics = std::move(found_.diagnostics);
  return preview;
}

ModelPreview sampleModel(const Model& model) {
  ModelSampler sampler(model);
  while (!sampler.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return sampler.take();
}

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

class ModelCoverer::Impl {
 public:
  Impl(Model model, double size, CoverShape shape)
      : model_(std::move(model)), size_(size), shape_(shape), sampler_(model_) {}

  bool advance(std::uint32_t budget) {
    if (!isFinished_ && sampler_.advance(budget)) {
      isFinished_ = true;
      cover(extentOf(sampler_.take()));
    }
    return isFinished_;
  }
  [[nodiscard]] double fraction() const { return isFinished_ ? 1.0 : sampler_.fraction(); }
  [[nodiscard]] const BackgroundGrid& result() const { return grid_; }

 private:
  void cover(const std::optional<Extent>& extent) {
    if (!extent) return;
    const auto& [low, high] = *extent;
    const double given = size_ > 0.0 ? size_ : kUniformPerDiagonal * glm::length(high - low);
    grid_ = coveringGrid(low, high, given, shape_);
  }

  Model model_;
  double size_;
  CoverShape shape_;
  ModelSampler sampler_;
  bool isFinished_ = false;
  BackgroundGrid grid_;
};

ModelCoverer::ModelCoverer(Model model, double size, CoverShape shape)
    : impl_(std::make_unique<Impl>(std::move(model), size, shape)) {}
ModelCoverer::ModelCoverer(ModelCoverer&&) noexcept = default;
ModelCoverer& ModelCoverer::operator=(ModelCoverer&&) noexcept = default;
ModelCoverer::~ModelCoverer() = default;

bool ModelCoverer::advance(std::uint32_t budget) { return impl_->advance(budget); }
double ModelCoverer::fraction() const { return impl_->fraction(); }
const BackgroundGrid& ModelCoverer::result() const { return impl_->result(); }

BackgroundGrid coveringGrid(const Model& model, double size, CoverShape shape) {
  ModelCoverer coverer(model, size, shape);
  while (!coverer.advance(std::numeric_limits<std::uint32_t>::max())) {
  }
  return coverer.result();
}

}  // namespace tetrafront
