#pragma once

/// @file A grid of cubic cells that answers which of the nodes added so far lie near a node.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/task.h"

namespace tetrafront {

/// Nodes by the cell they lie in; if the edge of the cells is 0, by their position. Nodes are added in ascending
/// order.
class NodeGrid {
 public:
  /// `points`: finite coordinates x y z of all nodes; they must outlive this object. `cellEdge`: a positive edge must
  /// be large enough for all cell coordinates to be exact integers.
  NodeGrid(std::span<const double> points, double cellEdge);

  /// Reserves a slot for every node. Call once, before add(). O(n log n).
  Task<> reserveSlots(Work& work);

  void add(NodeId node);

  /// Returns the lowest added node below `node` with `accepts(added)` among those in the cells around that of `node`,
  /// or `node` if there is none.
  template <class Accepts>
  [[nodiscard]] NodeId lowestNear(NodeId node, const Accepts& accepts) const;

 private:
  using Cell = std::array<double, 3>;
  /// The added nodes of a cell: a range of nodes_.
  struct Bucket {
    std::uint32_t begin;
    std::uint32_t end;
  };

  [[nodiscard]] Cell cellAt(NodeId node) const;
  /// Returns the index of the cell in cells_, or the size of cells_ if the cell holds no node.
  [[nodiscard]] std::size_t indexOf(const Cell& cell) const;

  std::span<const double> points_;
  double cellEdge_;
  std::vector<Cell> cells_;      ///< that hold nodes, ascending
  std::vector<Bucket> buckets_;  ///< per cell
  std::vector<NodeId> slots_;    ///< grouped by cell
};

template <class Accepts>
NodeId NodeGrid::lowestNear(NodeId node, const Accepts& accepts) const {
  NodeId lowest = node;
  const int reach = cellEdge_ > 0.0 ? 1 : 0;
  const Cell own = cellAt(node);
  for (int x = -reach; x <= reach; ++x) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const std::size_t cell = indexOf({own[0] + x, own[1] + y, own[2] + z});
        if (cell == cells_.size()) continue;
        for (std::uint32_t i = buckets_[cell].begin; i < buckets_[cell].end; ++i) {
          if (slots_[i] >= lowest) break;
          if (accepts(slots_[i])) lowest = slots_[i];
        }
      }
    }
  }
  return lowest;
}

}  // namespace tetrafront
