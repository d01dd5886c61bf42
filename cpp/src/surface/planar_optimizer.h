#pragma once

/// @file Improves a patch's triangulation by the shapes of the triangles in space: flips edges, moves nodes along
/// the patch, removes needless nodes and widens small angles. Boundary nodes and sides stay.

#include <cstdint>
#include <vector>

#include "surface/patch_metric.h"
#include "surface/planar_improver.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"
#include "surface/planar_moves.h"

namespace tetrafront {

class PlanarOptimizer {
 public:
  /// `mesh` must be complete when advance() is first called. Both arguments must outlive this.
  PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh);
  PlanarOptimizer(const PlanarOptimizer&) = delete;
  PlanarOptimizer& operator=(const PlanarOptimizer&) = delete;

  /// Visits about `budget` triangles or nodes; returns true when finished.
  bool advance(std::uint32_t budget);

 private:
  enum class Sweep : std::uint8_t {
    kSplitForbidden,
    kFlip,
    kSmooth,
    kPolish,
    kRemoveNodes,
    kSplitLong,
    kWidenAngles
  };
  static const std::vector<Sweep>& schedule();

  void visit(Sweep sweep, std::uint32_t index);
  void flipFrom(PlanarTriangleId triangle);
  bool flip(PlanarTriangleId t, std::uint32_t k);
  [[nodiscard]] int countFlipped(PlanarNodeId a, PlanarNodeId b, PlanarNodeId c) const;

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  PlanarLinks links_;
  PlanarMoves moves_;
  PlanarImprover improver_;
  bool isLinked_ = false;
  bool isDone_ = false;
  std::size_t sweep_ = 0;
  std::uint32_t next_ = 0;                 ///< node or triangle of the sweep
  std::vector<PlanarTriangleId> pending_;  ///< triangles whose edges flipFrom() still has to check
  FieldHint hint_;
};

}  // namespace tetrafront
