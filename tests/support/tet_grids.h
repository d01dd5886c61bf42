#pragma once

/// @file Ready-made tetrahedral meshes for tests, and the surface of one.

#include <cstdint>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"

namespace tetrafront::testing {

/// [0,1]^3 in n^3 cubes of six tetrahedra each (Kuhn's division). Nodes of the surface come
/// first; inner nodes are moved at random by up to `jitter` of a cube's edge, at most 0.15.
VolumeMesh cubeOfTetrahedra(int n, double jitter = 0.0, std::uint64_t seed = 1);

/// The faces of one tetrahedron only, outward. Its nodes are the first `nodeCount` of the mesh.
SurfaceMesh surfaceOf(const VolumeMesh& mesh, std::size_t nodeCount);

/// How many nodes of cubeOfTetrahedra(n) are on its surface.
std::size_t surfaceNodeCount(int n);

/// The mesh as a background grid, all sizes 1.
BackgroundGrid gridOf(const VolumeMesh& mesh);

}  // namespace tetrafront::testing
