#pragma once

/// @file The initial front of a tube. The tube is cut along a seam from the first node of its first rim to the opposite
/// node of its second rim, and unrolled:
///
///     second rim  +--<--+     The seam occurs on both sides, with the same nodes of the surface. If no node of the
///                 |     |     second rim lies on the ruling from the first node, the seam is slightly inclined.
///           seam  |     |  seam
///                 |     |
///     first rim   +-->--+
///
/// The seam is not a line of the model: its nodes belong to the patch. Where corners of both rims are opposite each
/// other, the tube has a crease. It is then cut along all creases, into strips that are drawn apart in the plane, so that
/// no triangle extends across a crease.

#include <vector>

#include "field/size_field.h"
#include "surface/patch_boundary.h"
#include "tetrafront/background_grid.h"

namespace tetrafront {

/// A node of a rim.
struct RimNode {
  NodeId node;
  Vec3 position{0.0};
  LineId line;        ///< of the side that begins here in the direction of the loop
  double part = 0.0;  ///< parameter of the rim
};

/// Returns the nodes of a rim in the direction of its loop.
[[nodiscard]] std::vector<RimNode> nodesOfRim(const ResolvedModel& model, const Loop& loop,
                                              const Rim& rim, const DividedLines& lines);

/// layOutBoundary() for a tube.
[[nodiscard]] PatchBoundary layOutTube(const ResolvedModel& model, const Patch& patch,
                                       const PatchSurface& surface, const SizeField& field,
                                       const DividedLines& lines);

/// Returns sources inside those tubes where the size is larger than a sixth of the circumference, at which an edge could
/// connect a node to both copies of a node of the seam.
[[nodiscard]] std::vector<SizeSource> sourcesInTubes(const std::vector<PatchSurface>& surfaces,
                                                     const SizeField& field);

}  // namespace tetrafront
