#pragma once

/// @file The rims of a surface's holes.

#include <cstdint>
#include <vector>

#include "boundary/edge_table.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// A closed chain of different nodes, in the direction of the half-edge it was begun with.
using Rim = std::vector<std::uint32_t>;

/// All closed chains of edges with one triangle, by their first edges; a hole that touches itself or another
/// in a node has more than one. Chains that end at crowded edges are left out. `edges`: of `mesh`. O(n).
[[nodiscard]] std::vector<Rim> openRims(const SurfaceMesh& mesh, const EdgeTable& edges);

}  // namespace tetrafront
