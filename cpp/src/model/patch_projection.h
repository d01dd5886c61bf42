#pragma once

/// @file Finds the parameters of a position on a curved patch: the inverse of T1 (Löhner & Parikh
/// 1988, section 5.2). Holes in curved patches are bounded by ordinary lines in space that lie on
/// the patch; this maps their nodes to its plane.

#include <vector>

#include "model/patch_surface.h"

namespace tetrafront {

class PatchProjection {
 public:
  /// `surface` must be curved and must outlive this. O(1): evaluates some hundred positions.
  explicit PatchProjection(const PatchSurface& surface);

  /// Parameters of the position on the patch closest to a target in space, found by Newton's
  /// method from the closest of a lattice of samples. Exact up to rounding if the distance is
  /// smaller than the patch's radii of curvature.
  struct Foot {
    Vec2 plane{0.0};
    double distance = 0.0;  ///< from the target to the patch
  };
  [[nodiscard]] Foot project(const Vec3& target) const;

 private:
  struct Sample {
    Vec2 plane;
    Vec3 position;
  };
  [[nodiscard]] Vec2 step(const Vec2& from, const Vec3& target) const;

  const PatchSurface* surface_;
  std::vector<Sample> samples_;
  double extent_ = 0.0;
};

/// Returns whether the patch has holes that need the projection; PatchSurface::boundaryToPlane maps
/// those of planar patches.
[[nodiscard]] inline bool hasCurvedHoles(const Patch& patch) {
  return patch.type != PatchType::kPlanar && patch.type != PatchType::kTube &&
         patch.loops.size() > 1;
}

}  // namespace tetrafront
