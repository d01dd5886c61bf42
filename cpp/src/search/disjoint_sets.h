#pragma once

/// @file Disjoint sets of numbers, with and without a relation to their root.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tetrafront {

/// Union-find over 0 .. count-1; the least member stands for its set. find() and join() take O(log n), on
/// average over many.
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

  /// The number of its set for each member; sets count from 0 in order of their least members.
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

/// As DisjointSets, where each member is either like its root or opposite to it.
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
      // Path halving: skip the parent, unless that is the root already.
      isOpposite_[x] = toParent ^ (parent_[parent] == parent ? 0 : isOpposite_[parent]);
      parent_[x] = parent_[parent];
      x = parent;
    }
    return {x, opposite};
  }

  /// Says how a and b are related; false, and nothing changed, if they are known to be otherwise.
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
