#pragma once

/// @file Disjoint sets of numbers, with and without a relation to their root.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tetrafront {

/// Union-find over 0 .. count-1; the lowest member represents its set. find() and join() take O(log
/// n) amortized time.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  [[nodiscard]] std::uint32_t find(std::uint32_t x) {
    while (parent_[x] != x) {
      parent_[x] = parent_[parent_[x]];
      x = parent_[x];
    }
    return x;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  /// Returns per member the number of its set. Sets are numbered from 0 in the order of their
  /// lowest members.
  [[nodiscard]] std::vector<std::uint32_t> numbers() {
    std::vector<std::uint32_t> number(parent_.size());
    std::uint32_t count = 0;
    for (std::uint32_t x = 0; x < number.size(); ++x) {
      const std::uint32_t root = find(x);
      number[x] = root == x ? count++ : number[root];
    }
    return number;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Disjoint sets in which each member is either equal or opposite to the root of its set.
class OpposedSets {
 public:
  explicit OpposedSets(std::size_t count) : parent_(count), isOpposite_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }

  struct Root {
    std::uint32_t member;
    std::uint8_t isOpposite;
  };
  [[nodiscard]] Root find(std::uint32_t x) {
    std::uint8_t opposite = 0;
    while (parent_[x] != x) {
      const std::uint32_t parent = parent_[x];
      const std::uint8_t toParent = isOpposite_[x];
      opposite ^= toParent;
      // Path halving: skip the parent unless it is the root.
      isOpposite_[x] = toParent ^ (parent_[parent] == parent ? 0 : isOpposite_[parent]);
      parent_[x] = parent_[parent];
      x = parent;
    }
    return {x, opposite};
  }

  /// Records the relation of a and b. Returns false, without a change, if it contradicts a known
  /// one.
  bool join(std::uint32_t a, std::uint32_t b, bool areOpposite) {
    const Root ra = find(a);
    const Root rb = find(b);
    const auto opposite =
        static_cast<std::uint8_t>(ra.isOpposite ^ rb.isOpposite ^ (areOpposite ? 1 : 0));
    if (ra.member == rb.member) return opposite == 0;
    const auto [low, high] = std::minmax(ra.member, rb.member);
    parent_[high] = low;
    isOpposite_[high] = opposite;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> isOpposite_;
};

}  // namespace tetrafront
