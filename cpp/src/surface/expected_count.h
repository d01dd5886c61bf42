#pragma once

/// @file How large will the mesh be? Asked before the front starts.

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"

namespace tetrafront {

/// So many regular tetrahedra of edge 1 have the unit volume: 6 sqrt 2.
inline constexpr double kTetrahedraPerUnitVolume = 8.485281374238571;

/// The number of tetrahedra that the field asks for: the mean of 1/h^3 over a lattice of samples
/// in the boundary's box, times the enclosed volume; h^3 is the size tensor's determinant. The
/// surface must be closed, oriented and not empty.
[[nodiscard]] double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field);

/// The number that would fill the whole box of the model's points, which must be some: all that
/// can be said before there is a surface.
[[nodiscard]] double tetrahedraInBoxOf(const Model& model, const SizeField& field);

}  // namespace tetrafront
