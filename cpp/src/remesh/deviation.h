#pragma once

/// @file The distance between the given surface and the remeshed one: a bound, and samples per triangle for display.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "base/resumable.h"
#include "geom/triangle_frame.h"
#include "remesh/guarded_surface.h"
#include "remesh/triangle_parts.h"
#include "search/box_tree.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// An upper bound of the distance from the points of the given surface to the remeshed one, patch by patch. Not a sample:
/// the distance to one triangle is convex, so over a part of a triangle it is largest at a corner. Parts are divided at
/// the edges of the triangle next to them until their bound is at most that of all before, or little above the distance
/// itself. Planar patches need no measuring: their
/// feature lines bound their distance.
class DeviationBound : public Resumable {
 public:
  /// `surface` must outlive this. `least`: the bound is not made smaller. O(n log n).
  DeviationBound(const GuardedSurface& surface, double least);

  /// Visits given triangles until about `budget` of their parts are measured; true when finished.
  bool advance(std::size_t budget);

  [[nodiscard]] double bound() const { return bound_; }

 private:
  using Corners = TriangleCorners;

  void spreadAbove();
  void findNeighbours();
  [[nodiscard]] TriangleId walk(const Vec3& position, TriangleId from) const;
  [[nodiscard]] TriangleId nearest(const Vec3& position, SmoothPatchId patch,
                                   TriangleId guess) const;
  /// Largest distance of the corners from a triangle of the remeshed surface.
  [[nodiscard]] double boundBy(const Corners& corners, TriangleId triangle) const;
  [[nodiscard]] std::optional<Cut> findCut(const Corners& corners, TriangleId triangle) const;
  void measure(const Corners& corners, SmoothPatchId patch, TriangleId guess, int depth);

  const SurfaceComplex& complex_;
  const ReferenceSurface& reference_;
  double bound_;
  std::size_t parts_ = 0;  ///< measured in this slice
  std::vector<TriangleFrame>
      frames_;  ///< per triangle of the remeshed surface; empty in planar patches
  std::vector<TriangleId> above_;  ///< per given triangle: a remeshed one above it or near, or none
  std::vector<TriangleId> items_;  ///< triangles of the remeshed surface in curved patches
  std::vector<TriangleId>
      neighbours_;  ///< per half-edge: across it in the same curved patch, or none
  BoxTree tree_;
};

/// Returns the largest distance of the corners, of the middles of the edges and of the centroid of a triangle from the
/// patch of a reference triangle near it. `tolerance`: distances far below it need not be exact. O(log n).
[[nodiscard]] float sampledDeviation(const ReferenceSurface& reference,
                                     const std::array<Vec3, 3>& corners, TriangleId near,
                                     double tolerance);

/// Samples the distance of remeshed triangles from the given surface.
class SampledDeviation {
 public:
  /// `surface` must outlive this.
  explicit SampledDeviation(const GuardedSurface& surface)
      : surface_(surface),
        ofNode_(surface.complex().nodeCount(), -1.0F),
        ofEdge_(3 * surface.complex().triangleSlots(), -1.0F) {}

  /// Returns the largest distance of the corners, of the middles of the edges and of the centroid of a triangle from its
  /// patch; 0 in planar patches. O(log n).
  [[nodiscard]] float of(TriangleId triangle);

 private:
  [[nodiscard]] float distanceAt(const Vec3& position, TriangleId triangle) const;
  [[nodiscard]] float ofEdge(HalfEdgeId halfEdge);

  const GuardedSurface& surface_;
  std::vector<float> ofNode_;  ///< negative: not measured yet
  std::vector<float> ofEdge_;  ///< per half-edge: of its middle; negative: not measured yet
};

}  // namespace tetrafront
