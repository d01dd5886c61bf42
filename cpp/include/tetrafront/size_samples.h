#pragma once

/// @file The size field of a project before it is meshed: sizes at positions, and the number of elements to expect.

#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"
#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

struct SizeSamples {
  /// Per position: the target edge length; where the field is stretched, that of a regular element with the same volume.
  /// Outside a background grid, the value at the nearest tetrahedron. Empty if the sizes are invalid.
  std::vector<double> sizes;
  /// Estimated number of tetrahedra of the mesh; 0 if the sizes are invalid or the surface encloses no volume.
  double tetrahedra = 0.0;
};

/// Samples the size field of a drawn model with bodies at positions, x y z each, and estimates the number of elements
/// from the samples of previewModel() and the triangles of the bodies. `options` are those of the run to come. Without a
/// size and a grid, the sizes follow the edges of the bodies. Costs as much as previewModel(), and about a microsecond
/// per position and per triangle of a body.
[[nodiscard]] SizeSamples sampleSizes(const Model& model, const BodySurfaces& bodies,
                                      const BackgroundGrid& grid, const MeshOptions& options,
                                      const std::vector<double>& positions);

/// Does the work of sampleSizes() in slices.
class SizeSampler : public SlicedTool<SizeSamples> {
 public:
  SizeSampler(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options,
              std::vector<double> positions);
};

}  // namespace tetrafront
