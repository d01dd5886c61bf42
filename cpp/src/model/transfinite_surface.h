#pragma once

/// @file Patches that blend whole line functions of any type (Löhner & Parikh 1988, appendix,
/// eq. 14 and 15).

#include <array>
#include <span>

#include "model/curve.h"
#include "model/surface_point.h"

namespace tetrafront {

/// The Barnhill-Gregory-Nielson triangle, eq. (14), over the unit triangle.
///
/// eta ^   P3      F1 runs from P1 to P2 (eta = 0), F2 from P2 to P3 (xi + eta = 1),
///     |   | \      F3 from P3 to P1 (xi = 0).
///     |   P1-P2
///     +--------> xi
///
/// With these directions the equation holds as printed: it reproduces the three lines, its weights
/// sum to one, and straight lines give the plane triangle. F2 has another role than F1 and F3: it
/// is blended by xi and eta, they by 1 - eta and 1 - xi. Starting the loop with another line
/// therefore keeps the edges but changes the surface between them. F1 and F3 may be exchanged (the
/// mirrored triangle).
class BarnhillGregoryNielsonSurface {
 public:
  /// Three lines, P1 to P2, P2 to P3, P3 to P1.
  explicit BarnhillGregoryNielsonSurface(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  std::array<OrientedCurve, 3> lines_;
};

/// The bilinear transfinite patch, eq. (15), over the unit square.
///
///     eta ^  D---C         F1 runs from A to B, F2 from B to C, F3 from D to C, F4 from A to D.
///         |  |   |
///         |  A---B
///         +--------> xi
class CoonsSurface {
 public:
  /// Four lines in the loop's direction, A to B, B to C, C to D, D to A. The last two are reversed,
  /// as the equation requires.
  explicit CoonsSurface(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  std::array<OrientedCurve, 4> lines_;
};

}  // namespace tetrafront
