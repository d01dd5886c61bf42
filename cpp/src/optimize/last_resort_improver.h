#pragma once

/// @file Last-resort changes for elements that ElementImprover cannot improve. Like it, this class
/// tries changes that may get worse before they get better, but anywhere near the element, and all
/// surrounding nodes settle together. Each try takes milliseconds.

#include <array>
#include <cstddef>
#include <vector>

#include "optimize/density.h"
#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/element_improver.h"
#include "optimize/node_moves.h"
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

  /// Starts with an element. The changes to try are removals and splits, at any cost, of each inner
  /// edge of the elements that share a node with it, and collapses of each of their free nodes. A
  /// change is not tried again while none of those elements has changed.
  void begin(TetId tet);

  /// Tries one change. Keeps it only if it leaves no more poor elements than before and the sum of
  /// the fourth powers of their costs falls. Returns false if there is nothing more to try, or if
  /// the element is gone or meets its targets (cost at most 1). `cost` must use a dihedral measure.
  bool tryOne(const ElementCost<Space>& cost);

  /// Returns whether the element is gone or meets its targets.
  [[nodiscard]] bool hasImproved() const;

  /// Sets how many changes may still be tried, for all elements together.
  void allow(std::size_t tries) { tries_ = tries; }

 private:
  struct NearEdge {
    double distance;  ///< squared, from the element's centroid to the edge's midpoint
    NodeId a;
    NodeId b;
  };
  /// Progress of an element that was left without success.
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
  Corners nodes_{};  ///< nodes of the element when it was started
  std::size_t next_ =
      0;  ///< next change: all nodes together, edges removed and split, nodes collapsed
  Star star_;
  std::vector<TetId> near_;
  std::vector<NodeId> freeNodes_;  ///< of near_
  std::vector<NearEdge> edges_;    ///< edges of near_, nearest first
  std::vector<Tried> tried_;       ///< the most recently tried element last
  std::size_t tries_ = 0;
};

}  // namespace tetrafront
