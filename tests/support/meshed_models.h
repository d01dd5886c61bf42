#pragma once

/// @file Surface meshes of trimmed models, and the triangles of a CAD kernel near them.

#include "tetrafront/mesh.h"
#include "tetrafront/node_placement.h"
#include "tetrafront/trimmed_model.h"

namespace tetrafront::testing {

/// Meshes the faces with one size; expects success. A patch is a face.
SurfaceMesh meshOfModel(const TrimmedModel& model, double size);

/// Triangles with a node per corner. The parameters of a centroid are found by a search over the whole face, and those of
/// corners beside them, so that no triangle extends over a period.
ModelTriangles modelTriangles(const TrimmedModel& model, double size);

}  // namespace tetrafront::testing
