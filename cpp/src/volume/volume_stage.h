#pragma once

/// @file What a run needs of the mesher of regions, whether that records its steps or not.

#include <cstdint>
#include <memory>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/experiment.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "volume/step_recorder.h"

namespace tetrafront {

/// The stage of a run that fills the boundary. Virtual calls cost nothing here, because each does the work of a slice.
class VolumeStage {
 public:
  VolumeStage() = default;
  VolumeStage(const VolumeStage&) = delete;
  VolumeStage& operator=(const VolumeStage&) = delete;
  virtual ~VolumeStage() = default;

  /// Does work that costs about `budget` steps of the front. Ends with the first pass that fails.
  virtual MeshStatus advance(std::uint32_t budget) = 0;

  /// Triangles are those of the whole boundary. The values of kTooManyElements count all passes
  /// begun so far.
  [[nodiscard]] virtual std::vector<Diagnostic> diagnostics() const = 0;
  [[nodiscard]] virtual std::uint32_t nodeCount() const = 0;
  [[nodiscard]] virtual std::uint32_t tetrahedronCount() const = 0;
  [[nodiscard]] virtual std::uint32_t frontFaceCount() const = 0;
  /// Index of the current section. Each pass has two: its front and its recovery.
  [[nodiscard]] virtual std::uint32_t section() const = 0;
  /// Estimated progress of the current section, 0 to 1.
  [[nodiscard]] virtual double sectionFraction() const = 0;
  /// Share of the passes that are done when the current section ends, 0 to 1.
  [[nodiscard]] virtual double passFractionAtSectionEnd() const = 0;
  /// Faces that the fronts have left to recovery so far, per triangle of the boundary; at most 1.
  [[nodiscard]] virtual double openShare() const = 0;
  /// Estimated progress of the exact fill of this pass, 0 to 1; 0 before it starts.
  [[nodiscard]] virtual double exactFillFraction() const = 0;

  /// Returns the mesh made so far. Its front includes the faces of regions whose pass has not
  /// begun.
  [[nodiscard]] virtual VolumeMesh mesh() const = 0;
  /// The same without copying the mesh of earlier passes. Afterwards only recovery() and counters()
  /// may be called.
  [[nodiscard]] virtual VolumeMesh take() = 0;
  /// The faces of the front, x y z of three corners each, including the boundary of regions that have
  /// not begun. O(front).
  [[nodiscard]] virtual std::vector<double> frontCorners() const = 0;
  [[nodiscard]] virtual RecoverySummary recovery() const = 0;
  [[nodiscard]] virtual FrontCounters counters() const = 0;
};

/// Makes the stage of a run. All arguments but the options must outlive it.
using MakeVolumeStage = std::unique_ptr<VolumeStage> (*)(const SurfaceMesh& boundary,
                                                         const SizeField& field,
                                                         const MeshOptions& options,
                                                         StepRecorder& recorder,
                                                         const FrontExperiment& experiment);

}  // namespace tetrafront
