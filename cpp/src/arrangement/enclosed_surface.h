#pragma once

/// @file The boundary of what a surface encloses, for surfaces that intersect themselves: their arrangement
/// (arrangement.h), of which the boundary of the inside remains (part_shells.h), with its points rounded to doubles. Rounding can
/// make triangles intersect again. They are resolved in further rounds. If a few rounds do not suffice, the next attempt
/// begins with the given surface and welds the points of intersecting triangles within a larger distance (compare the
/// rounding to ever coarser grids by Valque & Lazard 2025).

#include <cstddef>
#include <cstdint>
#include <vector>

#include "arrangement/part_shells.h"
#include "base/ids.h"
#include "base/task.h"
#include "tetrafront/mesh.h"
#include "topology/tracked_surface.h"

namespace tetrafront {

/// Why a surface could not be resolved. The values are those of kUnresolvedSurface.
enum class Unresolved : std::uint8_t {
  kNone = 0,
  kNothingEnclosed = 1,
  kMostlySheets = 2,  ///< decided by the caller, from `sheetShare`
  kTooManyPairs = 3,
  kTooMuchWork = 4,
  kRounding = 5,    ///< rounded triangles intersect again, within every weld distance
  kNotAccepted = 6  ///< decided by the caller
};

/// Its points are the given ones, then the new ones; some may be unused. Every triangle has a given one.
struct EnclosedSurface : TrackedSurface {
  std::vector<std::uint8_t> isCut;  ///< per given triangle: whether others intersect it
  /// Largest distance by which a point was moved, in model units.
  double deviation = 0.0;
  /// Largest share of the area that was left out in one round because it has the same volume on both sides.
  double sheetShare = 0.0;
  std::uint32_t rounds = 0;
  bool isResolved = false;                ///< no two triangles intersect
  Unresolved reason = Unresolved::kNone;  ///< of the last attempt
  TriangleId where;                ///< a given triangle at which the last attempt failed, or none
  std::size_t pairs = 0;           ///< intersecting pairs of the last round
  std::size_t limit = 0;           ///< the number that was exceeded, or 0
  std::vector<SharedCell> shared;  ///< volumes that several of the given regions share
};

/// Limits of the work, so that a surface that cannot be resolved is reported soon. Tests lower them.
struct EnclosingLimits {
  std::size_t pairs = 4'000'000;  ///< intersecting pairs of the given triangles
  /// Triangles after a round, in addition to 20 per given one: few crossing plates make a large lattice.
  std::size_t freeTriangles = 500'000;
  std::uint32_t rounds = 5;  ///< after the first one of each attempt
};

/// Returns the boundary of the inside. `mesh`: triangles with valid indices and finite coordinates; it must outlive the task. They
/// may intersect, coincide and be degenerate. They should be closed and agree in orientation; triangles that enclose nothing are
/// left out. `weldDistance`: points of intersecting triangles are welded within it, in model units; 0 for none. If that changes
/// the volume by more than 0.1 %, within a quarter or a sixteenth of it, or not at all. Faces that nearly
/// coincide otherwise leave steps as low as the rounding of their coordinates. O(n log n) for n triangles that have few
/// others near them. Further attempts are made only while the triangles and pairs of all rounds are at most 100 times those
/// given.
///
/// If `mesh` has triangleRegions, so have the results. Volumes that regions share belong to the lowest of them. If none share any, or if
/// the given regions contradict each other, nothing is resolved: the surface is better enclosed without them.
///
/// Returns the results, the best first: with points welded, if that is wanted and possible, then without. If the first one is not
/// resolved, it is the only one.
Task<std::vector<EnclosedSurface>> encloseSurface(Work& work, const SurfaceMesh& mesh,
                                                  double weldDistance = 0.0,
                                                  EnclosingLimits limits = {});

/// Returns the first of the given triangles of which nothing is left, or none. O(triangles).
[[nodiscard]] TriangleId firstLeftOut(std::size_t givenTriangles, const EnclosedSurface& enclosed);

}  // namespace tetrafront
