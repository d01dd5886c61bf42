#pragma once

/// @file Target sizes in a patch's plane (Löhner & Parikh 1988, section 5.2, T1-T3). Let J be the derivative of
/// the surface with respect to the plane's coordinates, and M the target metric in space. A step d of the plane
/// then has the length sqrt(d . G d) in space, in target sizes, with G = J^T M J. The front works in G. T2 and
/// T3 are therefore exact, however much the plane differs from the patch.

#include "field/size_field.h"
#include "model/patch_surface.h"

namespace tetrafront {

/// A symmetric positive definite 2 x 2 matrix.
struct Metric2 {
  double xx = 1.0;
  double xy = 0.0;
  double yy = 1.0;

  [[nodiscard]] Vec2 apply(const Vec2& d) const {
    return {xx * d.x + xy * d.y, xy * d.x + yy * d.y};
  }
  [[nodiscard]] double dot(const Vec2& a, const Vec2& b) const { return glm::dot(a, apply(b)); }
  [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
};

/// The surface and the target size at a position of the plane.
struct PlaneSample {
  Vec3 position{0.0};
  Metric2 metric;
  double size = 1.0;  ///< target edge length in space
};

/// Returns G for the tangents of `point` and a size without direction. If the tangents are nearly parallel, as at
/// a corner at which two lines of a Coons patch join smoothly, G is kept from becoming singular.
[[nodiscard]] Metric2 planeMetric(const SurfacePoint& point, double size);

/// Space as the size field stretches it near a position. `toUnit` maps the target triangle to an equilateral one
/// with edges of length 1, and `toSpace` is its inverse. If sizes do not depend on the direction, nothing is
/// mapped, and the target edge length is the size.
struct LocalSpace {
  bool isStretched = false;
  double targetLength = 1.0;  ///< of an edge, after mapping
  SymmetricTensor toUnit;
  SymmetricTensor toSpace;

  [[nodiscard]] Vec3 unit(const Vec3& v) const { return isStretched ? toUnit * v : v; }
  [[nodiscard]] Vec3 space(const Vec3& v) const { return isStretched ? toSpace * v : v; }
};

class PatchMetric {
 public:
  /// Both must outlive this.
  PatchMetric(const PatchSurface& surface, const SizeField& field)
      : surface_(&surface), field_(&field) {}

  [[nodiscard]] PlaneSample sample(const Vec2& plane, FieldHint& hint) const;

  /// Returns the local space at `position`. `size` is the size there if the field is not stretched.
  [[nodiscard]] LocalSpace spaceAt(const Vec3& position, double size, FieldHint& hint) const;
  [[nodiscard]] const PatchSurface& surface() const { return *surface_; }

 private:
  const PatchSurface* surface_;
  const SizeField* field_;
};

}  // namespace tetrafront
