#pragma once

/// @file Too few nodes or too many: splitting long edges and collapsing short ones. Density follows
/// the cost; the size field only sets the limits of edge lengths.

#include <array>
#include <cstdint>
#include <vector>

#include "optimize/edge_removal.h"
#include "optimize/element_cost.h"
#include "optimize/node_moves.h"
#include "optimize/tet_complex.h"

namespace tetrafront {

/// Edge length divided by the mean of what is wanted at its ends.
template <class Space = PlainSpace>
[[nodiscard]] double relativeLength(const TetComplex& complex, NodeId a, NodeId b) {
  return Space::relativeLength(complex.place(a) - complex.place(b), complex.wanted<Space>(a),
                               complex.wanted<Space>(b));
}

template <class Space = PlainSpace>
class EdgeSplitter {
 public:
  explicit EdgeSplitter(TetComplex& complex) : complex_(complex) {}

  /// The inner edges longer than the limit among elements [first, last) changed since `since`,
  /// added to the list. Each edge is met once.
  void collect(std::size_t first, std::size_t last, std::uint32_t since);
  /// Sorts the list, longest first.
  void sortCollected();
  /// Splits edges [next, next + count) of the list where no element of the ring gets worse than
  /// its worst was, or bearable where the edge is much too long. Returns the number of splits.
  /// `cost` must be by the bulk measure.
  std::size_t splitSome(std::size_t next, std::size_t count, const ElementCost<Space>& cost);
  [[nodiscard]] std::size_t collected() const { return edges_.size(); }
  void clear() { edges_.clear(); }

  /// From so many wanted lengths on, edges are split even where that makes elements worse, up to some
  /// cost; 1.5 unless told otherwise.
  void splitAllAbove(double length) { muchTooLong_ = length; }

  /// Splits one edge by a new node at its middle, at whatever cost. The new node, or none.
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
  [[nodiscard]] typename Space::Wanted wantedAtMiddle(const EdgeRing& ring) const {
    return Space::meanOf(complex_.wanted<Space>(ring.from), complex_.wanted<Space>(ring.to));
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

  /// The free nodes among [first, last) whose star changed since `since`, with their mean relative
  /// edge length.
  void collect(std::size_t first, std::size_t last, std::uint32_t since);
  void sortCollected();
  std::size_t collapseSome(std::size_t next, std::size_t count, const ElementCost<Space>& cost);
  [[nodiscard]] std::size_t collected() const { return nodes_.size(); }
  void clear() { nodes_.clear(); }

  /// In wanted lengths, what collapseSome() makes no edge longer than; 1.8 unless told otherwise.
  void allowEdgesUpTo(double length) { maxEdge_ = length; }

  /// Collapses a free node onto its best neighbour if the combined cost of its elements falls by
  /// `minGain` (relative) and no new edge is longer than `maxLength` wanted sizes, or the node's
  /// longest; in hopeless places new edges may be of any length.
  bool collapse(NodeId node, const ElementCost<Space>& cost, double maxLength, double minGain);
  /// The same at whatever cost, onto the neighbour where that is least.
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
