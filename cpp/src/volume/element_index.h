#pragma once

/// @file Finds the elements at a node while elements are being made. Elements that existed when the
/// index was built are in flat lists, later ones in chains. Elements join the chains at the next
/// query. They may be dropped again before it, as a failed attempt does; after it, they can only be
/// removed.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "topology/node_lists.h"
#include "volume/elements.h"

namespace tetrafront {

class ElementIndex {
 public:
  explicit ElementIndex(const Elements& elements) : elements_(elements) {}

  /// Starts to rebuild the index for the elements that exist now.
  void begin(std::size_t nodeCount);
  /// Adds about `budget` x 100 elements to the index; returns the budget it used, at least 1.
  std::size_t build(std::size_t budget);
  [[nodiscard]] bool isBuilt() const { return next_ == 2 * listed_; }

  /// Returns the elements within `rings` rings of elements around the nodes, ascending, without
  /// removed ones. Stops before a ring if it already has `enough` elements. `nodes` must be
  /// ascending and unique.
  [[nodiscard]] std::vector<TetId> around(std::vector<NodeId> nodes, std::uint32_t rings,
                                          std::size_t enough);

 private:
  using LinkId = Id<struct LinkTag>;

  void chainNew();
  template <class Take>
  void forEachAt(NodeId node, const Take& take) const;

  const Elements& elements_;
  NodeLists<TetId> lists_;
  std::size_t listed_ = 0;         ///< number of elements in the lists
  std::size_t next_ = 0;           ///< elements counted and added
  std::vector<LinkId> firstLink_;  ///< per node: the last link of its chain, or none
  std::vector<LinkId> links_;  ///< four per chained element: the previous link of the node's chain
};

}  // namespace tetrafront
