#pragma once

/// @file A model as the preview samples it, for questions about its extent and shape.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/check_model.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

/// The model's lines and patches as previewModel() draws them, with what it does not tell: which
/// points of the patches are one node of the surface.
struct SampledModel {
  ModelPreview preview;  ///< without diagnostics
  /// Per point of preview.patchPoints: a number of its own, unless patches share it, as they do
  /// on common lines; the same on lines and at points that were drawn twice.
  std::vector<std::uint32_t> nodes;
  /// Per patch: 1 if its triangles end in the nodes of its lines.
  std::vector<std::uint8_t> isJoined;
};
[[nodiscard]] SampledModel sampleSurface(const Model& model, const CheckedModel& found);

/// sampleSurface() in slices.
class SurfaceSampler {
 public:
  class Impl;

  /// Both must outlive this.
  SurfaceSampler(const Model& model, const CheckedModel& found);
  SurfaceSampler(SurfaceSampler&&) noexcept;
  SurfaceSampler& operator=(SurfaceSampler&&) noexcept;
  ~SurfaceSampler();

  /// Samples `budget` patches; true when finished.
  bool advance(std::uint32_t budget);

  /// Once, when finished.
  [[nodiscard]] SampledModel take();

 private:
  std::unique_ptr<Impl> impl_;
};

/// Only these patches, with `refinement` times as many pieces and cells.
[[nodiscard]] SampledModel sampleFinely(const Model& model, const CheckedModel& found,
                                        std::uint32_t refinement,
                                        std::span<const std::uint32_t> patches);

/// previewModel() with nothing but checkModel()'s diagnostics.
[[nodiscard]] ModelPreview sampleModel(const Model& model);

/// How many patches to look at for `budget` steps of the front, one of them at least.
[[nodiscard]] constexpr std::uint32_t patchesWithin(std::uint32_t budget) {
  constexpr std::uint32_t kBudgetPerPatch = 64;
  return std::max(budget / kBudgetPerPatch, 1U);
}

/// sampleModel() in slices.
class ModelSampler {
 public:
  /// The model must outlive this.
  explicit ModelSampler(const Model& model) : model_(&model), examiner_(model) {}

  /// Works on for about `budget` steps of the front; true when finished.
  bool advance(std::uint32_t budget);

  /// 0 to 1.
  [[nodiscard]] double fraction() const;

  /// Once, when finished.
  [[nodiscard]] ModelPreview take();

 private:
  const Model* model_;
  ModelChecker examiner_;
  CheckedModel found_;
  std::optional<SurfaceSampler> sampler_;  ///< once the examination is over
  std::size_t looks_ = 0;                  ///< at patches, of which each gets two
};

struct Extent {
  Vec3 low{0.0};
  Vec3 high{0.0};
};

/// The axis-parallel box of all samples; nothing if there are none.
[[nodiscard]] std::optional<Extent> extentOf(const ModelPreview& preview);

/// Sample i of preview.linePoints or patchPoints.
[[nodiscard]] inline Vec3 sampleAt(const std::vector<double>& points, std::size_t i) {
  return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
}

/// Uniform size of a model about which nothing else is known, as a share of its diagonal.
inline constexpr double kUniformPerDiagonal = 1.0 / 20.0;

}  // namespace tetrafront
