#pragma once

/// @file Moves of a patch's interior nodes along the patch. A move must improve the shapes of the node's
/// triangles in space.

#include <cstdint>

#include "surface/patch_metric.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// The functions ignore boundary nodes and removed nodes.
class PlanarMoves {
 public:
  /// All arguments must outlive this.
  PlanarMoves(const PatchMetric& metric, PlanarMesh& mesh, const PlanarLinks& links)
      : metric_(&metric), mesh_(&mesh), links_(&links) {}

  /// Moves a node towards the mean of the positions at which its triangles would be equilateral and of the
  /// target size, if this lowers the cost of their shapes.
  void smooth(PlanarNodeId node);

  /// Searches around a node for the position with the lowest cost of its triangles' shapes, if the cost is high.
  void polish(PlanarNodeId node);

  /// Searches around a node for the position at which the smallest angle of its triangles is largest.
  void widenAngles(PlanarNodeId node);

 private:
  /// What rates a position of a node: minus the cost of its triangles' shapes, or the sine of their smallest
  /// angle. A higher rating is better.
  enum class Rating : std::uint8_t { kShapes, kSmallestSine };
  [[nodiscard]] Vec3 targetPosition(PlanarNodeId node, const LocalSpace& local) const;
  [[nodiscard]] double rate(Rating rating, const Vec3& position, const LocalSpace& local) const;
  [[nodiscard]] Vec2 stepFor(const SurfacePoint& here, const Vec3& move) const;
  void search(PlanarNodeId node, Rating rating, double rated, const LocalSpace& local);
  bool moveTo(PlanarNodeId node, const Vec2& to, Rating rating, double minRating,
              const LocalSpace& local);

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  const PlanarLinks* links_;
  PlanarLinks::Star star_;
  FieldHint hint_;
};

}  // namespace tetrafront
