#pragma once

/// @file Checks the loops of a planar patch against each other, on samples of their curves.
/// Contacts below the sampling are found when the lines are divided, where exact signs decide.

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/tolerance.h"
#include "model/patch_surface.h"

namespace tetrafront {

/// A loop as a closed polygon in the patch's plane.
struct PlaneLoop {
  std::vector<Vec2> points;
  std::vector<LineId> lines;  ///< per point: the line of the side that begins there
};
[[nodiscard]] PlaneLoop layOutLoop(const ResolvedModel& model, const Loop& loop,
                                   const PlanarSurface& surface);

/// Start of a line in a loop. Sorted by points, so that lines at one point are neighbours.
struct LineStart {
  PointId point;
  LineId line;
  friend auto operator<=>(const LineStart&, const LineStart&) = default;
};
void appendStarts(const ResolvedModel& model, const Loop& loop, std::vector<LineStart>& starts);

/// Returns the first point at which two lines begin, with both lines. O(n log n).
struct RepeatedPoint {
  PointId point;
  LineId firstLine;
  LineId secondLine;
};
[[nodiscard]] std::optional<RepeatedPoint> findRepeatedPoint(std::vector<LineStart> starts);

/// Two lines that touch where they are not connected.
struct LoopContact {
  LineId firstLine;
  LineId secondLine;
  Vec2 position;
};
/// Returns the first contact found; `tolerance` is relative to the patch. O(n log n) for n samples.
[[nodiscard]] std::optional<LoopContact> findContact(std::span<const PlaneLoop> loops,
                                                     const Tolerance& tolerance);

/// Returns the first loop after loops[0] that is not inside it, or is inside another hole. The
/// loops must not touch.
[[nodiscard]] std::optional<std::size_t> findMisplacedHole(std::span<const PlaneLoop> loops);

}  // namespace tetrafront
