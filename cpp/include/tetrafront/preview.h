#pragma once

/// @file Samples a drawn model for display and checks it before it is meshed.

#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/model.h"
#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// A model as a viewer draws it before it is meshed.
struct ModelPreview {
  /// Polyline of line l: linePoints[3i..3i+2] for i in lineOffsets[l] .. lineOffsets[l+1]-1.
  std::vector<double> linePoints;
  std::vector<std::uint32_t> lineOffsets;
  /// Triangles of patch p: patchTriangles[3t..3t+2] for t in patchOffsets[p] .. patchOffsets[p+1]-1, indices into
  /// patchPoints (x y z). A patch that cannot be evaluated has no triangles.
  std::vector<double> patchPoints;
  std::vector<std::uint32_t> patchTriangles;
  std::vector<std::uint32_t> patchOffsets;
  /// All problems of the model and of the background grid.
  std::vector<Diagnostic> diagnostics;
};

/// Samples lines and patches coarsely for display, and checks the model. Invalid parts are reported and left out of
/// the picture. `options` are those of the run to come: with a uniform size, only the sources of the grid are checked.
/// Takes milliseconds for typical models.
[[nodiscard]] ModelPreview previewModel(const Model& model, const BackgroundGrid& grid,
                                        const MeshOptions& options = {});

/// Does the work of previewModel() in slices, so that a preview can be cancelled.
class ModelPreviewer : public SlicedTool<ModelPreview> {
 public:
  /// The arguments are copied. `samplesOnly`: checks neither the surface that the patches form nor the sizes; the diagnostics are
  /// those of points, lines and patches by themselves.
  ModelPreviewer(Model model, BackgroundGrid grid, const MeshOptions& options = {},
                 bool samplesOnly = false);
};

}  // namespace tetrafront
