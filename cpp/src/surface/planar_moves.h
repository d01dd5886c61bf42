#pragma once

/// @file Moves of a patch's inner nodes: along the patch, judged by the triangles' shapes in space.

#include <cstdint>

#include "surface/patch_metric.h"
#include "surface/planar_links.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

class PlanarMoves {
 public:
  /// All must outlive this.
  PlanarMoves(const PatchMetric& metric, PlanarMesh& mesh, const PlanarLinks& links)
      : metric_(&metric), mesh_(&mesh), links_(&links) {}

  /// Moves a node towards the mean of the places at which its triangles would be equilateral and of
  /// the wanted size, if that lowers what their shapes cost. Boundary nodes stay.
  void smooth(std::uint32_t node);

  /// Searches, around where a node is, for the place at which its triangles' shapes cost least, if
  /// they cost much. Boundary nodes stay.
  void polish(std::uint32_t node);

  /// Searches, around where a node is, for the place at which the smallest angle of its triangles
  /// is largest. Boundary nodes stay.
  void widen(std::uint32_t node);

 private:
  /// What the triangles around a node are worth if it stands at `place`; more is better.
  enum class Rating : std::uint8_t { kShapes, kSmallestSine };
  [[nodiscard]] Vec3 wantedPlace(std::uint32_t node, const LocalSpace& local) const;
  [[nodiscard]] double rate(Rating rating, const Vec3& place, const LocalSpace& local) const;
  [[nodiscard]] Vec2 stepFor(const SurfacePoint& here, const Vec3& move) const;
  void search(std::uint32_t node, Rating rating, double rated, const LocalSpace& local);
  bool moveTo(std::uint32_t node, const Vec2& to, Rating rating, double least,
              const LocalSpace& local);

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  const PlanarLinks* links_;
  PlanarLinks::Star star_;
  FieldHint hint_;
};

}  // namespace tetrafront
