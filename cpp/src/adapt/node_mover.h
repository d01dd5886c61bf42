#pragma once

/// @file Moves nodes towards unit edges and regular elements, under the badness of the elements and edges around them.

#include <vector>

#include "adapt/adapt_operations.h"

namespace tetrafront {

/// How much a move tries.
enum class MoveEffort : std::uint8_t {
  kTargets,  ///< the two targets only
  kSearch,   ///< a few random steps besides where the surroundings are bad
  kLong,     ///< more random steps everywhere
};

class NodeMover {
 public:
  explicit NodeMover(const AdaptContext& context) : context_(context) {}

  /// Moves a node if that lowers the badness around it; returns whether it did.
  bool move(NodeId node, MoveEffort effort, AdaptRandom& random);

 private:
  void collect(NodeId node);
  [[nodiscard]] double badnessAround(NodeId node, double limit);
  [[nodiscard]] double tiltCost() const;
  bool attempt(const Vec3& position);
  void approach(const Vec3& target);
  [[nodiscard]] Vec3 unitEdgeTarget() const;
  [[nodiscard]] Vec3 regularTarget() const;
  void search(MoveEffort effort, AdaptRandom& random);

  AdaptContext context_;
  NodeId node_;
  AdaptNode given_;  ///< before the move
  AdaptNode best_;
  double least_ = 0.0;
  std::vector<TetId> ball_;
  std::vector<NodeId> neighbours_;
  std::vector<double> qualities_;
  std::vector<double> bestQualities_;
  Marks seen_;
};

}  // namespace tetrafront
