#pragma once

/// @file Coarse samples of a model's lines and patches: polylines for the lines, a lattice of points for curved patches,
/// and the triangles of the planar front, with the coarsest sides that show the bends of the lines, for the others.

#include <cstdint>
#include <span>
#include <vector>

#include "base/task.h"
#include "model/check_model.h"
#include "tetrafront/preview.h"

namespace tetrafront {

/// The lines and patches of a model as previewModel() draws them, and the points that patches share.
struct SampledModel {
  ModelPreview preview;  ///< without diagnostics
  /// Per point of preview.patchPoints: its node. Patches share the nodes on common lines, also on lines and at points
  /// that were drawn twice.
  std::vector<std::uint32_t> nodes;
  /// Per patch: 1 if its border consists of the nodes of its lines.
  std::vector<std::uint8_t> isConforming;
};

/// Samples everything that `found` says can be drawn. Both must outlive the task.
[[nodiscard]] Task<SampledModel> sampleSurface(Work& work, const Model& model,
                                               const CheckedModel& found);

/// Samples `patches` only, with `refinement` times as many points along each line and row.
[[nodiscard]] SampledModel sampleFinely(const Model& model, const CheckedModel& found,
                                        std::uint32_t refinement,
                                        std::span<const std::uint32_t> patches);

/// Sample i of preview.linePoints or preview.patchPoints.
[[nodiscard]] inline Vec3 sampleAt(const std::vector<double>& points, std::size_t i) {
  return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
}

}  // namespace tetrafront
