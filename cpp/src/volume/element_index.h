#pragma once

/// @file Which elements stand at a node, while elements are still made: those there when the index was
/// built in flat lists, later ones in chains.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "search/incidence.h"
#include "volume/elements.h"

namespace tetrafront {

class ElementIndex {
 public:
  explicit ElementIndex(const Elements& elements) : elements_(elements) {}

  /// Begins to build it anew, for the elements there are now.
  void begin(std::size_t nodeCount);
  /// Works on for `budget` times 100 elements; returns what it took, at least 1.
  std::size_t build(std::size_t budget);
  [[nodiscard]] bool isBuilt() const { return stage_ == Stage::kBuilt; }

  /// To be called before elements from `count` on are dropped.
  void forgetFrom(std::size_t count);

  /// The elements within so many rings of elements around the nodes, in rising order, without removed
  /// ones; no ring is begun once there are `enough`. `nodes` ascending, without repeats.
  [[nodiscard]] std::vector<TetId> around(std::vector<NodeId> nodes, std::uint32_t rings,
                                          std::size_t enough);

 private:
  enum class Stage : std::uint8_t { kCount, kAdd, kBuilt };
  using LinkId = Id<struct LinkTag>;

  void chainNew();
  template <class Take>
  void forEachAt(NodeId node, const Take& take) const;

  const Elements& elements_;
  Incidence lists_;
  Stage stage_ = Stage::kBuilt;
  std::size_t listed_ = 0;         ///< elements in the lists
  std::size_t next_ = 0;           ///< to be counted or added
  std::vector<LinkId> firstLink_;  ///< per node: the last link of its chain, or none
  std::vector<LinkId> links_;  ///< four per chained element: the previous link of the node's chain
};

}  // namespace tetrafront
