#pragma once

/// @file Betters a patch's triangulation: side flips and smoothing, by the triangles' shape in
/// space. Nodes stay on the patch, boundary nodes stay where they are, and no step lowers the
/// worst shape of the triangles it changes.

#include <cstdint>
#include <vector>

#include "surface/patch_metric.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

class PlanarOptimizer {
 public:
  /// `mesh` must be complete. Both must outlive this.
  PlanarOptimizer(const PatchMetric& metric, PlanarMesh& mesh);

  /// Examines about `budget` triangles or nodes; true when all is done.
  bool advance(std::uint32_t budget);

 private:
  /// A triangle's three neighbours: [k] lies across from node k; kNone at the boundary.
  using Neighbours = std::array<std::uint32_t, 3>;
  enum class Stage : std::uint8_t { kLink, kFlip, kSmooth, kDone };

  void link();
  void flipFrom(std::uint32_t triangle);
  bool flip(std::uint32_t t, std::uint32_t k);
  void replaceNeighbour(std::uint32_t triangle, std::uint32_t old, std::uint32_t now);
  void smooth(std::uint32_t centre);
  bool collectStar(std::uint32_t centre);
  [[nodiscard]] Vec3 wantedPlace(std::uint32_t centre, const LocalSpace& local) const;
  [[nodiscard]] double worstShape(const Vec3& place, const LocalSpace& local) const;
  bool moveIfBetter(std::uint32_t centre, const Vec2& to, double worst, const LocalSpace& local);
  [[nodiscard]] std::uint32_t corner(std::uint32_t triangle, std::uint32_t wanted) const;
  [[nodiscard]] std::uint32_t node(std::uint32_t triangle, std::uint32_t corner) const {
    return mesh_->triangles[3 * std::size_t{triangle} + corner];
  }

  const PatchMetric* metric_;
  PlanarMesh* mesh_;
  Stage stage_ = Stage::kLink;
  int sweep_ = 0;
  std::uint32_t cursor_ = 0;
  std::vector<Neighbours> neighbours_;
  std::vector<std::uint32_t> triangleOf_;  ///< per node: one of its triangles
  std::vector<std::uint32_t> pending_;     ///< triangles whose sides may want a flip
  std::vector<std::uint32_t> ring_;        ///< nodes around the node being smoothed, in order
  FieldHint hint_;
};

}  // namespace tetrafront
