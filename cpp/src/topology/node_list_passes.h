#pragma once

/// @file Lists of entries at each node (node_lists.h) that are too large to be kept at once: they are made for some nodes at a time, in
/// passes over the items that have the entries. Memory is then limited, and a node still sees its entries in their order.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"

namespace tetrafront {

/// Items per chunk: those of a chunk are visited together, or left out of a pass together.
inline constexpr std::size_t kListedChunk = 64;
/// Largest number of entries that are kept, unless that takes too many passes.
inline constexpr std::size_t kMaxListed = std::size_t{1} << 24U;

template <class Entry>
class NodeListPasses {
 public:
  /// `itemCount`: number of items, for example elements, that have entries.
  NodeListPasses(std::size_t nodeCount, std::size_t itemCount, std::size_t maxEntries = kMaxListed)
      : counts_(nodeCount, 0), maxEntries_(maxEntries), itemCount_(itemCount) {}

  /// First, once per entry.
  void count(NodeId node) { ++counts_[node.index()]; }
  void endCounting();

  /// Begins the next pass; false if there is none. Then call add() for all items of the chunks() of the pass.
  bool beginPass();
  [[nodiscard]] std::size_t passCount() const { return ends_.size(); }
  [[nodiscard]] const std::vector<std::uint32_t>& chunks() const { return chunks_; }
  /// The items [first, last) of a chunk.
  [[nodiscard]] std::size_t firstOf(std::uint32_t chunk) const { return kListedChunk * chunk; }
  [[nodiscard]] std::size_t lastOf(std::uint32_t chunk) const {
    return std::min(firstOf(chunk) + kListedChunk, itemCount_);
  }
  /// Adds an entry of an item of the chunk. Those at nodes of other passes are left out.
  void add(std::uint32_t chunk, NodeId node, const Entry& entry) {
    if (node.index() < first_ || node.index() >= last_) {
      if (pass_ == 0) passesOf_[chunk] |= std::uint64_t{1} << passAt(node);
      return;
    }
    entries_[starts_[node.index() - first_ + 1]++] = entry;
  }

  /// Nodes of the pass: [firstNode(), firstNode() + nodeCount()).
  [[nodiscard]] std::size_t firstNode() const { return first_; }
  [[nodiscard]] std::size_t nodeCount() const { return last_ - first_; }
  /// Returns the entries at a node of the pass, in the order of add().
  [[nodiscard]] std::span<Entry> at(NodeId node) {
    const std::size_t i = node.index() - first_;
    return std::span(entries_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }

 private:
  /// Chunks are marked by bits.
  static constexpr std::size_t kMaxPasses = 64;

  [[nodiscard]] std::size_t passAt(NodeId node) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(ends_, node.index()) - ends_.begin());
  }

  std::vector<std::uint32_t> counts_;  ///< per node
  std::size_t maxEntries_;
  std::size_t itemCount_;
  std::vector<std::size_t> ends_;        ///< behind the last node of each pass
  std::vector<std::uint64_t> passesOf_;  ///< per chunk: the passes in which it has entries
  std::vector<std::uint32_t> chunks_;    ///< of this pass
  std::size_t pass_ = kMaxPasses;        ///< before the first one
  std::size_t first_ = 0;
  std::size_t last_ = 0;
  std::vector<std::uint32_t> starts_;  ///< of the nodes of this pass, as in NodeLists
  std::vector<Entry> entries_;
};

template <class Entry>
void NodeListPasses<Entry>::endCounting() {
  std::size_t total = 0;
  for (const std::uint32_t count : counts_) total += count;
  // Two passes in a row have more entries than the limit, so there are fewer than 64.
  const std::size_t limit = std::max(maxEntries_, total / (kMaxPasses / 2 - 1) + 1);
  std::size_t inPass = 0;
  for (std::size_t node = 0; node < counts_.size(); ++node) {
    if (inPass > 0 && inPass + counts_[node] > limit) {
      ends_.push_back(node);
      inPass = 0;
    }
    inPass += counts_[node];
  }
  ends_.push_back(counts_.size());
  passesOf_.assign((itemCount_ + kListedChunk - 1) / kListedChunk, 0);
}

template <class Entry>
bool NodeListPasses<Entry>::beginPass() {
  pass_ = pass_ == kMaxPasses ? 0 : pass_ + 1;
  if (pass_ == ends_.size()) return false;
  first_ = last_;
  last_ = ends_[pass_];
  starts_.assign(last_ - first_ + 2, 0);
  for (std::size_t node = first_; node < last_; ++node) {
    // Two entries ahead, so that add() moves each start to the beginning of its list.
    const std::size_t i = node - first_ + 2;
    starts_[i] = starts_[i - 1] + counts_[node];
  }
  entries_.resize(starts_.back());
  chunks_.clear();
  for (std::size_t chunk = 0; chunk < passesOf_.size(); ++chunk) {
    const bool isVisited = pass_ == 0 || (passesOf_[chunk] >> pass_ & 1U) != 0;
    if (isVisited) chunks_.push_back(static_cast<std::uint32_t>(chunk));
  }
  return true;
}

}  // namespace tetrafront
