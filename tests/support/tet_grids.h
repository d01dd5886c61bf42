#pragma once

/// @file Simple tetrahedral meshes for tests, and the surface of a mesh.

#include <cstdint>

#include "tetrafront/background_grid.h"
#include "tetrafront/mesh.h"

namespace tetrafront::testing {

/// The cube [0,1]^3, divided into n^3 cubes of six tetrahedra each (Kuhn's division). Nodes of the
/// surface come first. Interior nodes are moved randomly by up to `jitter` (at most 0.15) times the
/// edge of a cube.
VolumeMesh cubeOfTetrahedra(int n, double jitter = 0.0, std::uint64_t seed = 1);

/// Returns the faces that only one tetrahedron has, facing outward. The nodes of the surface are
/// the first `nodeCount` nodes of the mesh.
SurfaceMesh surfaceOf(const VolumeMesh& mesh, std::size_t nodeCount);

/// Returns the number of surface nodes of cubeOfTetrahedra(n).
std::size_t surfaceNodeCount(int n);

/// Returns the mesh as a background grid of size 1.
BackgroundGrid gridOf(const VolumeMesh& mesh);

}  // namespace tetrafront::testing
