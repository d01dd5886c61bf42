#pragma once

/// @file The improvement of one edge or one element: the changes that are tried, in their order.

#include "adapt/adapt_operations.h"
#include "adapt/edge_list.h"
#include "adapt/node_mover.h"

namespace tetrafront {

/// Edges of this cost or more are out of bounds.
inline constexpr double kOutOfBounds = 0.5;

class LocalImprovement {
 public:
  /// The mesh and what the context names must outlive this.
  explicit LocalImprovement(const AdaptContext& context)
      : mesh_(context.mesh), badness_(context.badness), operations_(context), mover_(context) {}

  [[nodiscard]] AdaptOperations& operations() { return operations_; }
  [[nodiscard]] AdaptRandom& random() { return random_; }

  /// While set, no node is moved and none is added: the metrics of the nodes stay those that are given.
  void setStaysInPlace(bool staysInPlace) { staysInPlace_ = staysInPlace; }
  [[nodiscard]] bool staysInPlace() const { return staysInPlace_; }

  bool move(NodeId node, MoveEffort effort) { return mover_.move(node, effort, random_); }
  /// Tries to remove, divide or collapse an edge that is out of bounds; returns whether the mesh has changed.
  bool improveEdge(const AdaptEdge& edge);
  /// Tries to change an element until the badness falls; returns whether it did.
  bool improveElement(TetId id);
  /// Returns whether anything around the element changed since it was last tried.
  [[nodiscard]] bool isWorthTrying(const AdaptElement& element) const;

 private:
  AdaptMesh& mesh_;
  const Badness& badness_;
  AdaptOperations operations_;
  NodeMover mover_;
  AdaptRandom random_;
  bool staysInPlace_ = false;
};

}  // namespace tetrafront
