#pragma once

/// @file Where to move one node so that the elements around it become better.

#include <span>

#include "tetrafront/vec3.h"

namespace tetrafront {

/// A Bezier coefficient of det J, divided by that of straight edges, as a function of the displacement of one node: `value` +
/// dot(`gradient`, displacement). It is exact, because J changes by a matrix of rank one.
struct AffineCoefficient {
  double value;
  Vec3 gradient;
};

/// Returns a displacement for which the least coefficient is about as large as it can be: zero if it cannot grow. It is the
/// centre of the displacements for which all coefficients are above a bound, which rises (Huard's method of centres).
[[nodiscard]] Vec3 raisingStep(std::span<const AffineCoefficient> coefficients);

}  // namespace tetrafront
