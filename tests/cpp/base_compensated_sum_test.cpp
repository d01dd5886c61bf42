/// Sums of many terms.

#include "base/compensated_sum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tetrafront {
namespace {

TEST(CompensatedSum, OfMillionsOfEqualTermsIsExactWherePlainSumsAreNot) {
  // The volumes of 4.8 million equal elements of a unit cube: 3^14 of them.
  constexpr int kTerms = 4'782'969;
  const double term = 1.0 / kTerms;
  CompensatedSum sum;
  double plain = 0.0;
  for (int i = 0; i < kTerms; ++i) {
    sum.add(term);
    plain += term;
  }
  EXPECT_NEAR(sum.value(), 1.0, 4e-16);
  EXPECT_GT(std::fabs(plain - 1.0), 1e-12);
}

TEST(CompensatedSum, KeepsSmallTermsBesideLargeOnesThatCancel) {
  CompensatedSum sum;
  for (const double term : {1.0, 1e100, 1.0, -1e100}) sum.add(term);
  EXPECT_EQ(sum.value(), 2.0);
}

}  // namespace
}  // namespace tetrafront
