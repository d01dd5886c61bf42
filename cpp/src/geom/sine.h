#pragma once

/// @file Sine, cosine and angles by + - * / and sqrt alone: C libraries differ in the last bit, and
/// nodes on arcs must be the same on every platform.

#include "tetrafront/vec3.h"

namespace tetrafront {

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Returns both functions of an angle in radians; from -2 pi to 4 pi, each error is below 2e-15, and from 0 to 2 pi
/// below 2e-16. The magnitude of the angle must be below 1e9.
[[nodiscard]] SineCosine sineCosine(double angle);

/// Returns the angle of a direction in the plane, counter-clockwise from the x axis, in radians: 0
/// to 2 pi. `direction` must not be zero.
[[nodiscard]] double angleOf(const Vec2& direction);

}  // namespace tetrafront
