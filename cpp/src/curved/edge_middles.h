#pragma once

/// @file The middle nodes of edges: a hash table of the edges whose middles are known. All others are straight and free.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// An edge by its nodes, the lower one first.
struct EdgeEnds {
  NodeId low;
  NodeId high;
  friend constexpr auto operator<=>(const EdgeEnds&, const EdgeEnds&) = default;
};

constexpr EdgeEnds edgeBetween(NodeId a, NodeId b) {
  return a < b ? EdgeEnds{a, b} : EdgeEnds{b, a};
}

/// What is known of the middle of an edge.
struct MiddleNode {
  EdgeEnds ends;
  Vec3 position{0.0};           ///< without meaning if the edge is straight
  bool isStraight = false;      ///< halfway between the ends, wherever these are
  bool isFixed = false;         ///< on the boundary, or straight for good
  bool isStraightened = false;  ///< it was given a middle, which made an element invalid
};

class EdgeMiddles {
 public:
  explicit EdgeMiddles(std::size_t nodes) : hasEdge_(nodes, 0), slots_(kFirstSlots, kNoIndex) {}

  /// Returns the entry of an edge, or null. Entries move when one is added.
  [[nodiscard]] MiddleNode* find(NodeId a, NodeId b) {
    if (hasEdge_[a.index()] == 0 || hasEdge_[b.index()] == 0) return nullptr;
    const std::uint32_t entry = slots_[slotOf(edgeBetween(a, b))];
    return entry == kNoIndex ? nullptr : &entries_[entry];
  }
  [[nodiscard]] const MiddleNode* find(NodeId a, NodeId b) const {
    return const_cast<EdgeMiddles*>(this)->find(a, b);
  }
  /// Returns the entry of an edge, a new one if there is none.
  MiddleNode& at(NodeId a, NodeId b);

  /// False if no edge at the node has an entry.
  [[nodiscard]] bool touches(NodeId node) const { return hasEdge_[node.index()] != 0; }
  /// In the order in which they were added.
  [[nodiscard]] std::span<const MiddleNode> entries() const { return entries_; }

 private:
  static constexpr std::size_t kFirstSlots = 64;

  [[nodiscard]] std::size_t slotOf(const EdgeEnds& ends) const;
  void grow();

  std::vector<std::uint8_t> hasEdge_;
  std::vector<MiddleNode> entries_;
  std::vector<std::uint32_t> slots_;  ///< index in entries_; a power of two, at most half full
};

}  // namespace tetrafront
