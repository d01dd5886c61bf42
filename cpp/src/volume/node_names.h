#pragma once

/// @file Names of the nodes of one region in the mesh of all regions.

#include <cstdint>
#include <span>

#include "base/ids.h"

namespace tetrafront {

/// By default, all nodes keep their names.
struct NodeNames {
  std::span<const std::uint32_t> ofBoundary;  ///< per node of the region's boundary
  std::uint32_t firstNew = 0;                 ///< name of the first node inside the region

  [[nodiscard]] std::uint32_t of(NodeId node) const {
    if (ofBoundary.empty()) return node.value;
    if (node.index() < ofBoundary.size()) return ofBoundary[node.index()];
    return firstNew + static_cast<std::uint32_t>(node.index() - ofBoundary.size());
  }
};

}  // namespace tetrafront
