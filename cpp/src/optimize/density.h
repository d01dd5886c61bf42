#pragma once

/// @file Corrects the node density: splits long edges and collapses free nodes. The element costs
/// decide where; the size field only limits the edge lengths.

#include <array>
#include <cstdint>
#include <vector>

#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/node_moves.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

/// Edge length divided by the mean target length at its ends.
template <class Space = PlainSpace>
[[nodiscard]] double relativeLength(const TetComplex& complex, NodeId a, NodeId b) {
  return Space::relativeLength(complex.position(a) - complex.position(b), complex.target<Space>(a),
                               complex.target<Space>(b));
}

template <class Space = PlainSpace>
class EdgeSplitter {
 public:
  explicit EdgeSplitter(TetComplex& complex) : complex_(complex) {}

  /// Appends the inner edges longer than the limit, of those elements in [first, last) that changed
  /// since `since`. Each edge is visited once.
  void collect(std::size_t first, std::size_t last, std::uint32_t since);
  /// Sorts the list by length, longest first.
  void sortCollected();
  /// Splits edges [next, next + count) of the list if no element of the ring becomes worse than its
  /// worst element was; much too long edges may also make it acceptable only. Returns the number of
  /// splits. `cost` must use the bulk measure.
  std::size_t splitSome(std::size_t next, std::size_t count, const ElementCost<Space>& cost);
  [[nodiscard]] std::size_t collected() const { return edges_.size(); }
  void clear() { edges_.clear(); }

  /// From this multiple of the target length on, edges are split even if that makes elements worse,
  /// up to a limit on their cost. Default 1.5.
  void splitAllAbove(double length) { muchTooLong_ = length; }

  /// Splits one edge by a new node at its midpoint, at any cost. Returns the new node, or none if
  /// that is impossible.
  NodeId force(const EdgeRing& ring, const ElementCost<Space>& cost);

 private:
  struct LongEdge {
    double length;
    NodeId a;
    NodeId b;
    TetId tet;
  };
  bool split(const EdgeRing& ring, const ElementCost<Space>& cost);
  bool makeHalves(const EdgeRing& ring, const ElementCost<Space>& cost, NodeId middle);
  [[nodiscard]] typename Space::Target targetAtMiddle(const EdgeRing& ring) const {
    return Space::meanOf(complex_.target<Space>(ring.from), complex_.target<Space>(ring.to));
  }
  [[nodiscard]] Vec3 bestMiddle(const EdgeRing& ring, const ElementCost<Space>& cost);

  TetComplex& complex_;
  double muchTooLong_ = 1.5;
  std::vector<LongEdge> edges_;
  Hollow<Space> hollow_;
  std::array<NewElement, 2 * kMaxRing> fresh_;
};

template <class Space = PlainSpace>
class NodeCollapser {
 public:
  explicit NodeCollapser(TetComplex& complex) : complex_(complex) {}

  /// Appends the free nodes in [first, last) whose star changed since `since`, with their mean
  /// relative edge length.
  void collect(std::size_t first, std::size_t last, std::uint32_t since);
  void sortCollected();
  std::size_t collapseSome(std::size_t next, std::size_t count, const ElementCost<Space>& cost);
  [[nodiscard]] std::size_t collected() const { return nodes_.size(); }
  void clear() { nodes_.clear(); }

  /// Largest relative length of an edge that collapseSome() makes. Default 1.8.
  void allowEdgesUpTo(double length) { maxEdge_ = length; }

  /// Collapses a free node onto its best neighbour if the total cost of its elements falls by
  /// `minGain` (relative) and no new edge exceeds `maxLength` target lengths, or the node's longest
  /// edge. Where elements are already invalid, new edges may have any length.
  bool collapse(NodeId node, const ElementCost<Space>& cost, double maxLength, double minGain);
  /// Collapses a free node at any cost, onto the neighbour with the lowest cost.
  bool force(NodeId node, const ElementCost<Space>& cost, double maxLength);

 private:
  struct Crowded {
    double length;
    NodeId node;
  };
  [[nodiscard]] bool findStarOf(NodeId node);
  void findNeighbours(NodeId node);
  bool collapseBelow(double bound, NodeId node, const ElementCost<Space>& cost, double maxLength);
  double costOnto(NodeId target, const ElementCost<Space>& cost, const typename Space::Limit& limit,
                  double bound);

  TetComplex& complex_;
  double maxEdge_ = 1.8;
  std::vector<Crowded> nodes_;
  Star star_;
  std::vector<NodeId> neighbours_;
  std::vector<std::uint32_t> marks_;
  std::uint32_t mark_ = 0;
  std::array<NewElement, kMaxCavity> fresh_;
  std::size_t freshCount_ = 0;
};

}  // namespace tetrafront
