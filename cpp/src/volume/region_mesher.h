#pragma once

/// @file Fills all regions of a boundary, walls between them and all. A front sees a face from one
/// side only, so regions with a common wall are filled one after the other, each from the same nodes
/// and triangles; the meshes fit together there, as none may change its boundary. Regions without a
/// common wall share one front: a boundary without walls is filled as if there were none of this.

#include <cstdint>
#include <optional>
#include <vector>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "volume/volume_mesher.h"

namespace tetrafront {

class RegionMesher {
 public:
  /// `boundary` must be as closeBoundary() leaves it. It and `field` must outlive the mesher.
  RegionMesher(const SurfaceMesh& boundary, const SizeField& field, const MeshOptions& options);
  RegionMesher(const RegionMesher&) = delete;
  RegionMesher& operator=(const RegionMesher&) = delete;

  /// Works on for about `budget` faces taken from the front. Ends with the first regions that cannot
  /// be filled.
  MeshStatus advance(std::uint32_t budget);

  /// Of kTooManyElements both values are of all regions, but for those not begun.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;
  [[nodiscard]] std::uint32_t nodeCount() const;
  [[nodiscard]] std::uint32_t tetrahedronCount() const;
  [[nodiscard]] std::uint32_t frontFaceCount() const {
    return current_->frontFaceCount() + waitingFaces_;
  }
  /// Sections of the way are the front of each turn and its recovery.
  [[nodiscard]] std::uint32_t section() const {
    return 2 * pass_ + (current_->isRecovering() ? 1 : 0);
  }
  /// How far the present section is, 0 to 1, estimated.
  [[nodiscard]] double sectionFraction() const;
  /// How many of the turns will be done at its end, 0 to 1.
  [[nodiscard]] double passFractionAtSectionEnd() const { return (pass_ + 1.0) / passCount_; }
  /// How much the fronts have left for recovery so far, in faces per triangle of the boundary, at most 1.
  [[nodiscard]] double openShare() const;
  /// How far the exact fill of this turn is, 0 to 1, estimated; 0 until there is one.
  [[nodiscard]] double exactFillFraction() const { return current_->exactFillFraction(); }

  /// The mesh as it stands; regions that were not begun are in its front.
  [[nodiscard]] VolumeMesh mesh() const;
  /// The same without a copy of what earlier turns have made; the last call but for counts.
  [[nodiscard]] VolumeMesh take();
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;

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
  std::vector<std::uint32_t> passOf_;  ///< per region: when it is filled
  std::uint32_t passCount_ = 1;
  std::uint32_t pass_ = 0;
  double openShareBefore_ = 0.0;    ///< by the fronts of earlier turns, per turn at most 1
  std::uint32_t waitingFaces_ = 0;  ///< faces of regions whose turn comes later
  PassBoundary
      passBoundary_;  ///< the boundary of this turn's regions, where there are several turns
  std::optional<VolumeMesher> current_;
  VolumeMesh filled_;  ///< by earlier turns
  RecoverySummary recovery_;
  FrontCounters counters_;
};

}  // namespace tetrafront
