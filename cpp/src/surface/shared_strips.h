#pragma once

/// @file Finds patches that would coincide. Two patches may share the lines on both sides of a strip, at a sharp
/// corner or along a thin lens. Both may then connect the nodes of these lines straight across the strip, so that
/// they have edges or whole triangles in common, with no volume in between. To prevent this, each patch that is not
/// planar gets nodes of its own in the strip.

#include <vector>

#include "base/ids.h"
#include "model/resolved_model.h"
#include "surface/patch_boundary.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// Nodes of the surface that a patch connects other than along a line: the ends of a chord (the last node twice),
/// or the nodes of the only triangle of a patch.
struct Chord {
  PatchId patch;
  NodeTriple nodes;
};

/// Appends the chords of a finished triangulation. O(triangles).
void collectChords(PatchId patch, const PlanarMesh& mesh, std::vector<Chord>& chords);

/// Returns per patch, ascending, the nodes that its interior edges must not connect with each other, because another
/// patch shares them and both have chords between shared nodes. Planar patches get none: nodes in their plane would
/// separate nothing. O(n log n) in the nodes of the lines and the chords.
[[nodiscard]] std::vector<std::vector<NodeId>> findNodesToSeparate(
    const Model& model, const DividedLines& lines, const std::vector<Chord>& chords);

}  // namespace tetrafront
