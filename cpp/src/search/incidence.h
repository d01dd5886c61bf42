#pragma once

/// @file Which elements stand at a node? A flat list of lists (Löhner & Parikh 1988, second
/// section 6, structure (3)), built in two rounds over all corners, each of which may be taken in
/// slices: O(corners) in all. What has its nodes in common is found in the list of the lowest.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrafront {

/// `Entry`: what stands in the lists.
template <class Entry>
class NodeLists {
 public:
  NodeLists() = default;
  explicit NodeLists(std::size_t nodeCount) : starts_(nodeCount + 2, 0) {}

  /// First round: once per corner.
  void count(std::uint32_t node) {
    // Two places ahead, so that the second round moves each start to where its list begins.
    ++starts_[node + std::size_t{2}];
  }
  void endCounting() {
    for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    elements_.resize(starts_.back());
  }
  /// Second round: the same corners again.
  void add(std::uint32_t node, const Entry& element) {
    elements_[starts_[node + std::size_t{1}]++] = element;
  }

  /// What stands at `node`, in the order of the second round; nothing for nodes added later.
  [[nodiscard]] std::span<const Entry> at(std::uint32_t node) const {
    if (node + std::size_t{2} >= starts_.size()) return {};
    return std::span(elements_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
  }
  [[nodiscard]] std::span<Entry> at(std::uint32_t node) {
    if (node + std::size_t{2} >= starts_.size()) return {};
    return std::span(elements_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
  }

 private:
  std::vector<std::uint32_t> starts_;
  std::vector<Entry> elements_;
};

/// Elements by number, in rising order.
using Incidence = NodeLists<std::uint32_t>;

}  // namespace tetrafront
