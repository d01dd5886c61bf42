#include "boundary/ray_crossing.h"

#include <array>
#include <limits>
#include <utility>

#include "geom/predicates.h"

namespace tetrafront {
namespace {

/// Drops one axis.
Vec2 projected(const Vec3& v, std::size_t axis) {
  return axis == 0 ? Vec2(v.y, v.z) : axis == 1 ? Vec2(v.z, v.x) : Vec2(v.x, v.y);
}

}  // namespace

Box boxOfRay(const Vec3& start) {
  Box ray = Box::of(start, start, start);
  ray.high[0] = std::numeric_limits<float>::max();
  return ray;
}

bool isAheadOf(const std::array<Vec3, 3>& corners, const Vec3& start) {
  const std::array<Vec3, 3>& p = corners;
  bool isInside = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3* low = &p[k];
    const Vec3* high = &p[(k + 1) % 3];
    if (low->z > high->z) std::swap(low, high);
    if (low->z > start.z || high->z <= start.z) continue;
    if (orient2d(projected(*low, 0), projected(*high, 0), projected(start, 0)) > 0) {
      isInside = !isInside;
    }
  }
  if (!isInside) return false;
  const int facing = orient2d(projected(p[0], 0), projected(p[1], 0), projected(p[2], 0));
  return orient3d(p[0], p[1], p[2], start) * facing < 0;
}

/// A coplanar position lies on the triangle if no projection shows it on different sides of two edges. In a projection
/// along the plane all signs are 0.
bool liesOn(const SurfaceMesh& mesh, const Vec3& position, TriangleId triangle) {
  const std::array<Vec3, 3> p = cornersOf(mesh, triangle);
  if (orient3d(p[0], p[1], p[2], position) != 0) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bool isLeft = false;
    bool isRight = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = orient2d(projected(p[k], axis), projected(p[(k + 1) % 3], axis),
                                projected(position, axis));
      isLeft = isLeft || side > 0;
      isRight = isRight || side < 0;
    }
    if (isLeft && isRight) return false;
  }
  return true;
}

}  // namespace tetrafront
