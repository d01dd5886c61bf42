#pragma once

/// @file Patches with polynomial shape functions, defined by the end points and mid-points of their
/// parabolic lines (Löhner & Parikh 1988, appendix, eq. 11-13). The parabola of a line passes its
/// mid-point at half its parameter, and so does the edge of these surfaces: edges and lines are the
/// same curves, parameter by parameter.

#include <array>
#include <span>

#include "model/curve.h"
#include "model/surface_point.h"

namespace tetrafront {

/// The six-node triangle, eq. (11) and (12), over the unit triangle.
///
///     eta ^  P3            Nodes as printed: P1, mid-point of P1-P2, P2, mid-point of P2-P3,
///         |  | \           P3, mid-point of P3-P1.
///         |  P1-P2
///         +--------> xi
class IsoparametricTriangle {
 public:
  /// Three parabolic lines, P1 to P2, P2 to P3, P3 to P1.
  explicit IsoparametricTriangle(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  Vec3 origin_;                  ///< P1
  std::array<Vec3, 5> offsets_;  ///< from P1 to the other nodes
};

/// The eight-node serendipity quadrilateral, eq. (13), over the unit square.
///
///     eta ^  D---C         Nodes as printed: A, mid-point of A-B, B, mid-point of B-C, C,
///         |  |   |         mid-point of C-D, D, mid-point of D-A.
///         |  A---B
///         +--------> xi
class SerendipitySurface {
 public:
  /// Four parabolic lines, A to B, B to C, C to D, D to A.
  explicit SerendipitySurface(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  Vec3 origin_;                  ///< A
  std::array<Vec3, 7> offsets_;  ///< from A to the other nodes
};

}  // namespace tetrafront
