#include "curved/edge_middles.h"

namespace tetrafront {

MiddleNode& EdgeMiddles::at(NodeId a, NodeId b) {
  const EdgeEnds ends = edgeBetween(a, b);
  const std::uint32_t known = slots_[slotOf(ends)];
  if (known != kNoIndex) return entries_[known];
  if (2 * (entries_.size() + 1) > slots_.size()) grow();
  slots_[slotOf(ends)] = static_cast<std::uint32_t>(entries_.size());
  hasEdge_[a.index()] = 1;
  hasEdge_[b.index()] = 1;
  return entries_.emplace_back(MiddleNode{.ends = ends});
}

std::size_t EdgeMiddles::slotOf(const EdgeEnds& ends) const {
  const std::size_t mask = slots_.size() - 1;
  std::uint32_t hash = ends.low.value * 0x9e3779b1U ^ ends.high.value * 0x85ebca6bU;
  hash ^= hash >> 15U;
  std::size_t slot = hash & mask;
  while (slots_[slot] != kNoIndex && entries_[slots_[slot]].ends != ends) slot = (slot + 1) & mask;
  return slot;
}

void EdgeMiddles::grow() {
  slots_.assign(2 * slots_.size(), kNoIndex);
  for (std::size_t entry = 0; entry < entries_.size(); ++entry) {
    slots_[slotOf(entries_[entry].ends)] = static_cast<std::uint32_t>(entry);
  }
}

}  // namespace tetrafront
