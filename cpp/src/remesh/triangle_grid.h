#pragma once

/// @file Finds out whether new triangles of a complex would intersect others.

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "geom/box.h"
#include "geom/intersect.h"
#include "remesh/separation.h"
#include "remesh/surface_complex.h"
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

  /// Hides triangles from intersect(), or shows them again.
  void setHidden(std::span<const TriangleId> triangles, bool isHidden);
  [[nodiscard]] bool isHidden(TriangleId triangle) const {
    return isHidden_[triangle.index()] != 0;
  }

  /// Returns whether one of the triangles intersects another one, or one in the grid, beyond the nodes and edges that they
  /// share. Exact.
  [[nodiscard]] bool intersect(std::span<const NumberedTriangle> triangles) {
    return intersect(triangles, triangles);
  }
  /// The same, if only `uncovered` of the triangles can intersect one in the grid.
  [[nodiscard]] bool intersect(std::span<const NumberedTriangle> triangles,
                               std::span<const NumberedTriangle> uncovered);

 private:
  [[nodiscard]] bool intersectEachOther(std::span<const NumberedTriangle> triangles);
  [[nodiscard]] bool intersectsAny(std::span<const NumberedTriangle> triangles);

  const SurfaceComplex& complex_;
  FaceGrid grid_;
  std::vector<Box> boxes_;  ///< per triangle
  std::vector<std::uint8_t> isHidden_;
  // Scratch of intersect().
  SeparationProof separation_;
  std::vector<Box> ofGiven_;
  std::vector<std::uint32_t> found_;
};

}  // namespace tetrafront
