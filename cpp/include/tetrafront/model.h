#pragma once

/// @file Plain input: what the user draws (Löhner & Parikh 1988, section 4). Three levels of
/// data, each built from the one before: points, lines, patches. All references are positions
/// in the arrays of the same Model; names and ids live with the caller.

#include <cstdint>
#include <vector>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// How a line runs through its points.
enum class LineType : std::uint8_t {
  kStraight = 0,   ///< two points
  kParabolic = 1,  ///< three points: start, a point passed at mid-parameter, end
  /// Four or more points, all passed, chord-length parameter. Natural ends; if the first point is
  /// also the last, no ends: the curve is periodic, its curvature continuous there too.
  kCubicSpline = 2,
};

/// How a patch spans the lines of its outer loop (Löhner & Parikh 1988, appendix): F1, F2, ... in
/// the order in which the loop walks them. All may have holes, of lines of any type that lie on the
/// patch.
enum class PatchType : std::uint8_t {
  kPlanar = 0,                 ///< any number of lines, all in one plane (eq. 8-10)
  kIsoparametricTriangle = 1,  ///< three parabolic lines (eq. 11, 12)
  kSerendipity = 2,            ///< four parabolic lines (eq. 13)
  /// Three lines of any type (eq. 14). The loop's second line, F2, plays another role than the
  /// other two: which line the loop begins with changes the surface between the lines, though not
  /// along them. Take for F2 the line that differs from the others, say the base of a fan.
  kBarnhillGregoryNielson = 3,
  kCoons = 4,  ///< four lines of any type (eq. 15)
};

struct Line {
  LineType type = LineType::kStraight;
  std::vector<std::uint32_t> points;  ///< positions in Model::points, in the line's direction
};

/// A line as a loop walks it.
struct OrientedLine {
  std::uint32_t line = 0;  ///< position in Model::lines
  bool reversed = false;   ///< walked from its last point to its first
};

/// One closed chain: each line begins where the one before ends, the last ends at the first.
using Loop = std::vector<OrientedLine>;

struct Patch {
  PatchType type = PatchType::kPlanar;
  std::vector<Loop> loops;  ///< the outer loop first, then holes; either direction of turning
};

struct Model {
  std::vector<Vec3> points;
  std::vector<Line> lines;
  std::vector<Patch> patches;
};

}  // namespace tetrafront
