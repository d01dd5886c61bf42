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

namespace tetrafront {

class RegionMesher {
 public:
  /// `boundary` must be as closeBoundary() leaves it. It and `field` must outlive the mesher.
  RegionMesher(const SurfaceMesh& boundary, const SizeField& field, const MeshOptions& options);
  RegionMesher(const RegionMesher&) = delete;
  RegionMesher& operator=(const RegionMesher&) = delete;

  /// Does work that costs about `budget` steps of the front. Ends with the first pass that fails.
  MeshStatus advance(std::uint32_t budget);

  /// Triangles are those of the whole boundary. The values of kTooManyElements count all passes
  /// begun so far.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;
  [[nodiscard]] std::uint32_t nodeCount() const;
  [[nodiscard]] std::uint32_t tetrahedronCount() const;
  [[nodiscard]] std::uint32_t frontFaceCount() const {
    return current_->frontFaceCount() + waitingFaces_;
  }
  /// Index of the current section. Each pass has two: its front and its recovery.
  [[nodiscard]] std::uint32_t section() const {
    return 2 * pass_ + (current_->isRecovering() ? 1 : 0);
  }
  /// Estimated progress of the current section, 0 to 1.
  [[nodiscard]] double sectionFraction() const;
  /// Share of the passes that are done when the current section ends, 0 to 1.
  [[nodiscard]] double passFractionAtSectionEnd() const { return (pass_ + 1.0) / passCount_; }
  /// Faces that the fronts have left to recovery so far, per triangle of the boundary; at most 1.
  [[nodiscard]] double openShare() const;
  /// Estimated progress of the exact fill of this pass, 0 to 1; 0 before it starts.
  [[nodiscard]] double exactFillFraction() const { return current_->exactFillFraction(); }

  /// Returns the mesh made so far. Its front includes the faces of regions whose pass has not
  /// begun.
  [[nodiscard]] VolumeMesh mesh() const;
  /// The same without copying the mesh of earlier passes. Afterwards only recovery() and counters()
  /// may be called.
  [[nodiscard]] VolumeMesh take();
  /// The faces of the front, x y z of three corners each, including the boundary of regions that have
  /// not begun. O(front).
  [[nodiscard]] std::vector<double> frontCorners() const;
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
  std::vector<std::uint32_t> passOf_;  ///< per region
  std::uint32_t passCount_ = 1;
  std::uint32_t pass_ = 0;
  double openShareBefore_ = 0.0;    ///< sum of the open shares of earlier passes, each at most 1
  std::uint32_t waitingFaces_ = 0;  ///< faces of regions of later passes
  PassBoundary passBoundary_;       ///< used if there are several passes
  std::optional<VolumeMesher> current_;
  VolumeMesh filled_;  ///< mesh of earlier passes
  RecoverySummary recovery_;
  FrontCounters counters_;
};

}  // namespace tetrafront
