#pragma once

/// @file The last rung of recovery: a pocket goes to the exact fill, and what comes back into the mesh.

#include <cstdint>
#include <memory>
#include <vector>

#include "fill/exact_fill.h"
#include "volume/elements.h"
#include "volume/front.h"
#include "volume/pockets.h"

namespace tetrafront {

class PocketFill {
 public:
  /// `limit`: see ExactFill.
  PocketFill(const Front& front, Pocket pocket, unsigned order, std::uint64_t limit);

  ExactFill::State advance(std::uint32_t budget) { return fill_.advance(budget); }

  /// How far it is, 0 to 1, estimated.
  [[nodiscard]] double fraction() const { return fill_.fraction(); }

  /// Once done, in part or all: puts the elements in, takes the pocket's faces out of the front. Returns
  /// the faces that bound what is left open.
  std::vector<FaceId> apply(Front& front, Elements& elements) const;

 private:
  static FillTask taskFor(const Front& front, const Pocket& pocket, std::vector<NodeId>& nodes);

  Pocket pocket_;
  std::vector<NodeId> nodes_;  ///< of the front, as the fill numbers them
  ExactFill fill_;
};

}  // namespace tetrafront
