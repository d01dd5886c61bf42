#pragma once

/// @file Curvatures that sizes follow from. Triangles of two tessellations of a round face that were cut along each other bend by
/// turns more and less than the face, or the other way. So a curvature is the mean over the widest cell, or along the longest
/// stretch of a line, that an edge may cross.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/task.h"
#include "remesh/curvature.h"
#include "remesh/piece_cells.h"

namespace tetrafront {

/// Sizes that a curvature allows.
struct CurvatureRule {
  double anglePerEdge = 0.0;  ///< largest angle that an edge spans, in radians
  double tolerance = 0.0;     ///< largest distance of a triangle from the surface

  [[nodiscard]] double sizeFor(const Curvature& curvature) const;
};

/// Angle in radians below which a feature line counts as straight, at a point or along a stretch.
constexpr double kStraightAngle = 0.01;

/// Returns the mean curvature at each piece of a surface; zero if it is planar there. Where the surface bends more than an edge may
/// in the narrowest cell of `cells`, or one way as much as the other, it is the curvature of the piece itself. O(n log n).
Task<std::vector<Curvature>> findMeanCurvatures(Work& work, const ReferenceSurface& reference,
                                                const PieceCells& cells, const CurvatureRule& rule);

/// Returns the mean curvature of a line around one of its points; stretches are as long as the cells are wide. `ofPoints`: the
/// curvature at the point, which is returned if the line bends more than an edge may in all of them. O(log n).
double meanCurvatureAlong(const FeatureLine& line, const LineTurns& turns, std::size_t point,
                          double ofPoints, const PieceCells& cells, const CurvatureRule& rule);

}  // namespace tetrafront
