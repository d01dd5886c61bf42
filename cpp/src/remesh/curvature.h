#pragma once

/// @file Curvature of a triangulated surface, from the angles at the edges where it is smooth, and of its feature lines.

#include <cstddef>
#include <vector>

#include "remesh/feature_line.h"
#include "remesh/reference_surface.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Angle in radians below which two triangles count as coplanar.
constexpr double kFlatBend = 0.002;

/// Principal curvatures at a position of a surface.
struct Curvature {
  double largest = 0.0;  ///< absolute value of the larger one
  double other =
      0.0;  ///< the other one; negative if the surface bends the other way in that direction
};

/// Curvature tensor of some triangles times their area: half the sum of angle x length x direction x direction^T over their
/// smooth edges, where angles are negative if the surface is hollow. The eigenvalues in the surface are the principal curvatures,
/// each with the direction of the edges around which the surface bends.
class BendTensor {
 public:
  BendTensor() = default;
  /// The bend of a triangle of non-zero area. Angles up to `flatAngle`, in radians, count as 0.
  BendTensor(const ReferenceSurface& reference, TriangleId triangle, double flatAngle);

  void add(const BendTensor& other, double share);
  [[nodiscard]] Curvature over(double area) const;
  /// Half the sum of |angle| x length. Of a surface that bends one way, about the sum of both curvatures times the area.
  [[nodiscard]] double absolute() const { return absolute_; }

 private:
  Vec3 diagonal_ = Vec3(0.0);     ///< xx, yy, zz
  Vec3 offDiagonal_ = Vec3(0.0);  ///< yz, zx, xy
  double absolute_ = 0.0;
};

/// Returns the direction of the smooth edges of a triangle at which the surface bends, if they are parallel; otherwise zero.
Vec3 bendAxisOf(const ReferenceSurface& reference, TriangleId triangle);

/// Angles by which a line turns at points that follow each other.
struct LineTurn {
  Vec3 angles = Vec3(
      0.0);  ///< sum in radians, each angle along the normal of both edges; the turns of a wave cancel out
  double absolute = 0.0;  ///< sum without directions
  double length = 0.0;    ///< half the lengths of the edges at these points
};

/// The turns of a feature line.
class LineTurns {
 public:
  /// O(points of the line).
  explicit LineTurns(const FeatureLine& line);

  /// The line may turn at the points [1, end()).
  [[nodiscard]] std::size_t end() const { return before_.size() - 1; }
  /// Returns the turns at the points [first, last). O(1).
  [[nodiscard]] LineTurn over(std::size_t first, std::size_t last) const;

 private:
  std::vector<LineTurn> before_;  ///< sums over the points before each
};

}  // namespace tetrafront
