#pragma once

/// @file Adds nodes and triangles to a surface, for the builders of test shapes.

#include <array>
#include <cstdint>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// Returns the index of the new node.
std::uint32_t addPoint(SurfaceMesh& mesh, const Vec3& p);

void addTriangle(SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// Adds the square of four nodes, which are counter-clockwise seen from outside.
void addSquare(SurfaceMesh& mesh, std::array<std::uint32_t, 4> n, bool otherDiagonal);

/// Merges nodes at the same position.
SurfaceMesh joined(const SurfaceMesh& mesh);

}  // namespace tetrafront::testing
