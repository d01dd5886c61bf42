#pragma once

/// @file The pockets of a stalled front: the volumes that are still empty, each with the active
/// faces around it.

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
  std::vector<FaceId> faces;  ///< ascending
  bool isSingle = true;       ///< one connected boundary, seen from inside, without islands
};

/// Returns all pockets, ordered by their smallest node. Faces that share a node bound the same
/// pocket. An island is a component seen from outside; it joins every pocket whose box contains it,
/// and these become one pocket. O(n log n) for n active faces.
[[nodiscard]] std::vector<Pocket> findPockets(const Front& front);
/// The same for some of the active faces, given in ascending order, which must bound pockets of
/// their own.
[[nodiscard]] std::vector<Pocket> findPockets(const Front& front, std::span<const FaceId> faces);

/// Returns the faces of an element as seen from inside it.
[[nodiscard]] inline std::array<NodeTriple, 4> innerFaces(const NodeQuad& n) {
  return {{{n[0], n[1], n[2]}, {n[1], n[0], n[3]}, {n[2], n[1], n[3]}, {n[0], n[2], n[3]}}};
}
/// Returns the face with the opposite orientation.
[[nodiscard]] inline NodeTriple reversed(const NodeTriple& t) { return {t[1], t[0], t[2]}; }

/// Searches for a position from which every face of the pocket is visible by exact signs, with no
/// node of another face in the elements between the position and the faces. The whole pocket can
/// then be filled by joining it to each face. Returns nothing if none is found. The pocket must be
/// single.
[[nodiscard]] std::optional<Vec3> findStarPoint(const Front& front, const Pocket& pocket);

/// Fills a pocket from its star point; returns false if it has none.
bool fillFromStarPoint(Front& front, Elements& elements, const Pocket& pocket);

}  // namespace tetrafront
