#pragma once

/// @file The natural logarithm and exponential by + - * / alone: C libraries differ in the last bit, and metrics
/// must be the same on every platform.

namespace tetrafront {

/// Returns the natural logarithm of a finite number > 0, with an error below 3e-16 plus 3e-16 of the result; minus
/// infinity for other numbers.
[[nodiscard]] double logarithm(double value);

/// Returns e to the power of a number, with a relative error below 4e-16; 0 below -700, infinity above 700.
[[nodiscard]] double exponential(double exponent);

}  // namespace tetrafront
