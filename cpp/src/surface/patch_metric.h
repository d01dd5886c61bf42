#pragma once

/// @file Sizes in a patch's plane (Löhner & Parikh 1988, section 5.2, T1-T3). With J the
/// derivative of the surface by the plane's coordinates and M the metric asked for in space, a
/// step d of the plane is as long in space, counted in wanted sizes, as sqrt(d . G d) with
/// G = J^T M J. The front works in G, so T2 and T3 are exact however unlike its patch a plane is.

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

/// Everything the front wants to know about a place of the plane.
struct PlaneSample {
  Vec3 position{0.0};
  Metric2 metric;
  double size = 1.0;  ///< wanted edge length in space
};

/// G for the tangents and size at a place. Where the tangents are nearly parallel, as at a corner
/// at which two lines of a Coons patch meet smoothly, G is kept from becoming singular.
[[nodiscard]] Metric2 planeMetric(const SurfacePoint& point, double size);

/// Where sizes depend on the direction: a linear map of space after which the triangle wanted at a
/// place is equilateral with side 1, and its inverse. Where they do not, nothing is mapped.
struct LocalSpace {
  bool isStretched = false;
  double wantedSide = 1.0;
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

  /// For shapes at `place`, where `size` is the size without direction.
  [[nodiscard]] LocalSpace spaceAt(const Vec3& place, double size, FieldHint& hint) const;
  [[nodiscard]] bool covers(const Vec3& place, FieldHint& hint) const {
    return field_->covers(place, hint);
  }
  [[nodiscard]] const PatchSurface& surface() const { return *surface_; }

 private:
  const PatchSurface* surface_;
  const SizeField* field_;
};

}  // namespace tetrafront
