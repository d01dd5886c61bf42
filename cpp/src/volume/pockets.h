#pragma once

/// @file What is left when the front can go no further: pockets, the regions still empty, each
/// with the active faces around it.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tetrafront/vec3.h"
#include "volume/elements.h"
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
/// The same of some active faces only, given in the order of their ids, which bound positions of their own.
[[nodiscard]] std::vector<Pocket> findPockets(const Front& front, std::span<const FaceId> faces);

/// The element's sides as faces seen from inside it.
[[nodiscard]] inline std::array<NodeTriple, 4> innerFaces(const NodeQuad& n) {
  return {{{n[0], n[1], n[2]}, {n[1], n[0], n[3]}, {n[2], n[1], n[3]}, {n[0], n[2], n[3]}}};
}
/// The same face seen from its other side.
[[nodiscard]] inline NodeTriple reversed(const NodeTriple& t) { return {t[1], t[0], t[2]}; }

/// A position from which every face of the pocket is seen from its empty side, by exact signs, and
/// with no node of another face among the elements it would make with them: the whole pocket can
/// be filled by joining it to each face. Nothing if none was found. For single pockets only.
[[nodiscard]] std::optional<Vec3> findStarPoint(const Front& front, const Pocket& pocket);

/// Fills a pocket so, if it can be.
bool fillFromStarPoint(Front& front, Elements& elements, const Pocket& pocket);

}  // namespace tetrafront
