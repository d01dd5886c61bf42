#pragma once

/// @file A patch as a surface over its plane (xi'', eta''): T1 of Löhner & Parikh 1988, section
/// 5.2, and the mappings of its appendix. The plane of a planar patch is the patch's own plane
/// (eq. 8-10); that of any other is the unit triangle or square, stretched and sheared to resemble
/// the patch (eq. 16, 17).

#include <cstdint>
#include <variant>
#include <vector>

#include "model/planar_surface.h"
#include "model/resolved_model.h"
#include "model/stretched_plane.h"
#include "model/unit_surface.h"

namespace tetrafront {

/// A curved patch: its surface over the unit triangle or square, and that domain as stretched.
class MappedSurface {
 public:
  /// As for UnitSurface.
  MappedSurface(PatchType type, std::span<const OrientedCurve> loop);

  [[nodiscard]] const UnitSurface& unitSurface() const { return surface_; }
  [[nodiscard]] const StretchedPlane& stretchedPlane() const { return plane_; }
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;

  /// The place of the domain nearest to one that may be outside.
  [[nodiscard]] Vec2 clamped(const Vec2& plane) const;

 private:
  UnitSurface surface_;
  StretchedPlane plane_;
};

class PatchSurface {
 public:
  /// `patch` must have passed diagnoseModel(); `model` must outlive this.
  PatchSurface(const ResolvedModel& model, const Patch& patch);

  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;

  /// Where a node of a loop's line lies in the plane: line number `position` of its loop, at
  /// parameter t as the loop walks it, with its place in space. Of a curved patch, the first loop
  /// only; PatchProjection finds nodes of the others.
  [[nodiscard]] Vec2 boundaryToPlane(std::size_t position, double t, const Vec3& place) const;

  /// True if the loop's line number `position` is a straight line in the plane.
  [[nodiscard]] bool straightInPlane(std::size_t loop, std::size_t position) const;

  /// The place at which the surface is known, nearest to one that may be outside its domain: the
  /// lines of a curved patch go nowhere beyond their ends. A plane has no end.
  [[nodiscard]] Vec2 clamped(const Vec2& plane) const;

  [[nodiscard]] const PlanarSurface* planar() const {
    return std::get_if<PlanarSurface>(&surface_);
  }
  /// The curved patch; null for a planar one.
  [[nodiscard]] const MappedSurface* mapped() const {
    return std::get_if<MappedSurface>(&surface_);
  }

 private:
  using Surface = std::variant<PlanarSurface, MappedSurface>;
  static Surface makeSurface(const ResolvedModel& model, const Patch& patch);

  const ResolvedModel* model_;
  const Patch* patch_;
  Surface surface_;
  FlatAxes flat_;
};

/// The curves of a loop as it walks them.
[[nodiscard]] std::vector<OrientedCurve> curvesOf(const ResolvedModel& model, const Loop& loop);

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

/// The diagonal of the box of those points: the size that tolerances are relative to.
[[nodiscard]] double loopExtent(const ResolvedModel& model, const Loop& loop,
                                std::uint32_t samplesPerLine);

}  // namespace tetrafront
