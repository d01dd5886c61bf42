#pragma once

/// @file Gives one pocket to the exact fill and puts the result into the mesh.

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
  /// For `limit`, see ExactFill.
  PocketFill(const Front& front, Pocket pocket, unsigned order, std::uint64_t limit);

  ExactFill::State advance(std::uint32_t budget) { return fill_.advance(budget); }

  /// Estimated progress, 0 to 1.
  [[nodiscard]] double fraction() const { return fill_.fraction(); }

  /// See ExactFill::cost().
  [[nodiscard]] std::uint64_t cost() const { return fill_.cost(); }

  /// Call it in state kDone or kPartial. Adds the elements and removes the pocket's faces from the
  /// front. Returns the faces that bound the volume left open, ascending.
  std::vector<FaceId> apply(Front& front, Elements& elements) const;

 private:
  static FillTask taskFor(const Front& front, const Pocket& pocket, std::vector<NodeId>& nodes);

  Pocket pocket_;
  std::vector<NodeId> nodes_;  ///< per node of the fill task: its node of the front
  ExactFill fill_;
};

}  // namespace tetrafront
