#pragma once

/// @file Estimates of the number of elements, before the front starts.

#include <span>

#include "field/size_field.h"
#include "tetrafront/mesh.h"

namespace tetrafront {

/// Number of regular tetrahedra with edges of length 1 per unit of volume: 6 sqrt 2.
inline constexpr double kTetrahedraPerUnitVolume = 8.485281374238571;

/// Returns the estimated number of tetrahedra: the enclosed volume times the mean of 1/h^3 over samples of the interior,
/// where h^3 is the determinant of the size tensor. The surface must be closed, oriented and not empty. O(triangles).
[[nodiscard]] double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field);

/// The same for a surface that will have this number of triangles.
[[nodiscard]] double expectedTetrahedra(const SurfaceMesh& surface, const SizeField& field,
                                        double triangles);

/// Returns the estimated number of tetrahedra in `volume`, with the mean over samples of the surface's interior. The
/// surface must be closed. If it is not oriented, the mean over its triangles is used.
[[nodiscard]] double tetrahedraWithin(double volume, const SurfaceMesh& surface,
                                      const SizeField& field);

/// Returns the number of tetrahedra without which some would exceed `maxVolume` or the largest volume of their region, 0
/// for no limit. The surface must be closed and oriented. O(triangles).
[[nodiscard]] double minTetrahedra(const SurfaceMesh& surface, double maxVolume,
                                   std::span<const double> ofRegions);

/// Returns the signed volume that a surface encloses, without interfaces; positive if it is oriented outward.
[[nodiscard]] double enclosedVolume(const SurfaceMesh& surface);

/// Returns the estimated number of tetrahedra per unit of volume, as the mean over samples in a box.
[[nodiscard]] double tetrahedraPerVolume(const Vec3& low, const Vec3& high, const SizeField& field);

}  // namespace tetrafront
