#pragma once

/// @file Input: the drawn model (Löhner & Parikh 1988, section 4). It has three levels: points, lines between
/// points, and patches between lines. All references are indices into the arrays of the same Model. Names and
/// ids are kept by the caller.

#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// Curve type of a line.
enum class LineType : std::uint8_t {
  kStraight = 0,   ///< two points
  kParabolic = 1,  ///< three points: start, the point at mid-parameter, end
  /// Three or more points, interpolated with chord-length parameters and continuous curvature (C2). An end is natural, or
  /// has a given tangent. If the first point is also the last, the curve is periodic: its curvature is continuous there too.
  kSpline = 2,
  kArc = 3,  ///< three points: start, a point between, end of a part of a circle
  /// Four points, of which the last is the first: the circle through the three, in their order. It begins and ends at
  /// the first point.
  kCircle = 4,
  /// Two or more points, interpolated with chord-length parameters and continuous tangents (C1): between the parabolas
  /// through neighbouring points. An end without a given tangent continues another Hermite line that ends there, and lies in
  /// the tangent plane of the smooth patches there; see endTangents(). Else it is natural.
  kHermite = 5,
};

/// Surface type of a patch over the lines F1, F2, ... of its outer loop, in the order of the loop (Löhner &
/// Parikh 1988, appendix). Patches of all types but tubes may have holes, of lines of any type that lie on the patch.
enum class PatchType : std::uint8_t {
  kPlanar = 0,                 ///< any number of lines, all in one plane (eq. 8-10)
  kIsoparametricTriangle = 1,  ///< three parabolic lines (eq. 11, 12)
  kSerendipity = 2,            ///< four parabolic lines (eq. 13)
  /// Three lines of any type (eq. 14). The formula treats the second line of the loop, F2, differently from the
  /// other two, so the first line of the loop changes the surface between the lines, but not along them. Choose as
  /// F2 the line that differs from the others, for example the base of a fan.
  kBarnhillGregoryNielson = 3,
  kCoons = 4,  ///< four lines of any type (eq. 15)
  /// Two loops of any number of lines of any type, joined by straight rulings: its rims. Positions are matched by equal
  /// parts of the rims' lengths, such that the rulings are shortest; see matchRims().
  kTube = 5,
  /// Four lines of any type. Its normals along a line depend on this line and on the tangent planes at its ends only, so that
  /// patches of this and of the next type join smoothly at a line if they have common tangents at its ends.
  kGregory = 6,
  kNielson = 7,  ///< three lines of any type, with the same normals
  /// Four lines of any type, and sections: lines from points of the fourth line to points of the second. The surface
  /// follows all of them, with continuous curvature across the sections.
  kLoft = 8,
};

/// Returns whether patches of a type join others smoothly.
[[nodiscard]] constexpr bool isSmooth(PatchType type) {
  return type == PatchType::kGregory || type == PatchType::kNielson;
}

struct Line {
  LineType type = LineType::kStraight;
  std::vector<std::uint32_t> points;  ///< indices into Model::points, in the line's direction
  /// Tangents at the ends of a spline or Hermite line, of any length, in the line's direction; zero for none. Ignored by
  /// lines of other types and closed ones.
  Vec3 startTangent{0.0};
  Vec3 endTangent{0.0};
};

/// A line of a loop, with its direction in the loop.
struct OrientedLine {
  std::uint32_t line = 0;  ///< index into Model::lines
  bool reversed = false;   ///< from its last point to its first
};

/// A closed chain of lines: each line begins at the end of the line before it, the first at the end of the last.
using Loop = std::vector<OrientedLine>;

struct Patch {
  PatchType type = PatchType::kPlanar;
  std::vector<Loop>
      loops;  ///< the outer loop, then the holes, or the two rims; each in either direction
  /// Lines of a loft, from its first line to its third; each from the fourth to the second. They carry no nodes.
  std::vector<OrientedLine> sections{};
};

struct Model {
  std::vector<Vec3> points;
  std::vector<Line> lines;
  std::vector<Patch> patches;
};

}  // namespace tetrafront
