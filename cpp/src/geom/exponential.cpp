// Both functions are reduced to a short interval by powers of two, which are exact, and then summed as series.

#include "geom/exponential.h"

#include <cmath>
#include <limits>

namespace tetrafront {
namespace {

/// ln 2 in two parts: the first has 32 trailing zero bits, so its products with exponents are exact.
constexpr double kLogTwoHigh = 0x1.62e42feep-1;
constexpr double kLogTwoLow = 0x1.a39ef35793c76p-33;
constexpr double kRootOfHalf = 0x1.6a09e667f3bcdp-1;

/// Terms after which the series are below half a unit in the last place of their sums.
constexpr int kLogarithmTerms = 11;
constexpr int kExponentialTerms = 14;

constexpr double kLargestExponent = 700.0;

}  // namespace

double logarithm(double value) {
  if (!(value > 0.0)) return -std::numeric_limits<double>::infinity();
  int exponent = 0;
  double fraction = std::frexp(value, &exponent);
  if (fraction < kRootOfHalf) {
    fraction *= 2.0;
    --exponent;
  }
  // ln f = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...), |s| < 0.172.
  const double s = (fraction - 1.0) / (fraction + 1.0);
  const double square = s * s;
  double sum = 0.0;
  for (int k = kLogarithmTerms; k >= 1; --k) sum = square * (sum + 1.0 / (2 * k + 1));
  const double low = exponent * kLogTwoLow + 2.0 * s * sum;
  return exponent * kLogTwoHigh + (2.0 * s + low);
}

double exponential(double exponent) {
  if (exponent < -kLargestExponent) return 0.0;
  if (exponent > kLargestExponent) return std::numeric_limits<double>::infinity();
  const double power = std::floor(exponent / (kLogTwoHigh + kLogTwoLow) + 0.5);
  const double rest = (exponent - power * kLogTwoHigh) - power * kLogTwoLow;
  double sum = 0.0;
  for (int k = kExponentialTerms; k >= 1; --k) sum = (rest / k) * (1.0 + sum);
  return std::ldexp(1.0 + sum, static_cast<int>(power));
}

}  // namespace tetrafront
