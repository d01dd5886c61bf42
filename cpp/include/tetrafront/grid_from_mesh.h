#pragma once

/// @file A background grid from a generated mesh, for adaptive remeshing (Löhner & Parikh 1988, section 3).

#include <cstdint>
#include <span>
#include <vector>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"
#include "tetrafront/sliced_tool.h"

namespace tetrafront {

/// Returns a generated mesh as a background grid (section 3). `sizes` holds one target size per node of the mesh. If
/// it is empty, the sizes follow from the mean edge length at each node, so that the grid asks for about as many
/// elements as the mesh has. Leaves out nodes without an element. An incomplete mesh covers only what it fills.
/// O(n) for n elements.
[[nodiscard]] BackgroundGrid gridFromMesh(const VolumeMesh& mesh, std::span<const double> sizes);

/// Does the work of gridFromMesh() in slices; a unit of work is an element or node.
class MeshGridBuilder : public SlicedTool<BackgroundGrid> {
 public:
  MeshGridBuilder(VolumeMesh mesh, std::vector<double> sizes);
};

}  // namespace tetrafront
