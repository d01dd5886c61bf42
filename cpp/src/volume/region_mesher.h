#pragma once

/// @file Meshes all regions of a boundary, one after the other. Each has a boundary and a front of its own, so its mesh does not
/// depend on other regions. Regions with a common interface fit together, because no front changes its boundary.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/task.h"
#include "field/size_field.h"
#include "lattice/lattice_interior.h"
#include "tetrafront/mesh.h"
#include "tetrafront/options.h"
#include "tetrafront/status.h"
#include "topology/region_meshes.h"
#include "volume/volume_mesher.h"

namespace tetrafront {

class RegionMesher {
 public:
  /// Typical share of the fronts in bodies with an interior.
  static constexpr double kFrontShare = 0.28;

  /// `boundary` must be as closeBoundary() leaves it. It, `field` and `maker` must outlive the mesher.
  RegionMesher(const SurfaceMesh& boundary, const SizeField& field, const MeshOptions& options,
               const FrontMaker& maker);

  /// Meshes the regions. Ends with the first one that fails. One unit of budget is a step of the front. `frontShare`: the
  /// share that the fronts have in the progress if they leave everything to recovery.
  Task<MeshStatus> run(Work& work, double frontShare = kFrontShare);

  /// Triangles and nodes are those of the whole boundary. The values of kTooManyElements count all regions
  /// begun so far.
  [[nodiscard]] std::vector<Diagnostic> diagnostics() const;
  [[nodiscard]] std::uint32_t nodeCount() const;
  [[nodiscard]] std::uint32_t tetrahedronCount() const;
  [[nodiscard]] std::uint32_t frontFaceCount() const;
  /// Estimated progress of the exact fill of this region, 0 to 1; 0 before it starts.
  [[nodiscard]] double exactFillFraction() const {
    return current_ ? current_->exactFillFraction() : 0.0;
  }
  /// Returns the meshes of the regions that have begun. The last of them may have a front.
  [[nodiscard]] RegionMeshes meshes() const;
  /// The same without a copy; once, as the last call.
  [[nodiscard]] RegionMeshes take();
  /// The faces of the front, x y z of three corners each, including the boundary of regions that have
  /// not begun. O(front).
  [[nodiscard]] std::vector<double> frontCorners() const;
  [[nodiscard]] RecoverySummary recovery() const;
  [[nodiscard]] FrontCounters counters() const;
  /// Returns how many elements come from lattices; the optimizer may change those at their hulls.
  [[nodiscard]] std::uint32_t latticeCount() const { return latticeCount_; }

 private:
  /// Boundary of one region: its nodes, and the triangles around it.
  struct RegionBoundary {
    SurfaceMesh surface;
    std::vector<std::uint32_t> nodeOf;  ///< per node: its index in the whole boundary, ascending
    std::vector<std::uint32_t> triangleOf;  ///< per triangle: its index in the whole boundary
  };

  void begin(std::uint32_t region);
  Task<> makeLattice(Work& work);
  void beginFront();
  void endRegion();
  void boundaryOf(std::uint32_t region);
  void addHull();
  [[nodiscard]] RegionMesh regionOf(TetMesh mesh) const;
  [[nodiscard]] const SurfaceMesh& ownBoundary() const {
    return isOne() ? boundary_ : regionBoundary_.surface;
  }
  void nameForUser(std::vector<Entity>& entities) const;
  [[nodiscard]] std::vector<NodeTriple> waitingFaces() const;
  [[nodiscard]] std::size_t boundaryNodes() const { return boundary_.points.size() / 3; }
  /// Number of nodes of the current region's boundary.
  [[nodiscard]] std::size_t ownBoundaryNodes() const {
    return isOne() ? boundaryNodes() : regionBoundary_.nodeOf.size();
  }
  [[nodiscard]] bool isOne() const { return halvesOf_.size() == 1; }

  const SurfaceMesh& boundary_;
  const SizeField& field_;
  MeshOptions options_;
  const FrontMaker& maker_;
  /// Per region, the sides of triangles that face it, ascending: twice the triangle, plus 1 for its front.
  std::vector<std::vector<std::uint32_t>> halvesOf_;
  std::uint32_t region_ = 0;
  RegionBoundary regionBoundary_;  ///< used if there are several regions
  LatticeInterior lattice_;        ///< of the current region
  SurfaceMesh withHull_;  ///< boundary of the region and hull of its lattice, if there is one
  std::uint32_t latticeCount_ = 0;
  std::optional<VolumeMesher> current_;
  RegionMeshes filled_;  ///< of earlier regions
  RecoverySummary recovery_;
  FrontCounters counters_;
};

}  // namespace tetrafront
