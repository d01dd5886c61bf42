#pragma once

/// @file Powers with the same bits on every machine.

#include "geom/exponential.h"

namespace tetrafront {

/// Returns `value` to the power `exponent`; 0 for values that are not above 0.
[[nodiscard]] inline double powerOf(double value, double exponent) {
  return value > 0.0 ? exponential(exponent * logarithm(value)) : 0.0;
}

}  // namespace tetrafront
