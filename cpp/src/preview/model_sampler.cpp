#include "preview/model_sampler.h"

#include <utility>

#include "preview/surface_sampler.h"

namespace tetrafront {

Task<ModelPreview> sampleModel(Work& work, const Model& model) {
  work.beginPart(0.5);
  CheckedModel found = co_await checkModel(work, model);
  work.beginPart(1.0);
  SampledModel sampled = co_await sampleSurface(work, model, found);
  sampled.preview.diagnostics = std::move(found.diagnostics);
  co_return std::move(sampled.preview);
}

ModelPreview sampleModel(const Model& model) {
  Job job([&](Work& work) { return sampleModel(work, model); });
  return job.finish();
}

std::optional<Bounds> boundsOf(const ModelPreview& preview) {
  std::optional<Bounds> bounds;
  for (const std::vector<double>* points : {&preview.linePoints, &preview.patchPoints}) {
    for (std::size_t i = 0; i < points->size() / 3; ++i) {
      const Vec3 position = sampleAt(*points, i);
      if (!bounds) bounds = {position, position};
      bounds = {glm::min(bounds->low, position), glm::max(bounds->high, position)};
    }
  }
  return bounds;
}

}  // namespace tetrafront
