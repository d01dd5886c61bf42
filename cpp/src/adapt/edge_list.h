#pragma once

/// @file The edges of the mesh that an adaptation changes.

#include <cstdint>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "base/task.h"

namespace tetrafront {

/// An edge in use and its length.
struct AdaptEdge {
  double length;
  NodeId a;
  NodeId b;
  TetId element;  ///< one that had it when the edges were listed
  std::uint32_t unused = 0;
};

/// Lists all edges, by their lower nodes. The mesh must not change meanwhile.
Task<std::vector<AdaptEdge>> listEdges(Work& work, const AdaptMesh& mesh);

}  // namespace tetrafront
