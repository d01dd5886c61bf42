#pragma once

/// @file A patch as a surface over its plane (xi'', eta''): T1 of Löhner & Parikh 1988, section
/// 5.2, and the mappings of its appendix. The plane of a planar patch is the patch's own plane (eq.
/// 8-10). For other types it is the unit triangle or square, stretched and sheared to resemble the
/// patch (eq. 16, 17).

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "model/face_plane.h"
#include "model/planar_surface.h"
#include "model/resolved_model.h"
#include "model/stretched_plane.h"
#include "model/unit_surface.h"

namespace tetrafront {

/// A curved patch: its surface over the unit triangle or square, and its stretched domain.
class MappedSurface {
 public:
  /// Arguments as for UnitSurface.
  MappedSurface(PatchType type, std::span<const OrientedCurve> loop,
                std::span<const OrientedCurve> sections = {});
  explicit MappedSurface(TubeSurface tube);

  [[nodiscard]] const UnitSurface& unitSurface() const { return surface_; }
  /// Returns the position in the plane of a point of a tube in the strip that follows crease `strip`: strips between
  /// creases are drawn apart, so that each has its own nodes on both sides. Without creases there is one strip.
  [[nodiscard]] Vec2 stripToPlane(const Vec2& unit, std::size_t strip) const;
  [[nodiscard]] const StretchedPlane& stretchedPlane() const { return plane_; }
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;

  /// Returns the position in the domain closest to one that may be outside.
  [[nodiscard]] Vec2 clamped(const Vec2& plane) const;

 private:
  [[nodiscard]] Vec2 toUnit(const Vec2& plane) const;

  UnitSurface surface_;
  StretchedPlane plane_;
};

class PatchSurface {
 public:
  /// `patch` must be usable (checkModel()); `model` must outlive this.
  PatchSurface(const ResolvedModel& model, const Patch& patch);
  /// Makes the surface of a planar patch that lies in `plane`, with the axes of this plane.
  PatchSurface(const ResolvedModel& model, const Patch& patch, const PlanarSurface& plane);
  /// Makes the surface of a trimmed face: neither planar() nor mapped(), and without lines of a drawn model.
  explicit PatchSurface(const FacePlane& face) : surface_(face) {}

  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;

  /// Maps a node of a loop's line to the plane: line `index` of its loop, parameter t in
  /// the loop's direction, and its position in space. For a curved patch, only the first loop;
  /// PatchProjection maps the nodes of holes. Not for tubes.
  [[nodiscard]] Vec2 boundaryToPlane(std::size_t index, double t, const Vec3& position) const;

  /// True if line `index` of the loop is straight in the plane.
  [[nodiscard]] bool straightInPlane(std::size_t loop, std::size_t index) const;

  /// Returns the closest position at which the surface can be evaluated: the lines of a curved
  /// patch are undefined beyond their ends. A plane is unbounded.
  [[nodiscard]] Vec2 clamped(const Vec2& plane) const;

  [[nodiscard]] const PlanarSurface* planar() const {
    return std::get_if<PlanarSurface>(&surface_);
  }
  /// The curved patch, or null for a planar one.
  [[nodiscard]] const MappedSurface* mapped() const {
    return std::get_if<MappedSurface>(&surface_);
  }

 private:
  using Surface = std::variant<PlanarSurface, MappedSurface, FacePlane>;
  static Surface makeSurface(const ResolvedModel& model, const Patch& patch);
  void findFlatAxes();

  const ResolvedModel* model_ = nullptr;
  const Patch* patch_ = nullptr;
  Surface surface_;
  FlatAxes flat_;
};

/// Returns the surface of a tube, which must have two closed loops.
[[nodiscard]] TubeSurface tubeSurface(const ResolvedModel& model, const Patch& patch);

/// Returns the surface of a usable patch that is neither planar nor a tube.
[[nodiscard]] UnitSurface unitSurface(const ResolvedModel& model, const Patch& patch);

/// Returns the curves of a loop in its direction.
[[nodiscard]] std::vector<OrientedCurve> curvesOf(const ResolvedModel& model, const Loop& loop);

/// The plane of a closed chain of lines: its area-weighted normal (Newell's sum over samples of the
/// curves; its length is the enclosed area). Zero if the loop encloses no area.
struct LoopPlane {
  Vec3 origin{0.0};          ///< mean of the samples
  Vec3 areaVector{0.0};      ///< normal times area, right-handed with respect to the loop
  Vec3 firstDirection{0.0};  ///< chord from the loop's first sample to the farthest one
};
[[nodiscard]] LoopPlane loopPlane(const ResolvedModel& model, const Loop& loop);

/// Samples a loop: `samplesPerLine` points per curved line, one per straight line. Each line's end
/// is the next line's first sample.
[[nodiscard]] std::vector<Vec3> sampleLoop(const ResolvedModel& model, const Loop& loop,
                                           std::uint32_t samplesPerLine);

/// Diagonal of the bounding box of such samples of some loops: tolerances are relative to it.
[[nodiscard]] double loopExtent(const ResolvedModel& model, std::span<const Loop> loops,
                                std::uint32_t samplesPerLine);

/// Returns the loops that define a patch's surface: the outer loop, or the two rims of a tube.
[[nodiscard]] inline std::span<const Loop> spanningLoops(const Patch& patch) {
  return std::span(patch.loops).first(patch.type == PatchType::kTube ? 2 : 1);
}

}  // namespace tetrafront
