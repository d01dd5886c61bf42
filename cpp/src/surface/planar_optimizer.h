#pragma once

/// @file Betters a patch's triangulation: side flips, moves of nodes along the patch, removal of
/// needless nodes, repair of small angles; all by the triangles' shape in space. Boundary nodes and
/// sides stay as they are.

#include <cstdint>
#include <vector>

#include "surface/patch_metric.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"
#include "surface/planar_moves.h"
#include "surface/planar_improver.h"

namespace tetrafront {

class PlanarOptimizer {
 public:
  /// `mesh` must be complete when advance() is first called. Both must outlive this.
  PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh);
  PlanarOptimizer(const PlanarOptimizer&) = delete;
  PlanarOptimizer& operator=(const PlanarOptimizer&) = delete;

  /// Examines about `budget` triangles or nodes; true when all is done.
  bool advance(std::uint32_t budget);

 private:
  enum class Sweep : std::uint8_t { kPart, kFlip, kSmooth, kPolish, kThin, kRefine, kRepair };
  static const std::vector<Sweep>& schedule();

  void visit(Sweep sweep, std::uint32_t index);
  void flipFrom(std::uint32_t triangle);
  bool flip(std::uint32_t t, std::uint32_t k);
  [[nodiscard]] int countTurned(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  PlanarLinks links_;
  PlanarMoves moves_;
  PlanarImprover repair_;
  bool linked_ = false;
  bool done_ = false;
  std::size_t sweep_ = 0;
  std::uint32_t cursor_ = 0;
  std::vector<std::uint32_t> pending_;  ///< triangles whose sides may want a flip
  FieldHint hint_;
};

}  // namespace tetrafront
