#pragma once

/// @file Finds out whether new triangles of a complex would intersect others, or pass over them.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geom/box.h"
#include "geom/intersect.h"
#include "remesh/separation.h"
#include "remesh/surface_complex.h"
#include "remesh/swept_volume.h"
#include "search/face_grid.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

[[nodiscard]] NumberedTriangle numbered(const NodeTriple& nodes,
                                        const std::array<Vec3, 3>& corners);

class TriangleGrid {
 public:
  /// `complex` must outlive this; its triangles must be inserted. `baseSize`: typical extent of a triangle.
  TriangleGrid(const SurfaceComplex& complex, double baseSize, const Vec3& origin)
      : complex_(complex), grid_(baseSize, origin) {}

  /// Inserts a triangle where its corners are now. O(1).
  void insert(TriangleId triangle);
  /// Moves a triangle to where its corners are now. O(1).
  void update(TriangleId triangle);
  void remove(TriangleId triangle) { grid_.remove(triangle.value); }

  /// Hides triangles from collide(), or shows them again.
  void setHidden(std::span<const TriangleId> triangles, bool isHidden);
  [[nodiscard]] bool isHidden(TriangleId triangle) const {
    return isHidden_[triangle.index()] != 0;
  }

  /// A replacement of triangles, which are hidden, by others with the same boundary.
  struct Replacement {
    std::span<const TriangleId> removed;
    std::span<const NumberedTriangle> added;
    NodeId moved{};  ///< a node that has another position in the added ones
  };

  /// Returns whether one of the added triangles intersects another one, or one in the grid, beyond the nodes and edges that they
  /// share; or whether one in the grid lies between the removed and the added ones (swept_volume.h). Exact, except
  /// that a triangle may count as lying between them where roundings decide.
  [[nodiscard]] bool collide(const Replacement& change) { return collide(change, change.added); }
  /// The same, if only `uncovered` of the added triangles can intersect one in the grid.
  [[nodiscard]] bool collide(const Replacement& change,
                             std::span<const NumberedTriangle> uncovered);

 private:
  [[nodiscard]] bool intersectEachOther(std::span<const NumberedTriangle> triangles);
  [[nodiscard]] bool intersectsAny(const Replacement& change,
                                   std::span<const NumberedTriangle> triangles);
  [[nodiscard]] bool passesOverAny(const Replacement& change);

  const SurfaceComplex& complex_;
  FaceGrid grid_;
  std::vector<Box> boxes_;  ///< per triangle
  std::vector<std::uint8_t> isHidden_;
  // Scratch of collide().
  SeparationProof separation_;
  SweptVolume swept_;
  std::vector<NumberedTriangle> beforeAndAfter_;
  std::vector<Box> ofGiven_;
  std::vector<std::uint32_t> within_;  ///< triangles within the box around a change
  std::vector<std::uint32_t> found_;
};

}  // namespace tetrafront
