#pragma once

/// @file Local improvements of a patch's triangulation: removes needless nodes, splits edges that are much too
/// long, and improves triangles with small angles. Each change is accepted by the shapes, in space, of the
/// triangles that it removes and of those that it makes.

#include <cstdint>

#include "surface/patch_metric.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"
#include "surface/planar_moves.h"

namespace tetrafront {

class PlanarImprover {
 public:
  /// All arguments must outlive this.
  PlanarImprover(const PatchMetric& metric, PlanarMesh& mesh, PlanarLinks& links,
                 PlanarMoves& moves);

  /// Splits the interior edges of a triangle that connect nodes which PlanarMesh::canConnect() forbids.
  void splitForbiddenEdges(PlanarTriangleId triangle);

  /// Splits the only triangle of a patch at its centre if no two of its nodes may be connected. The new node must
  /// not be moved or removed later.
  void splitLoneTriangle();

  /// Collapses an interior node into a neighbour if it has an edge much shorter than the target length or fewer
  /// than five triangles, and if neither shapes nor lengths become worse.
  void removeIfNeedless(PlanarNodeId node);

  /// Splits the longest edge of a triangle if it is much longer than the target length.
  void splitLongEdge(PlanarTriangleId triangle);

  /// Improves a triangle with a small angle by the best of: an edge flip, the removal of one of its nodes, an
  /// edge split. If there is none, moves its nodes.
  void widenSmallAngle(PlanarTriangleId triangle);

 private:
  struct Change {
    enum class Kind : std::uint8_t { kNone, kFlip, kCollapse, kSplit };
    Kind kind = Kind::kNone;
    double sine = 0.0;            ///< of the smallest angle that the change makes
    PlanarTriangleId triangle{};  ///< of kFlip and kSplit
    std::uint32_t corner = 0;     ///< of the triangle, opposite the edge
    PlanarNodeId node{};          ///< of kCollapse: the node to be removed
    std::size_t target = 0;       ///< of kCollapse: entry of the node's ring
    Vec2 position{0.0};           ///< of kSplit: of the new node, in the plane
  };

  [[nodiscard]] LocalSpace localSpaceAt(PlanarNodeId node);
  [[nodiscard]] double sine(const LocalSpace& local, PlanarNodeId a, PlanarNodeId b,
                            PlanarNodeId c) const;
  [[nodiscard]] double length(const LocalSpace& local, PlanarNodeId a, PlanarNodeId b) const;
  [[nodiscard]] double starSine(const LocalSpace& local, PlanarNodeId centre) const;
  [[nodiscard]] double fanSine(const LocalSpace& local, PlanarNodeId centre,
                               std::size_t target) const;
  [[nodiscard]] double longestOfFan(const LocalSpace& local, std::size_t target) const;
  [[nodiscard]] bool canRemoveCentre() const;
  void considerFlip(PlanarTriangleId t, std::uint32_t k, Change& best);
  void considerCollapses(PlanarNodeId node, Change& best);
  void considerSplit(PlanarTriangleId t, std::uint32_t k, Change& best);
  double splitSine(const LocalSpace& local, const PlanarLinks::Diamond& diamond, const Vec2& at);
  void apply(const Change& change);
  void splitAt(PlanarTriangleId t, std::uint32_t k, const Vec2& at);
  PlanarNodeId addNode(const Vec2& at);

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  PlanarLinks* links_;
  PlanarMoves* moves_;
  bool hasSeam_ = false;
  PlanarLinks::Star star_;
  FieldHint hint_;
};

}  // namespace tetrafront
