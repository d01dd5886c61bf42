#pragma once

/// @file What is left when the front can go no further: pockets, the regions still empty, each
/// with the active faces around it.

#include <cstdint>
#include <optional>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/front.h"

namespace tetrafront {

struct Pocket {
  std::vector<FaceId> faces;  ///< in the order of their ids
  bool single = true;         ///< one connected boundary, seen from inside; no islands within
};

/// All pockets, in the order of their least node. Faces that share a node bound the same pocket;
/// an island (a component seen from outside) goes to every pocket whose box holds it, which
/// joins those pockets. O(faces log faces).
[[nodiscard]] std::vector<Pocket> findPockets(const Front& front);

/// A place from which every face of the pocket is seen from its empty side, by exact signs, and
/// with no node of another face among the elements it would make with them: the whole pocket can
/// be filled by joining it to each face. Nothing if none was found. For single pockets only.
[[nodiscard]] std::optional<Vec3> findStarPoint(const Front& front, const Pocket& pocket);

}  // namespace tetrafront
