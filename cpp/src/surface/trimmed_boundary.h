#pragma once

/// @file The initial front of a trimmed face: the sides of its edges in the plane of the face.

#include "model/face_loops.h"
#include "surface/patch_boundary.h"

namespace tetrafront {

/// Places the sides of all loops in the face's plane: the loop with the largest area counter-clockwise and the others
/// clockwise. `loops` must be usable. In `lines` and in the origins of sides, lines are the edges of the model.
[[nodiscard]] PatchBoundary layOutFace(const FaceLoops& loops, const FacePlane& plane,
                                       const SizeField& field, const DividedLines& lines);

}  // namespace tetrafront
