#pragma once

/// @file A patch as a surface over its plane (xi'', eta''): T1 of Löhner & Parikh 1988, section
/// 5.2, and the mappings of its appendix. The plane of a planar patch is the patch's own plane
/// (eq. 8-10); that of a Coons patch is the stretched and sheared unit square (eq. 16, 17).

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "model/resolved_model.h"
#include "model/stretched_plane.h"

namespace tetrafront {

/// Position and the two tangents of a surface at a place of its parameter plane.
struct SurfacePoint {
  Vec3 position{0.0};
  Vec3 alongXi{0.0};   ///< derivative by the first coordinate
  Vec3 alongEta{0.0};  ///< derivative by the second
};

/// An orthonormal frame in the plane of a planar patch, eq. (8).
class PlanarSurface {
 public:
  PlanarSurface(const Vec3& origin, const Vec3& normal, const Vec3& firstDirection);
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;  ///< eq. (9)
  [[nodiscard]] Vec2 project(const Vec3& place) const;           ///< eq. (10)
  [[nodiscard]] double distance(const Vec3& place) const;        ///< signed, from the plane

 private:
  Vec3 origin_;
  Vec3 first_;
  Vec3 second_;
  Vec3 normal_;
};

/// The bilinear transfinite patch, eq. (15).
class CoonsSurface {
 public:
  /// F1 from A to B, F2 from B to C, F3 from D to C, F4 from A to D.
  explicit CoonsSurface(const std::array<OrientedCurve, 4>& lines);
  [[nodiscard]] SurfacePoint evaluateUnit(const Vec2& unit) const;  ///< over (xi, eta)
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;     ///< over (xi'', eta'')
  [[nodiscard]] const StretchedPlane& stretchedPlane() const { return plane_; }

 private:
  std::array<OrientedCurve, 4> lines_;
  StretchedPlane plane_;
};

class PatchSurface {
 public:
  /// `patch` must have passed checkModel(); `model` must outlive this.
  PatchSurface(const ResolvedModel& model, const Patch& patch);

  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;

  /// Where a node of a loop's line lies in the plane: line number `position` of its loop, at
  /// parameter t as the loop walks it, with its place in space.
  [[nodiscard]] Vec2 boundaryToPlane(std::size_t position, double t, const Vec3& place) const;

  /// True if the loop's line number `position` is a straight line in the plane.
  [[nodiscard]] bool straightInPlane(std::size_t loop, std::size_t position) const;

  [[nodiscard]] const PlanarSurface* planar() const {
    return std::get_if<PlanarSurface>(&surface_);
  }
  [[nodiscard]] const CoonsSurface* coons() const { return std::get_if<CoonsSurface>(&surface_); }

 private:
  using Surface = std::variant<PlanarSurface, CoonsSurface>;
  static Surface makeSurface(const ResolvedModel& model, const Patch& patch);

  const ResolvedModel* model_;
  const Patch* patch_;
  Surface surface_;
  FlatAxes flat_;
};

/// The plane of a closed chain of lines: its area-weighted normal (Newell's sum over samples of
/// the curves; length = enclosed area). Zero if the loop encloses nothing.
struct LoopPlane {
  Vec3 origin{0.0};          ///< mean of the samples
  Vec3 areaVector{0.0};      ///< normal times area, right-handed to the loop
  Vec3 firstDirection{0.0};  ///< chord from the loop's first sample to the farthest one
};
[[nodiscard]] LoopPlane loopPlane(const ResolvedModel& model, const Loop& loop);

/// Points along a loop, `samplesPerLine` per curved line, one per straight line; each line's end
/// is the next one's first sample.
[[nodiscard]] std::vector<Vec3> sampleLoop(const ResolvedModel& model, const Loop& loop,
                                           std::uint32_t samplesPerLine);

}  // namespace tetrafront
