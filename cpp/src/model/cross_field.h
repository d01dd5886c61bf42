#pragma once

/// @file Derivatives of smooth patches across their lines. The tangent plane along a line is spanned by the line's tangent T
/// and a direction B, which is a function of the line and of the tangent planes at its ends alone: B at either end is carried
/// along the line without rotation about it (by double reflection: Wang et al. 2008), and the two are blended. Two patches
/// with the same tangent planes at the ends of a common line therefore have the same normals along it, without knowing each
/// other. Along a great circle of a sphere, or a straight line or circle of a cylinder, these are the normals of the sphere or
/// cylinder.

#include "model/curve.h"

namespace tetrafront {

class CrossField {
 public:
  /// Across a line in a patch's direction: the patch's normals at its two ends, on the same side of the patch, and the
  /// derivatives across the line at the ends, perpendicular to the normals. The curve must outlive this.
  CrossField(const OrientedCurve& line, const Vec3& startNormal, const Vec3& endNormal,
             const Vec3& startDerivative, const Vec3& endDerivative);

  struct Sample {
    Vec3 across{0.0};  ///< the derivative across the line
    Vec3 change{0.0};  ///< its derivative along the line
  };
  /// `onLine`: the sample of the line at t.
  [[nodiscard]] Sample sample(double t, const Curve::Sample& onLine) const;

 private:
  /// A derivative as a multiple of the tangent plus one of B.
  struct Shares {
    double ofTangent;
    double ofDirection;
  };

  struct Blend {
    double value;
    double slope;
  };
  [[nodiscard]] Blend tangentShare(double t) const;

  OrientedCurve line_;
  CubicSpline<Vec3> direction_;  ///< B
  Shares start_;
  Shares end_;
};

/// Returns the tangent of a line at t with the length 1; where the derivative vanishes, the direction of the chord.
[[nodiscard]] Vec3 unitTangent(const OrientedCurve& line, double t);

}  // namespace tetrafront
