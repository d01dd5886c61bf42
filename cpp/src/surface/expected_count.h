#pragma once

/// @file How large will the mesh be? Asked before the front starts.

#include "field/size_field.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// The number of tetrahedra that the field asks for: the mean of 1/h^3 over a lattice of samples
/// in the boundary's box, times the enclosed volume; h^3 is the size tensor's determinant. The
/// surface must be closed, oriented and not empty.
[[nodiscard]] double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field);

}  // namespace tetrafront
