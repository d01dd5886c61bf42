#pragma once

/// @file How large will the mesh be? Asked before the front starts.

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/mesher.h"

namespace tetrafront {

/// So many regular tetrahedra of edge 1 have the unit volume: 6 sqrt 2.
inline constexpr double kTetrahedraPerUnitVolume = 8.485281374238571;

/// The number of tetrahedra that the field asks for: the mean of 1/h^3 over samples of the inside,
/// times the enclosed volume; h^3 is the size tensor's determinant. The surface must be closed,
/// oriented and not empty. O(triangles).
[[nodiscard]] double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field);

/// As many as the field asks for in so much volume, with the mean over samples of what the surface
/// encloses, which must be closed and is best oriented, or that is the mean over its triangles.
[[nodiscard]] double tetrahedraWithin(double volume, const SurfaceMesh& surface,
                                      const SizeField& field);

/// An estimate as it is told to the user: above 10^15, or where it overflowed, that.
[[nodiscard]] inline double counted(double expected) {
  constexpr double kBeyondCounting = 1e15;
  return expected < kBeyondCounting ? expected : kBeyondCounting;
}

/// The signed volume within a surface, walls apart; positive if that is turned outward.
[[nodiscard]] double enclosedVolume(const SurfaceMesh& surface);

/// How many tetrahedra the field asks for per unit of volume, as the mean over samples in a box.
[[nodiscard]] double tetrahedraPerVolume(const Vec3& low, const Vec3& high, const SizeField& field);

}  // namespace tetrafront
