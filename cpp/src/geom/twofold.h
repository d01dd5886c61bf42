#pragma once

/// @file Numbers with twice the digits of a double. They decide most signs that doubles leave
/// open, before exact arithmetic is needed. The relative error of sums and products is a few
/// 2^-106 (Joldes, Muller & Popescu 2017), as long as nothing underflows.

#include "geom/expansion.h"

namespace tetrafront {

/// The number high + low, with |low| at most half a unit in the last place of high.
struct Twofold {
  double high;
  double low;
};

/// Requires |high| >= |low|, or both 0.
inline Twofold renormalized(double high, double low) {
  const TwoTerms t = fastTwoSum(high, low);
  return {t.high, t.low};
}

/// Returns a - b, exactly.
inline Twofold difference(double a, double b) {
  const TwoTerms t = twoSum(a, -b);
  return {t.high, t.low};
}

inline Twofold operator+(const Twofold& a, const Twofold& b) {
  const TwoTerms high = twoSum(a.high, b.high);
  const TwoTerms low = twoSum(a.low, b.low);
  const Twofold sum = renormalized(high.high, high.low + low.high);
  return renormalized(sum.high, sum.low + low.low);
}

inline Twofold operator-(const Twofold& a, const Twofold& b) {
  return a + Twofold{-b.high, -b.low};
}

inline Twofold operator*(const Twofold& a, const Twofold& b) {
  const TwoTerms product = twoProduct(a.high, splitBits(b.high), b.high);
  return renormalized(product.high, product.low + (a.high * b.low + a.low * b.high));
}

}  // namespace tetrafront
