#pragma once

/// @file Which elements stand at a node? A flat list of lists (Löhner & Parikh 1988, second
/// section 6, structure (3)), built once in O(n).

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tetrafront {

class Incidence {
 public:
  Incidence() = default;

  /// `corners`: `perElement` nodes for each element, all below `nodeCount`.
  Incidence(std::span<const std::uint32_t> corners, std::size_t perElement, std::size_t nodeCount)
      : starts_(nodeCount + 2, 0), elements_(corners.size()) {
    // Counted two places ahead, so that filling moves each start to where its list begins.
    for (const std::uint32_t node : corners) ++starts_[node + 2];
    for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      elements_[starts_[corners[i] + 1]++] = static_cast<std::uint32_t>(i / perElement);
    }
  }

  /// Elements at `node`, in rising order; none for nodes added later.
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t node) const {
    if (node + std::size_t{2} >= starts_.size()) return {};
    return std::span(elements_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
  }

 private:
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> elements_;
};

}  // namespace tetrafront
