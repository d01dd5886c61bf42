#pragma once

/// @file Positions and derivatives of the curves and surfaces of a TrimmedModel.

#include <vector>

#include "tetrafront/trimmed_model.h"

namespace tetrafront {

/// A curve at one parameter, with its derivatives.
template <class Vector>
struct CurveJet {
  Vector position{0.0};
  Vector first{0.0};
  Vector second{0.0};
};

/// A surface at one position of its parameter plane, with its derivatives.
struct SurfaceJet {
  Vec3 position{0.0};
  Vec3 u{0.0};
  Vec3 v{0.0};
  Vec3 uu{0.0};
  Vec3 uv{0.0};
  Vec3 vv{0.0};
};

/// Splines must have consistent arrays; a parameter outside their domain is replaced by the nearest one inside.
[[nodiscard]] CurveJet<Vec3> evaluate(const SpaceCurve& curve, double t);
[[nodiscard]] CurveJet<Vec2> evaluate(const PlaneCurve& curve, double t);
[[nodiscard]] SurfaceJet evaluate(const FaceSurface& surface, const Vec2& uv);

/// Returns the parameters strictly between two others at which the curve is not infinitely smooth, ascending.
[[nodiscard]] std::vector<double> knotsBetween(const SpaceCurve& curve, double first, double last);

/// A rectangle of a parameter plane.
struct ParameterBox {
  Vec2 low{0.0};
  Vec2 high{0.0};
};

/// Returns the closest position at which the surface is defined: splines end at their last knots.
[[nodiscard]] Vec2 clampedToDomain(const FaceSurface& surface, const Vec2& uv);

/// Returns the position of the surface in `box` that is closest to a target: the best of a lattice of starts, improved
/// by Newton's method with the second derivatives, or by Gauss's where these do not lead downhill. The distance never
/// increases from the start to the result.
[[nodiscard]] Vec2 closestParameters(const FaceSurface& surface, const ParameterBox& box,
                                     const Vec3& target);

/// Returns the parameter between `first` and `last` of the position of the curve that is closest to a target, from a start, in the
/// same way.
[[nodiscard]] double closestParameterFrom(const SpaceCurve& curve, double first, double last,
                                          const Vec3& target, double start);

/// As closestParameters(), from one start, without a lattice.
[[nodiscard]] Vec2 closestParametersFrom(const FaceSurface& surface, const ParameterBox& box,
                                         const Vec3& target, const Vec2& start);

}  // namespace tetrafront
