#pragma once

/// @file Meshes all regions of a boundary, with the interfaces between them. A front sees a face
/// from one side only, so regions with a common interface are meshed in different passes, from the
/// same nodes and triangles. Their meshes fit together, because no pass changes its boundary.
/// Regions without a common interface share one front; a boundary without interfaces needs one pass
/// and no copies.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "volume/volume_mesher.h"
#include "volume/volume_stage.h"

namespace tetrafront {

template <class Trace>
class BasicRegionMesher final : public VolumeStage {
 public:
  /// `boundary` must be as closeBoundary() leaves it. It, `field` and what `trace` refers to must outlive the mesher.
  BasicRegionMesher(const SurfaceMesh& boundary, const SizeField& field, const MeshOptions& options,
                    Trace trace = {});

  MeshStatus advance(std::uint32_t budget) override;
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const override;
  [[nodiscard]] std::uint32_t nodeCount() const override;
  [[nodiscard]] std::uint32_t tetrahedronCount() const override;
  [[nodiscard]] std::uint32_t frontFaceCount() const override {
    return current_->frontFaceCount() + waitingFaces_;
  }
  [[nodiscard]] std::uint32_t section() const override {
    return 2 * pass_ + (current_->isRecovering() ? 1 : 0);
  }
  [[nodiscard]] double sectionFraction() const override;
  [[nodiscard]] double passFractionAtSectionEnd() const override {
    return (pass_ + 1.0) / passCount_;
  }
  [[nodiscard]] double openShare() const override;
  [[nodiscard]] double exactFillFraction() const override { return current_->exactFillFraction(); }
  [[nodiscard]] VolumeMesh mesh() const override;
  [[nodiscard]] VolumeMesh take() override;
  [[nodiscard]] std::vector<double> frontCorners() const override;
  [[nodiscard]] RecoverySummary recovery() const override;
  [[nodiscard]] FrontCounters counters() const override;

 private:
  /// Boundary of the regions of one pass: all nodes, and the triangles around these regions.
  struct PassBoundary {
    SurfaceMesh surface;
    std::vector<std::uint32_t> triangleOf;  ///< per triangle: its index in the whole boundary
  };

  void begin(std::uint32_t pass);
  void nameForUser(std::vector<Entity>& entities) const;
  [[nodiscard]] PassBoundary boundaryOf(std::uint32_t pass) const;
  [[nodiscard]] std::vector<std::uint32_t> facesOfLaterPasses() const;
  [[nodiscard]] VolumeMesh completed(VolumeMesh mesh) const;

  const SurfaceMesh& boundary_;
  const SizeField& field_;
  MeshOptions options_;
  std::vector<std::uint32_t> passOf_;  ///< per region
  std::uint32_t passCount_ = 1;
  std::uint32_t pass_ = 0;
  double openShareBefore_ = 0.0;    ///< sum of the open shares of earlier passes, each at most 1
  std::uint32_t waitingFaces_ = 0;  ///< faces of regions of later passes
  PassBoundary passBoundary_;       ///< used if there are several passes
  [[no_unique_address]] Trace trace_;
  std::optional<BasicVolumeMesher<Trace>> current_;
  VolumeMesh filled_;  ///< mesh of earlier passes
  RecoverySummary recovery_;
  FrontCounters counters_;
};

extern template class BasicRegionMesher<NullTrace>;
extern template class BasicRegionMesher<RecordingTrace>;

using RegionMesher = BasicRegionMesher<NullTrace>;

/// Makes a mesher of regions that records nothing and has the usual rules.
[[nodiscard]] std::unique_ptr<VolumeStage> makeStage(const SurfaceMesh& boundary,
                                                     const SizeField& field,
                                                     const MeshOptions& options,
                                                     StepRecorder& recorder,
                                                     const FrontExperiment& experiment);

}  // namespace tetrafront
