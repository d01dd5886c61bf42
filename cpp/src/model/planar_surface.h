#pragma once

/// @file The plane of a planar patch (Löhner & Parikh 1988, appendix, eq. 8-10).

#include "model/surface_point.h"

namespace tetrafront {

/// An orthonormal frame in the plane of a planar patch, eq. (8).
class PlanarSurface {
 public:
  /// `normal` of any length, `firstDirection` not along it.
  PlanarSurface(const Vec3& origin, const Vec3& normal, const Vec3& firstDirection);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;  ///< eq. (9)
  [[nodiscard]] Vec2 project(const Vec3& position) const;        ///< eq. (10)
  [[nodiscard]] double distance(const Vec3& position) const;     ///< signed, from the plane

 private:
  Vec3 origin_;
  Vec3 first_;
  Vec3 second_;
  Vec3 normal_;
};

}  // namespace tetrafront
