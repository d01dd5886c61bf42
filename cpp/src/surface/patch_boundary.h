#pragma once

/// @file The initial front of one patch: the sides of its lines, laid out in its plane.

#include <cstdint>
#include <span>
#include <vector>

#include "model/patch_surface.h"
#include "surface/line_mesher.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// The divided lines of a model: per line its division and the numbers of its nodes in the
/// surface, both in the curve's canonical direction. Lines no patch uses have neither.
struct DividedLines {
  std::vector<LineDivision> divisions;
  std::vector<std::vector<std::uint32_t>> nodes;
};

/// Which side of which line a boundary side is.
struct SideOrigin {
  std::uint32_t line;
  std::uint32_t side;  ///< in the curve's canonical direction
};

struct PatchBoundary {
  PlanarMesh mesh;                   ///< boundary nodes and sides only, the patch on their left
  std::vector<SideOrigin> origins;   ///< per side
  std::vector<std::uint32_t> loops;  ///< first side of each loop; node i begins side i
  /// True if the sides are so coarse that the outer loop of a planar patch turns the other way
  /// than its lines do.
  bool inverted = false;
};

/// Lays the sides of all loops out in the patch's plane, the outer loop counter-clockwise, holes
/// clockwise, whichever way they are drawn.
[[nodiscard]] PatchBoundary layOutBoundary(const ResolvedModel& model, const Patch& patch,
                                           const PatchSurface& surface, const SizeField& field,
                                           const DividedLines& lines);

/// The boundary sides that keep the loops from bounding a piece of the plane; ascending, each
/// once, exact. Sides that touch or cross another one where they share no node, or run over each
/// other from a common one; if there are none, those of an inverted outer loop, and the sides of
/// holes that are not inside the outer loop or are inside another hole, and of the loop that should
/// hold them or should not.
[[nodiscard]] std::vector<std::uint32_t> findInvalidSides(const PatchBoundary& boundary);

}  // namespace tetrafront
