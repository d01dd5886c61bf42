#pragma once

/// @file A pocket enlarged by the elements around it, which can be restored. All costs depend on
/// the elements and faces involved, not on the size of the front.

#include <cstdint>
#include <vector>

#include "geom/box.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/pocket_set.h"

namespace tetrafront {

class EnlargedPocket {
 public:
  /// Removes the elements around a pocket. Takes the pocket, and others that it merges with, out of
  /// the set.
  EnlargedPocket(Front& front, Elements& elements, PocketSet& pockets, PocketId pocket,
                 std::vector<TetId> removed);

  /// The faces that bounded it after enlarging, ascending.
  [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }
  [[nodiscard]] std::size_t removedElements() const { return removed_.size(); }
  /// Returns the active faces of the enlarged pocket as it is now, ascending.
  [[nodiscard]] std::vector<FaceId> facesNow(const Front& front, const PocketSet& pockets) const;
  /// Restores elements, faces and pockets, with the same pocket ids. Elements and nodes made since
  /// stay; the caller drops them.
  void restore(Front& front, Elements& elements, PocketSet& pockets) const;

 private:
  /// A face of a pocket before enlarging.
  struct FormerFace {
    NodeTriple nodes;
    std::uint32_t region;
    FieldHint hint;
    std::uint8_t ruleClass;
    PocketId pocket;
  };

  std::vector<TetId> removed_;
  std::vector<FaceId> faces_;
  std::vector<PocketId> touched_;        ///< pockets that have become part of it
  std::vector<FormerFace> formerFaces_;  ///< faces of these pockets
  Box box_{};
};

}  // namespace tetrafront
