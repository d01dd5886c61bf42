#pragma once

/// @file Typed access to the arrays of a BackgroundGrid.

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

inline std::array<Vec3, 4> cornersOf(const BackgroundGrid& grid, GridTetId tet) {
  const auto [a, b, c, d] = nodesOf(grid, tet);
  return {positionOf(grid, a), positionOf(grid, b), positionOf(grid, c), positionOf(grid, d)};
}

}  // namespace tetrafront
