#pragma once

/// @file What the tests accept as a mesh of a surface. Written for clarity, with its own exact
/// arithmetic and ordinary containers, so that it shares no mistake with the engine's verifier.

#include <string>

#include "tetrafront/mesh.h"

namespace tetrafront::testing {

/// Empty if the mesh is accepted, else the first thing that is wrong with it. Accepted means:
/// numbers finite and indices in range; every tetrahedron of positive volume, exactly; every face
/// of one tetrahedron, or of two on opposite sides of it; the faces of one tetrahedron only are
/// the surface's triangles, turned as they are, and its walls are faces of two; volumes equal within
/// 1e-10; no two used nodes at one position; no tetrahedron twice; surface nodes first and unmoved. Where
/// the surface knows its regions, volumes are those of each region, regions meet at walls only, and
/// each triangle has the regions on its sides that it names.
[[nodiscard]] std::string complaintAbout(const VolumeMesh& mesh, const SurfaceMesh& surface);

}  // namespace tetrafront::testing
