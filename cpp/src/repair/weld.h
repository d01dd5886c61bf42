#pragma once

/// @file Nodes that are near enough to be one.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tetrafront {

/// Finds the nodes to weld, in slices.
class NodeWelder {
 public:
  /// Nodes x y z, finite, which must outlive this; `distance` >= 0, where 0 welds those at one place.
  NodeWelder(std::span<const double> points, double distance);
  NodeWelder(NodeWelder&&) noexcept;
  NodeWelder& operator=(NodeWelder&&) noexcept;
  ~NodeWelder();

  /// Works on for about `budget` nodes; true when finished. O(n log n) in all: few nodes that stay
  /// are near each other.
  bool advance(std::uint32_t budget);

  /// Per node: the one it becomes, itself or one of a lower number no further than the distance away
  /// that stays what it is. Taken in ascending order, the lowest such node is chosen: chains do not
  /// collapse into one node.
  [[nodiscard]] const std::vector<std::uint32_t>& targets() const { return targets_; }

 private:
  class NodeGrid;

  [[nodiscard]] std::uint32_t targetOf(std::uint32_t node) const;

  std::span<const double> points_;
  double distance_;
  std::unique_ptr<NodeGrid> grid_;
  std::vector<std::uint32_t> targets_;
};

}  // namespace tetrafront
