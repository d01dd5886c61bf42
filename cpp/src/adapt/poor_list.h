#pragma once

/// @file The poor elements of the mesh that an adaptation changes.

#include <cstdint>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "base/task.h"

namespace tetrafront {

struct PoorElement {
  double quality;
  TetId element;
  std::uint32_t unused = 0;
};

/// Lists the elements below a quality, the poorest first. The mesh must not change meanwhile.
Task<std::vector<PoorElement>> listPoor(Work& work, const AdaptMesh& mesh, double limit);

}  // namespace tetrafront
