#pragma once

/// @file Fingerprints of meshes, stored in tests/fingerprints/bodies.txt, so that no change of a mesh goes unnoticed.
/// `npm run fingerprints` replaces them.

#include <cstdint>
#include <string>

#include "tetrafront/mesh.h"

namespace tetrafront::testing {

/// Expects the stored fingerprint of the mesh of a body. Bodies are made with sines of the C library, which differ in the last
/// bit between some machines: if this body is not the stored one, but has as many nodes and triangles, its mesh is not
/// compared. `name`: without spaces, of this body alone.
void expectStoredFingerprint(const std::string& name, const SurfaceMesh& body, std::uint64_t mesh);

}  // namespace tetrafront::testing
