#pragma once

/// @file Patches that join smoothly: they interpolate their lines and the derivatives across them, which CrossField derives
/// from each line and the tangent planes at its ends.

#include <array>
#include <span>

#include "model/cross_field.h"
#include "model/surface_point.h"

namespace tetrafront {

/// A Coons patch, blended by cubics, over the unit square, with the twists of Gregory (1974). The derivatives across two lines
/// may ask for different twists at their common corner; near either line its own twist holds.
///
///     eta ^  D---C         F1 runs from A to B, F2 from B to C, F3 from D to C, F4 from A to D.
///         |  |   |
///         |  A---B
///         +--------> xi
class GregorySurface {
 public:
  /// Four lines in the loop's direction, A to B, B to C, C to D, D to A.
  explicit GregorySurface(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  std::array<OrientedCurve, 4> lines_;
  std::array<CrossField, 4> across_;
  /// Twists at the corner xi = i, eta = j, as the lines F1 or F3, and F4 or F2, ask for.
  std::array<std::array<Vec3, 2>, 2> twistAlongXi_;
  std::array<std::array<Vec3, 2>, 2> twistAlongEta_;
};

/// The side-vertex triangle of Nielson (1979) over the unit triangle. A surface of cubics runs from each corner to the opposite
/// line, with the derivative across this line; the three are blended such that at a line only the one that ends there counts,
/// first derivatives included.
///
/// eta ^   P3      F1 runs from P1 to P2 (eta = 0), F2 from P2 to P3 (xi + eta = 1),
///     |   | \      F3 from P3 to P1 (xi = 0).
///     |   P1-P2
///     +--------> xi
class NielsonSurface {
 public:
  /// Three lines, P1 to P2, P2 to P3, P3 to P1.
  explicit NielsonSurface(std::span<const OrientedCurve> loop);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  /// Position, and derivatives with respect to the barycentric coordinates of the next two corners.
  struct Fan {
    Vec3 position;
    Vec3 byNext;
    Vec3 byLast;
  };
  /// The slope with which the cubic to a place of the opposite line leaves its corner, and how it changes along the line.
  struct Departure {
    Vec3 slope;
    Vec3 change;
  };
  [[nodiscard]] Departure departureFrom(std::size_t corner, double s,
                                        const CrossField::Sample& arrival) const;
  [[nodiscard]] Fan fanFrom(std::size_t corner, double next, double last) const;
  [[nodiscard]] SurfacePoint atCorner(std::size_t corner) const;

  std::array<OrientedCurve, 3> lines_;
  std::array<CrossField, 3> across_;  ///< line i, along the cubics from the opposite corner
};

}  // namespace tetrafront
