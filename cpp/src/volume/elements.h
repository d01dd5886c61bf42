#pragma once

/// @file The elements made so far, in the order in which they were made.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.h"
#include "volume/front.h"

namespace tetrafront {

/// Elements or nodes [first, last) made by one step of recovery.
struct IndexRange {
  std::size_t first = 0;
  std::size_t last = 0;
};

struct Elements {
  std::vector<NodeQuad> nodes;
  std::vector<std::uint32_t> regions;
  /// Per element: 1 if recovery has removed it. Removed elements are left out of the final mesh.
  std::vector<std::uint8_t> removed;
  std::uint32_t removedCount = 0;

  [[nodiscard]] std::size_t size() const { return nodes.size(); }
  [[nodiscard]] std::size_t liveCount() const { return nodes.size() - removedCount; }

  void add(const NodeQuad& quad, std::uint32_t region) {
    nodes.push_back(quad);
    regions.push_back(region);
    removed.push_back(0);
  }
  void remove(TetId element) {
    removed[element.index()] = 1;
    ++removedCount;
  }
  void restore(TetId element) {
    removed[element.index()] = 0;
    --removedCount;
  }
  /// Drops the elements from `count` on; none of them may be removed ones.
  void dropFrom(std::size_t count) {
    nodes.resize(count);
    regions.resize(count);
    removed.resize(count);
  }
};

}  // namespace tetrafront
