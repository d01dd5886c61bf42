#pragma once

/// @file A model as the preview samples it, for questions about its extent and shape.

#include <optional>

#include "tetrafront/mesher.h"

namespace tetrafront {

/// previewModel() without what there is to say about the background grid.
[[nodiscard]] ModelPreview sampleModel(const Model& model);

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
