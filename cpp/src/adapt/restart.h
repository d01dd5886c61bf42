#pragma once

/// @file An adaptation that begins with the background mesh, where that fills the same body: a mesh that is nearly adapted
/// stays nearly as it is, and nodes that stay have exactly the metrics that were given for them.

#include <cstdint>
#include <vector>

#include "adapt/adapt_mesh.h"
#include "adapt/adapt_start.h"
#include "adapt/boundary_guide.h"
#include "base/task.h"
#include "tetrafront/mesh_adaptation.h"

namespace tetrafront {

/// A mesh to begin with.
struct RestartMesh {
  bool fits = false;  ///< false if the background mesh does not fill the body: nothing else is set
  GivenMesh given;
  StartFaces faces;
  BoundaryPlaces places;
};

/// Finds the background mesh on the boundary of the guide. It fits if each of its boundary faces lies on one patch, each node
/// where patches meet on a line between them, and a node at each fixed one. O(n log n).
Task<RestartMesh> findRestart(Work& work, const MetricMesh& background, const BoundaryGuide& guide);

}  // namespace tetrafront
