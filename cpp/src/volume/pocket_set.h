#pragma once

/// @file The pockets of a front during recovery. Their faces can be found by their nodes.

#include <cstddef>
#include <map>
#include <vector>

#include "base/ids.h"
#include "volume/front.h"
#include "volume/pockets.h"

namespace tetrafront {

/// Visiting this many faces or elements of a pocket costs about as much as one step of the front.
inline constexpr std::size_t kTouchedPerStep = 4;

using PocketId = Id<struct PocketTag>;

/// Pockets with stable ids.
class PocketSet {
 public:
  PocketSet(const Front& front, std::vector<Pocket> pockets);

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// Ascending. Empty if the pocket has been filled or has become part of another.
  [[nodiscard]] const std::vector<FaceId>& faces(PocketId pocket) const {
    return faces_[pocket.index()];
  }
  /// Returns the nodes of its faces, ascending and unique.
  [[nodiscard]] std::vector<NodeId> nodes(PocketId pocket) const;
  PocketId add(std::vector<FaceId> faces);
  /// Assigns faces to a pocket that has none.
  void put(PocketId pocket, std::vector<FaceId> faces);
  /// Forgets the pocket's faces, which must still be active.
  void remove(PocketId pocket);

  [[nodiscard]] FaceId find(const NodeTriple& nodes) const;
  [[nodiscard]] PocketId pocketOf(FaceId face) const { return pocketOf_[face.index()]; }

 private:
  const Front& front_;
  std::vector<std::vector<FaceId>> faces_;
  std::vector<PocketId> pocketOf_;  ///< per slot of a face
  std::map<NodeTriple, FaceId> byNodes_;
};

}  // namespace tetrafront
