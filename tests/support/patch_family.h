#pragma once

/// @file A family of random patches for measuring: tapered, twisted, bent by up to 180 degrees,
/// with lines of all types and, where the patch type takes them, holes.

#include <array>
#include <cstdint>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"

namespace tetrafront::testing {

struct FamilyMember {
  Model model;        ///< one patch that passes diagnoseModel()
  double size = 0.0;  ///< wanted; about 8 to 40 elements go across
};

/// Member number `seed` of the family of one patch type.
FamilyMember patchOfFamily(PatchType type, std::uint64_t seed);

/// How good a patch's mesh is, apart from triangles whose angles the boundary decides.
struct PatchQuality {
  bool closed = false;      ///< one triangle at each boundary side, two at every other edge
  double minAngle = 180.0;  ///< degrees, of the triangles the boundary leaves free
  double minAngleOfAll = 180.0;
  std::size_t forced = 0;        ///< triangles the boundary decides
  double meanRadiusRatio = 0.0;  ///< of the same; 2 x inradius / circumradius
  double meanEdge = 0.0;         ///< over the wanted size
  double shortEdge = 0.0;        ///< 2.5 % of the edges are shorter, relative to the wanted size
  double longEdge = 0.0;         ///< 2.5 % are longer
};

/// The boundary decides a triangle's angles where it touches a corner at which the patch's sides
/// meet at less than 40 degrees (halved, that is less than 20), and where three nodes of the
/// boundary are joined across a neck: a boundary side, and a node of the boundary nearer to it than
/// half the wanted size.
PatchQuality measureQuality(const SurfaceMesh& mesh, double size);

}  // namespace tetrafront::testing
