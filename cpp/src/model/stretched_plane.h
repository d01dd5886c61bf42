#pragma once

/// @file The unit square or triangle, stretched and sheared to resemble a surface patch in the
/// plane (Löhner & Parikh 1988, appendix, eq. 16 and 17, figure 1). For a triangle A B D, the point
/// C is omitted and the mapping is affine.
///
/// eta'' ^  D-----------C     A = (0, 0)        B = (x_B, 0)
///       |  /          /      D = (x_D, y_D)    C = (x_D + |DC|, y_D)
///       | /          /
///       | A---------B        The lengths are arc lengths of the patch's lines.
///       +-----------------> xi''

#include "tetrafront/vec3.h"

namespace tetrafront {

class StretchedPlane {
 public:
  /// All lengths must be positive. `tangentAlongAB` and `tangentAlongAD` are the surface's tangents
  /// at A; they define the angle there, which is limited to 20 .. 160 degrees.
  StretchedPlane(double lengthAB, double lengthAD, double lengthDC, const Vec3& tangentAlongAB,
                 const Vec3& tangentAlongAD);
  /// Makes the unit square.
  StretchedPlane() = default;

  /// For a triangular patch: the plane triangle A B D with the lengths of its three lines, if it
  /// exists with an angle of 20 .. 160 degrees at A. All lengths must be positive.
  [[nodiscard]] static StretchedPlane ofTriangle(double lengthAB, double lengthAD, double lengthBD);

  /// Maps (xi, eta) to (xi'', eta''), eq. (16).
  [[nodiscard]] Vec2 toPlane(const Vec2& unit) const;
  /// Maps (xi'', eta'') to (xi, eta), eq. (17), the inverse.
  [[nodiscard]] Vec2 toUnit(const Vec2& plane) const;

  /// Derivatives of xi and eta with respect to xi'' and eta'': {d xi/d xi'', d xi/d eta'', d eta/d
  /// eta''}; eta does not depend on xi''.
  struct Derivatives {
    double xiByXi;
    double xiByEta;
    double etaByEta;
  };
  [[nodiscard]] Derivatives derivatives(const Vec2& unit) const;

 private:
  void placeD(double lengthAD, double cosine);

  double xB_ = 1.0;
  double xD_ = 0.0;
  double yD_ = 1.0;
  double shear_ = 0.0;  ///< -x_B + x_C - x_D; 0 for a triangle
};

}  // namespace tetrafront
