#pragma once

/// @file The cube root, with the same bits on every machine: std::cbrt differs between libraries.

#include <cmath>

namespace tetrafront {

/// Returns the cube root of a finite number >= 0, with a relative error below 1e-15.
inline double cubeRoot(double value) {
  if (!(value > 0.0)) return 0.0;
  int exponent = 0;
  double fraction = std::frexp(value, &exponent);
  // The exponent becomes a multiple of three, and the fraction is in [1/8, 1).
  while (exponent % 3 != 0) {
    fraction *= 0.5;
    ++exponent;
  }
  // Newton's method from above: 1 is at most twice the root.
  double root = 1.0;
  // From an error of at most 100 %, each step leaves less than the square of the error: seven reach the rounding.
  constexpr int kCubeRootSteps = 7;
  for (int i = 0; i < kCubeRootSteps; ++i) root -= (root - fraction / (root * root)) / 3.0;
  return std::ldexp(root, exponent / 3);
}

}  // namespace tetrafront
