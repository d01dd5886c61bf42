#pragma once

/// @file Numbers of twice a double's digits, for signs that doubles leave open and that need not be asked of
/// exact arithmetic yet. Sums and products are off by a few 2^-106 of their own size (Joldes, Muller &
/// Popescu 2017), as long as nothing underflows.

#include "geom/expansion.h"

namespace tetrafront {

/// high + low, |low| at most half a last bit of high.
struct Twofold {
  double high;
  double low;
};

/// For |high| >= |low|, or high = 0 = low.
inline Twofold renormalized(double high, double low) {
  const TwoTerms t = fastTwoSum(high, low);
  return {t.high, t.low};
}

/// a - b, exactly.
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
