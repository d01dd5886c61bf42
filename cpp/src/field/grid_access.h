#pragma once

/// @file Typed access to the arrays of a BackgroundGrid.

#include <algorithm>
#include <array>

#include "base/ids.h"
#include "tetrafront/background_grid.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

inline GridNodeQuad nodesOf(const BackgroundGrid& grid, GridTetId tet) {
  const auto& [a, b, c, d] = grid.tetrahedra[tet.index()];
  return {GridNodeId(a), GridNodeId(b), GridNodeId(c), GridNodeId(d)};
}

inline const BackgroundNode& nodeOf(const BackgroundGrid& grid, GridNodeId node) {
  return grid.nodes[node.index()];
}

inline BackgroundNode& nodeOf(BackgroundGrid& grid, GridNodeId node) {
  return grid.nodes[node.index()];
}

inline const Vec3& positionOf(const BackgroundGrid& grid, GridNodeId node) {
  return nodeOf(grid, node).position;
}

/// Returns the second stretching of a node, which is 1 if the grid has none.
inline SecondStretching secondOf(const BackgroundGrid& grid, GridNodeId node) {
  return grid.secondStretchings.empty() ? SecondStretching{} : grid.secondStretchings[node.index()];
}

/// Returns the largest of all sizes in all directions; 0 for an empty grid.
inline double largestSizeOf(const BackgroundGrid& grid) {
  double largest = 0.0;
  for (const GridNodeId id : IdRange<GridNodeId>(grid.nodes.size())) {
    const BackgroundNode& node = nodeOf(grid, id);
    largest = std::max(largest,
                       node.size * std::max({1.0, node.stretching, secondOf(grid, id).stretching}));
  }
  return largest;
}

inline std::array<Vec3, 4> cornersOf(const BackgroundGrid& grid, GridTetId tet) {
  const auto [a, b, c, d] = nodesOf(grid, tet);
  return {positionOf(grid, a), positionOf(grid, b), positionOf(grid, c), positionOf(grid, d)};
}

}  // namespace tetrafront
