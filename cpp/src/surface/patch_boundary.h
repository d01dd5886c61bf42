#pragma once

/// @file The initial front of one patch: the sides of its lines in the patch's plane.

#include <cstdint>
#include <optional>
#include <vector>

#include "base/ids.h"
#include "model/patch_surface.h"
#include "surface/divided_lines.h"
#include "surface/planar_mesh.h"

namespace tetrafront {

/// The side of a line that a boundary side of a patch is.
struct SideOrigin {
  LineId line;         ///< none for a side of the seam of a tube
  std::uint32_t side;  ///< in the curve's canonical direction
};

struct PatchBoundary {
  PlanarMesh mesh;                   ///< boundary nodes and sides only
  std::vector<SideOrigin> origins;   ///< per side
  std::vector<std::uint32_t> loops;  ///< per loop: its first side; the rims of a tube are one loop
  /// Nodes on the seam of a tube, which belong to the patch alone: node i is DividedLines::nodeCount + i, and occurs
  /// twice in the plane.
  std::vector<Vec3> seam;
  /// True if the sides are so coarse that the outer loop of a planar patch has the opposite orientation of its
  /// lines.
  bool isFlipped = false;
};

/// Places the sides of all loops in the patch's plane: the outer loop counter-clockwise and the holes clockwise, in
/// whichever direction they are drawn.
[[nodiscard]] PatchBoundary layOutBoundary(const ResolvedModel& model, const Patch& patch,
                                           const PatchSurface& surface, const SizeField& field,
                                           const DividedLines& lines);

/// Returns the sides that keep the loops from bounding a piece of the plane; ascending, without duplicates, exact.
/// These are the sides that intersect another one, except at a common node. If there are none, they are the sides of
/// misplaced loops: a flipped outer loop, a hole outside the outer loop together with that loop, and two holes of
/// which one contains the other.
[[nodiscard]] std::vector<std::uint32_t> findInvalidSides(const PatchBoundary& boundary);

/// One reason why loops do not bound a piece of the plane.
struct LoopProblem {
  enum class Kind : std::uint8_t {
    kCrossing = 0,     ///< sides `first` and `second` intersect, except at a common node
    kHoleOutside = 1,  ///< loop `first` is outside the outer loop, which is loop `second`
    kNestedHoles = 2,  ///< loop `first` is inside loop `second`, another hole
  };
  Kind kind;
  std::uint32_t first;
  std::uint32_t second;
};

/// Returns the first problem; none if findInvalidSides() finds no sides and the outer loop is not flipped. Exact.
[[nodiscard]] std::optional<LoopProblem> findLoopProblem(const PatchBoundary& boundary);

}  // namespace tetrafront
