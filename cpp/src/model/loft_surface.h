#pragma once

/// @file A loft: a surface through lines, its sections, with continuous curvature across them. At each share xi of the sections a
/// natural cubic spline runs through them. Its knots are the parameters at which the sides F4 and F2 pass the sections' ends,
/// interpolated in between. What the sides deviate from the splines at their ends is added, less and less towards the other
/// side. Splines through the rows and columns of a grid of points thus give the C2 surface of bicubic pieces through the grid,
/// which is the interpolating B-spline surface. Without sections, this is a Coons patch.
///
///     eta ^  D---C         F1 runs from A to B, F2 from B to C, F3 from D to C, F4 from A to D. The sections
///         |  |---|         run from F4 to F2.
///         |  A---B
///         +--------> xi

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/curve.h"
#include "model/surface_point.h"

namespace tetrafront {

class LoftSurface {
 public:
  /// Four lines in the loop's direction, A to B, B to C, C to D, D to A; the sections from F1 to F3, whose ends must be points
  /// of F4 and F2, further along with each section.
  LoftSurface(std::span<const OrientedCurve> loop, std::span<const OrientedCurve> sections);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& unit) const;

 private:
  struct Across {
    Vec3 value;
    Vec3 byXi;
    Vec3 byEta;
  };
  [[nodiscard]] Across splineAt(const Vec2& unit) const;

  std::array<OrientedCurve, 2> sides_;     ///< F4 and F2
  std::vector<OrientedCurve> rows_;        ///< F1, the sections, F3
  std::vector<double> firstKnots_;         ///< of the rows on F4
  std::vector<double> secondKnots_;        ///< of the rows on F2
  std::array<CubicSpline<Vec3>, 2> ends_;  ///< through the ends of the rows
};

/// Returns the parameter at which a line passes one of its points at a position between its ends; none if it does not.
[[nodiscard]] std::optional<double> parameterOfPoint(const OrientedCurve& line,
                                                     const Vec3& position);

}  // namespace tetrafront
