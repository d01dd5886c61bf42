#pragma once

/// @file A family of random patches for measuring mesh quality. They are tapered, twisted, bent by
/// up to 180 degrees, and have lines of all types and, if the patch type permits, holes.

#include <array>
#include <cstdint>

#include "field/size_field.h"
#include "tetrafront/mesh.h"
#include "tetrafront/model.h"

namespace tetrafront::testing {

struct FamilyMember {
  Model model;        ///< one patch that passes diagnoseModel()
  double size = 0.0;  ///< target size; about 8 to 40 elements fit across the patch
};

/// Member number `seed` of the family of one patch type.
FamilyMember patchOfFamily(PatchType type, std::uint64_t seed);

/// Quality of a patch's mesh, without the triangles whose angles the boundary determines (see
/// measureQuality()).
struct PatchQuality {
  bool closed = false;      ///< one triangle at each boundary side, two at every other edge
  double minAngle = 180.0;  ///< degrees, without the triangles that the boundary determines
  double minAngleOfAll = 180.0;
  std::size_t forced = 0;        ///< triangles that the boundary determines
  double meanRadiusRatio = 0.0;  ///< of the others; 2 x inradius / circumradius
  double meanEdge = 0.0;         ///< mean edge length / target size
  double shortEdge = 0.0;        ///< 2.5 % of the edges are shorter; relative to the target size
  double longEdge = 0.0;         ///< 2.5 % of the edges are longer; relative to the target size
};

/// Measures the quality of a patch's mesh. The boundary determines the angles of two kinds of
/// triangles: those at a corner where the sides of the patch meet at less than 40 degrees (less
/// than 20 if divided between two triangles); and those across a neck, which consist of a boundary
/// side and a boundary node closer to it than half the target size.
PatchQuality measureQuality(const SurfaceMesh& mesh, double size);

}  // namespace tetrafront::testing
