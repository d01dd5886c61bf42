#pragma once

/// @file A pocket enlarged by the elements around it, in such a way that they can be put back. All costs
/// go by what is touched, not by what the front has elsewhere.

#include <cstdint>
#include <map>
#include <vector>

#include "geom/box.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/pockets.h"

namespace tetrafront {

/// The pockets of a front, each face's number known by its nodes.
class PocketSet {
 public:
  using Number = std::uint32_t;
  static constexpr Number kNone = 0xffffffffU;

  PocketSet(const Front& front, std::vector<Pocket> pockets);

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  /// None, if the pocket has been filled or has become a part of another.
  [[nodiscard]] const std::vector<FaceId>& faces(Number pocket) const { return faces_[pocket]; }
  /// Without repeats, ascending.
  [[nodiscard]] std::vector<NodeId> nodes(Number pocket) const;
  Number add(std::vector<FaceId> faces);
  /// Gives faces to a pocket that has none.
  void put(Number pocket, std::vector<FaceId> faces);
  /// Forgets its faces, which must still be active.
  void remove(Number pocket);

  [[nodiscard]] FaceId find(const NodeTriple& nodes) const;
  [[nodiscard]] Number pocketOf(FaceId face) const { return pocketOf_[face.index()]; }

 private:
  const Front& front_;
  std::vector<std::vector<FaceId>> faces_;
  std::vector<Number> pocketOf_;  ///< per place for a face
  std::map<NodeTriple, FaceId> byNodes_;
};

class OpenedPlace {
 public:
  /// Takes elements away around a pocket. It, and others it has grown into, are no longer in the set then.
  OpenedPlace(Front& front, Elements& elements, PocketSet& pockets, PocketSet::Number pocket,
              std::vector<TetId> removed);

  /// All that bounded it when it had been opened, in the order of their ids.
  [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }
  [[nodiscard]] std::size_t removedElements() const { return removed_.size(); }
  /// All active faces of the place as it is now, in the order of their ids.
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
    PocketSet::Number pocket;
  };

  std::vector<TetId> removed_;
  std::vector<FaceId> faces_;
  std::vector<PocketSet::Number> touched_;  ///< pockets that are part of the place
  std::vector<Before> before_;              ///< their faces
  Box box_{};
};

}  // namespace tetrafront
