#pragma once

/// @file The last elements, for which repair.h has found nothing: as there, a change that may get
/// worse before it gets better is tried, but any change near the element, not only at itself or at
/// its neighbours, and all nodes around settle together. Takes milliseconds for each try.

#include <array>
#include <cstddef>
#include <vector>

#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/node_moves.h"
#include "optimize/element_improver.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

template <class Space = PlainSpace>
class LastResortImprover {
 public:
  LastResortImprover(TetComplex& complex, EdgeRemoval<Space>& removal,
                     EdgeSplitter<Space>& splitter, NodeCollapser<Space>& collapser,
                     NodeMover<Space>& mover, ElementImprover<Space>& improver)
      : complex_(complex),
        removal_(removal),
        splitter_(splitter),
        collapser_(collapser),
        mover_(mover),
        improver_(improver) {}

  /// Turns to an element: removals and splits, at whatever cost, of each inner edge among the elements
  /// that share a node with it, and collapses of each of their free nodes are what there is to try.
  /// What has been tried before is not tried again while none of those elements has changed.
  void begin(TetId tet);

  /// Tries one change, which is kept only if it leaves no more bad elements than it found, and the
  /// sum of the fourth powers of their costs falls. False when there is nothing more to try, or no
  /// more need to: the element is gone or good enough (cost at most 1). `cost` must be a dihedral one.
  bool tryOne(const ElementCost<Space>& cost);

  /// Whether the element is gone or good enough.
  [[nodiscard]] bool hasImproved() const;

  /// How many changes may yet be tried, for all elements together.
  void allow(std::size_t tries) { tries_ = tries; }

 private:
  struct NearEdge {
    double distance;  ///< squared, from the element's centroid to the edge's middle
    NodeId a;
    NodeId b;
  };
  /// How far an element's turn had come when it ended without success.
  struct Tried {
    Corners nodes;
    std::uint32_t pass;
    std::size_t next;
  };
  void gather();
  [[nodiscard]] std::size_t triedBefore() const;
  [[nodiscard]] TetId elementAt(const NearEdge& edge) const;
  bool changeEdge(const NearEdge& edge, bool split, const ElementCost<Space>& cost);
  void settle(const ElementCost<Space>& cost);
  void moveAll(const std::vector<NodeId>& nodes, const ElementCost<Space>& cost);
  template <class Change>
  bool attempt(const ElementCost<Space>& cost, Change change);

  TetComplex& complex_;
  EdgeRemoval<Space>& removal_;
  EdgeSplitter<Space>& splitter_;
  NodeCollapser<Space>& collapser_;
  NodeMover<Space>& mover_;
  ElementImprover<Space>& improver_;
  TetId tet_;
  Corners nodes_{};       ///< of the element when its turn came
  std::size_t next_ = 0;  ///< to try: all nodes together, edges removed and split, nodes collapsed
  Star star_;
  std::vector<TetId> near_;
  std::vector<NodeId> freeNodes_;  ///< of near_
  std::vector<NearEdge> edges_;    ///< of near_, nearest first
  std::vector<Tried> tried_;       ///< the last turn of an element last
  std::size_t tries_ = 0;
};

}  // namespace tetrafront
