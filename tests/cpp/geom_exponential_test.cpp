// The logarithm and exponential that replace the library's.

#include "geom/exponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

TEST(GeomExponential, LogarithmAgreesWithTheLibraryToTheLastBits) {
  Random random(4801);
  for (int i = 0; i < 100'000; ++i) {
    const double value = std::ldexp(random.between(0.5, 1.0), random.integer(-300, 300));
    const double expected = std::log(value);
    ASSERT_NEAR(logarithm(value), expected, 3e-16 * (1.0 + std::fabs(expected))) << value;
  }
}

TEST(GeomExponential, LogarithmNearOneIsExactRelativeToItsSize) {
  for (double distance = 0.3; distance > 1e-15; distance *= 0.7) {
    ASSERT_NEAR(logarithm(1.0 + distance) / std::log(1.0 + distance), 1.0, 5e-16) << distance;
    ASSERT_NEAR(logarithm(1.0 - distance) / std::log(1.0 - distance), 1.0, 5e-16) << distance;
  }
  EXPECT_EQ(logarithm(1.0), 0.0);
}

TEST(GeomExponential, ExponentialAgreesWithTheLibraryToTheLastBits) {
  Random random(4802);
  for (int i = 0; i < 100'000; ++i) {
    const double exponent = random.between(-690.0, 690.0);
    ASSERT_NEAR(exponential(exponent) / std::exp(exponent), 1.0, 4e-16) << exponent;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
}

TEST(GeomExponential, BothHaveAValueForEveryNumber) {
  EXPECT_EQ(logarithm(0.0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(logarithm(-1.0), -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(logarithm(5e-324), std::log(5e-324), 1e-13);
  EXPECT_EQ(exponential(-1e9), 0.0);
  EXPECT_EQ(exponential(1e9), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tetrafront::testing
