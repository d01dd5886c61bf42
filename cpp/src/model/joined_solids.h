#pragma once

/// @file Solids that touch each other, as a CAD kernel cuts them along their common parts: each of them has a face, an edge or a
/// vertex of its own where they share one. Afterwards it is there once.

#include <cstdint>
#include <vector>

#include "tetrafront/trimmed_model.h"

namespace tetrafront {

struct JoinedSolids {
  /// A face that two solids share has both. Its loops are those of the first solid.
  TrimmedModel model;
  std::vector<std::uint32_t> givenFaces;  ///< per face: index of the face in the given model
};

/// Joins vertices at the same position, edges on the same curve between the same vertices, and faces on the same surface between the
/// same edges, of different solids: their numbers must be equal, as those are which a kernel hands out for one shape. A
/// face is shared only if the solids lie on its two sides. O(n log n).
[[nodiscard]] JoinedSolids joinSolids(TrimmedModel model);

}  // namespace tetrafront
