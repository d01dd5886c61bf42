#pragma once

/// @file Decides whether a mesh is a valid mesh of a surface. Written for clarity, with its own
/// exact arithmetic and standard containers, so that it shares no mistake with the engine's
/// verifier.

#include <string>

#include "tetrafront/mesh.h"

namespace tetrafront::testing {

/// Returns the first defect of the mesh as text, or an empty string if the mesh is valid. A valid
/// mesh has these properties. Coordinates are finite and indices are in range. Every tetrahedron
/// has positive volume, exactly, and none is listed twice. A face belongs to one tetrahedron, or to
/// two on opposite sides. The faces of one tetrahedron are the triangles of the surface, with the
/// same orientation; interfaces are faces of two. The volumes of mesh and surface agree within
/// 1e-10. No two used nodes have the same position. The first nodes are those of the surface, at
/// the same positions. If the surface has regions, the volume of each region agrees, regions touch
/// only at interfaces, and each triangle has the stated regions on its sides.
[[nodiscard]] std::string complaintAbout(const VolumeMesh& mesh, const SurfaceMesh& surface);

}  // namespace tetrafront::testing
