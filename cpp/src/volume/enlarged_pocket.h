#pragma once

/// @file A pocket enlarged by the elements around it, in such a way that they can be put back. All costs
/// go by what is touched, not by what the front has elsewhere.

#include <cstdint>
#include <vector>

#include "geom/box.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/pocket_set.h"

namespace tetrafront {

class EnlargedPocket {
 public:
  /// Takes elements away around a pocket. It, and others it has grown into, are no longer in the set then.
  EnlargedPocket(Front& front, Elements& elements, PocketSet& pockets, PocketId pocket,
                 std::vector<TetId> removed);

  /// All that bounded it when it had been opened, in the order of their ids.
  [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }
  [[nodiscard]] std::size_t removedElements() const { return removed_.size(); }
  /// All active faces of the position as it is now, in the order of their ids.
  [[nodiscard]] std::vector<FaceId> facesNow(const Front& front, const PocketSet& pockets) const;
  /// Puts all back but elements and nodes made since; pockets have their numbers again.
  void close(Front& front, Elements& elements, PocketSet& pockets) const;

 private:
  /// A face as it was.
  struct Before {
    NodeTriple nodes;
    std::uint32_t region;
    FieldHint hint;
    std::uint8_t ruleClass;
    PocketId pocket;
  };

  std::vector<TetId> removed_;
  std::vector<FaceId> faces_;
  std::vector<PocketId> touched_;  ///< pockets that are part of the position
  std::vector<Before> before_;     ///< their faces
  Box box_{};
};

}  // namespace tetrafront
