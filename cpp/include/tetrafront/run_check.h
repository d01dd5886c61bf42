#pragma once

/// @file Checks a model and bodies as a run does before its front starts.

#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"
#include "tetrafront/options.h"
#include "tetrafront/sliced_tool.h"
#include "tetrafront/status.h"

namespace tetrafront {

/// What a run would find before its front starts.
struct RunCheck {
  bool isFillable = false;                   ///< the front would start
  std::uint32_t expectedTetrahedra = 0;      ///< that the sizes ask for; 0 unless fillable
  std::vector<std::uint32_t> trianglePatch;  ///< of the boundary, to which diagnostics refer
  std::vector<Diagnostic> diagnostics;
};

/// Meshes lines and patches, checks the boundary and finds the sizes, in slices, as a MeshRun of the same input, and ends there.
/// A unit of work is that of a MeshRun.
class RunChecker : public SlicedTool<RunCheck> {
 public:
  /// `bodies`: as for MeshRun; without triangles, the model alone is checked.
  RunChecker(Model model, BodySurfaces bodies, BackgroundGrid grid, const MeshOptions& options);
};

}  // namespace tetrafront
