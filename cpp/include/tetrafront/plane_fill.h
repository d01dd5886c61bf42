#pragma once

/// @file Fills a polygon with holes by the 2-D front of a patch, and records its steps, for figures that explain it.

#include <cstdint>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/experiment.h"
#include "tetrafront/options.h"

namespace tetrafront {

/// Limit of the sides of all loops. More of them mean that a size was mistyped.
inline constexpr std::uint32_t kMaxPlaneSides = 10'000;

struct PlaneOptions {
  double size = 0.0;  ///< uniform size, > 0; 0 if the background grid has nodes
  /// Order in which edges leave the front. kLayered is that of every patch: classes of sizes of a factor of sqrt(2),
  /// smallest first; within a class layer by layer. kSmallestFirst takes the shortest edge.
  FrontOrder order = FrontOrder::kLayered;
  std::uint32_t seed = 0;  ///< of the random order
  bool divide = true;      ///< divides segments by the sizes; otherwise each is one side
  bool improve = true;     ///< improves the triangulation afterwards, as that of every patch
  double height = 1.0;     ///< factor of the height of the ideal point, > 0
  /// Number of base edges after which the front is stopped; 0: only the boundary is divided.
  std::uint32_t maxSteps = 100'000;
};

/// How a fill has ended.
enum class PlaneStatus : std::uint8_t {
  kDone = 0,          ///< the polygon is covered
  kStalled = 1,       ///< edges of the front could not be completed
  kStopped = 2,       ///< the front was stopped after PlaneOptions::maxSteps
  kCrossing = 3,      ///< segments culprits[0] and culprits[1] intersect, except at a common end
  kHoleOutside = 4,   ///< the loop culprits[0] is not inside the first one
  kNestedHoles = 5,   ///< the loop culprits[0] is inside the loop culprits[1]
  kTooManySides = 6,  ///< the sizes require more sides than kMaxPlaneSides
};

struct PlaneFill {
  PlaneStatus status = PlaneStatus::kDone;
  /// Indices of loops, or of segments: segment i runs from point i to the next point of its loop.
  std::vector<std::uint32_t> culprits;
  std::vector<std::uint8_t> events;      ///< of lines and patches (docs/TRACE.md)
  std::vector<double> points;            ///< x y per node; those of the boundary come first
  std::vector<std::uint32_t> triangles;  ///< three nodes each, counter-clockwise
};

/// Fills the polygon in one call. The result is deterministic, and by default that of a drawn planar patch.
///
/// `points`: x y per corner, loop after loop, finite; the first loop is the outer one, the others bound holes, in any
/// orientation. `loops`: number of corners per loop, at least three. Neighbouring corners must differ. `grid`: in the
/// plane z = 0; outside its tetrahedra, the sizes are those of the nearest one. A fill of 150 triangles takes about a
/// millisecond.
[[nodiscard]] PlaneFill fillPlane(const std::vector<double>& points,
                                  const std::vector<std::uint32_t>& loops,
                                  const BackgroundGrid& grid, const PlaneOptions& options,
                                  const FrontExperiment& experiment);

}  // namespace tetrafront
