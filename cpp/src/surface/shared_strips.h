#pragma once

/// @file Patches that would lie on one another. Two patches that share the lines on both sides of a
/// strip (at a corner, however sharp, or all along a thin lens) may both join the nodes of these
/// lines straight across. They then have edges, or whole triangles, in common, between which there
/// is nothing. Each of them that is not planar needs nodes of its own in the strip instead.

#include <array>
#include <cstdint>
#include <vector>

#include "model/resolved_model.h"
#include "surface/patch_boundary.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// Nodes of lines that a patch joins other than along a line: two by an edge, or three by the only
/// triangle it has. Numbers of the whole surface; an edge repeats its second.
struct Joint {
  std::uint32_t patch;
  std::array<std::uint32_t, 3> nodes;
};

/// Appends those of a finished triangulation. O(triangles).
void collectJoints(std::uint32_t patch, const PlanarMesh& mesh, std::vector<Joint>& joints);

/// Per patch, ascending: nodes of which no two may be joined other than along a line, since another
/// patch has them too, and either joins some of them. None for planar patches, which nothing could
/// part from their own plane. O(n log n) in the nodes of the lines and the joints.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> findNodesToPart(
    const Model& model, const DividedLines& lines, const std::vector<Joint>& joints);

}  // namespace tetrafront
