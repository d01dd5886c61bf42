#pragma once

/// @file Where on a curved patch a place in space is: the inverse of T1 (Löhner & Parikh 1988,
/// section 5.2). Holes of curved patches are bounded by ordinary lines of space that lie on the
/// patch; their nodes are found in its plane this way.

#include <vector>

#include "model/patch_surface.h"

namespace tetrafront {

class PatchProjection {
 public:
  /// `surface` must be curved, and outlive this. O(1), some hundred places evaluated.
  explicit PatchProjection(const PatchSurface& surface);

  /// The place of the patch nearest to one in space, as far as Newton's method finds it from the
  /// nearest of a lattice of samples: at places nearer to the patch than its radii of curvature, to
  /// rounding.
  struct Foot {
    Vec2 plane{0.0};
    double distance = 0.0;  ///< from the place to the patch
  };
  [[nodiscard]] Foot project(const Vec3& place) const;

 private:
  struct Sample {
    Vec2 plane;
    Vec3 position;
  };
  [[nodiscard]] Vec2 step(const Vec2& from, const Vec3& place) const;

  const PatchSurface* surface_;
  std::vector<Sample> samples_;
  double extent_ = 0.0;
};

/// True if the patch has holes that only the projection lays out in its plane; those of planar
/// patches are by PatchSurface::boundaryToPlane.
[[nodiscard]] inline bool hasCurvedHoles(const Patch& patch) {
  return patch.type != PatchType::kPlanar && patch.loops.size() > 1;
}

}  // namespace tetrafront
