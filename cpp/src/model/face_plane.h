#pragma once

/// @file The plane in which the front meshes a trimmed face: the parameters (u, v) of its surface, scaled by the mean
/// lengths along them. Where the face contains a pole or an apex, the u-lines shrink to zero there, so that the pole is
/// one point of the plane:
///
///   y ^     N          x = (u - u0) w(v)
///     |    / \         y = (v - v0) L
///     |   |   |        w is linear or parabolic in v, and zero at the poles; without poles it is constant.
///     |    \ /
///     |     S
///     +---------> x
///
/// If u-lines shrink where v does not (a pole at constant u), the roles of u and -v are exchanged.

#include <cstdint>

#include "model/parametric.h"
#include "model/surface_point.h"

namespace tetrafront {

/// The sides of a parameter box that are one point in space.
struct PoleSides {
  bool uLow = false;
  bool uHigh = false;
  bool vLow = false;
  bool vHigh = false;

  /// True if sides of both directions are: no plane is known for such a face.
  [[nodiscard]] bool isMixed() const { return (uLow || uHigh) && (vLow || vHigh); }
};

class FacePlane {
 public:
  /// `box` contains the face's loops and has a positive width and height; `poles` must not be mixed. `surface` must
  /// outlive this.
  FacePlane(const FaceSurface& surface, const ParameterBox& box, const PoleSides& poles);

  [[nodiscard]] Vec2 toPlane(const Vec2& uv) const;
  /// The inverse; at a pole, parameters beside it.
  [[nodiscard]] Vec2 toParameters(const Vec2& plane) const;
  [[nodiscard]] SurfacePoint evaluate(const Vec2& plane) const;
  /// Returns the closest position of the box of the face.
  [[nodiscard]] Vec2 clamped(const Vec2& plane) const;

 private:
  /// The function w and its derivative.
  struct Width {
    double value;
    double slope;
  };
  [[nodiscard]] Width widthAt(double across) const;
  [[nodiscard]] double awayFromPoles(double across) const;
  [[nodiscard]] Vec2 exchanged(const Vec2& uv) const;
  [[nodiscard]] Vec2 restored(const Vec2& alongAcross) const;

  const FaceSurface* surface_;
  bool isExchanged_;
  bool isPoleLow_;
  bool isPoleHigh_;
  Vec2 low_;  ///< of the box, after the exchange
  Vec2 high_;
  double middle_ = 0.0;  ///< u0
  double width_ = 1.0;   ///< of w, where its polynomial is 1
  double scale_ = 1.0;   ///< L
};

}  // namespace tetrafront
