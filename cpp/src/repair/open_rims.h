#pragma once

/// @file The rims of the holes in a surface.

#include <vector>

#include "base/ids.h"
#include "tetrafront/mesh.h"
#include "topology/edge_table.h"

namespace tetrafront {

/// The nodes of a closed chain of open edges, each once, in the direction of the first half-edge.
using Rim = std::vector<NodeId>;

/// Returns all closed chains of open edges, in the order of their first edges. A hole that touches itself or another
/// hole in a node has several. Chains that end at non-manifold edges are left out. `edges`: edges of `mesh`.
/// O(n log n), usually O(n).
[[nodiscard]] std::vector<Rim> openRims(const SurfaceMesh& mesh, const EdgeTable& edges);

}  // namespace tetrafront
