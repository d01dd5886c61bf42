#pragma once

/// @file Coordinates about the centre of a surface that is far from the origin. Distances, normals and planes computed there
/// lose no digits to the distance, and boxes of single precision do not all overlap.

#include <vector>

#include "tetrafront/mesh.h"
#include "tetrafront/vec3.h"

namespace tetrafront {

/// Moves the nodes of a surface that is far from the origin, and returns the position that is the new origin; moves nothing
/// and returns 0 for another one. Every node stays exact: the centre added to it gives the same number again.
Vec3 moveToCentre(SurfaceMesh& mesh);

/// Adds an offset to the points, three numbers each.
void shift(std::vector<double>& points, const Vec3& by);

/// Keeps a surface about its centre while it is alive.
class CentredSurface {
 public:
  explicit CentredSurface(SurfaceMesh& mesh) : mesh_(mesh), centre_(moveToCentre(mesh)) {}
  CentredSurface(const CentredSurface&) = delete;
  CentredSurface& operator=(const CentredSurface&) = delete;
  ~CentredSurface() { shift(mesh_.points, centre_); }

  [[nodiscard]] const Vec3& centre() const { return centre_; }

 private:
  SurfaceMesh& mesh_;
  Vec3 centre_;
};

}  // namespace tetrafront
