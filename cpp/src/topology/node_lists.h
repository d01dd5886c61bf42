#pragma once

/// @file Lists the elements at each node in one flat array (Löhner & Parikh 1988, second section 6,
/// structure (3)). Built in two passes over all corners, which may be done in slices; O(n) for n
/// corners. An entry with several nodes, such as a face, is listed at the lowest of them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.h"

namespace tetrafront {

/// `Entry`: type of the listed entries; `Node`: type of the nodes' ids.
template <class Entry, class Node = NodeId>
class NodeLists {
 public:
  NodeLists() = default;
  explicit NodeLists(std::size_t nodeCount) : starts_(nodeCount + 2, 0) {}

  /// First pass: once per corner.
  void count(Node node) {
    // Two entries ahead, so that the second pass moves each start to the beginning of its list.
    ++starts_[node.index() + 2];
  }
  void endCounting() {
    for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    elements_.resize(starts_.back());
  }
  /// Second pass: the same corners again.
  void add(Node node, const Entry& element) { elements_[starts_[node.index() + 1]++] = element; }

  /// Returns the entries at `node`, in the order of the second pass; none for nodes added later.
  [[nodiscard]] std::span<const Entry> at(Node node) const {
    if (node.index() + 2 >= starts_.size()) return {};
    return std::span(elements_).subspan(beginOf(node), countAt(node));
  }
  [[nodiscard]] std::span<Entry> at(Node node) {
    if (node.index() + 2 >= starts_.size()) return {};
    return std::span(elements_).subspan(beginOf(node), countAt(node));
  }

 private:
  [[nodiscard]] std::size_t beginOf(Node node) const { return starts_[node.index()]; }
  [[nodiscard]] std::size_t countAt(Node node) const {
    return starts_[node.index() + 1] - starts_[node.index()];
  }

  std::vector<std::uint32_t> starts_;
  std::vector<Entry> elements_;
};

}  // namespace tetrafront
