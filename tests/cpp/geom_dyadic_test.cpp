/// Long numbers compared with the tests' own whole numbers.

#include "geom/dyadic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geom/predicates.h"
#include "support/big_integer.h"
#include "support/random.h"

namespace tetrafront {
namespace {

using testing::BigInteger;

/// Returns random multiples of 2^-kShift of very different sizes.
constexpr int kShift = 200;
double anyDouble(testing::Random& random) {
  if (random.integer(0, 9) == 0) return random.integer(-2, 2);
  return std::ldexp(random.between(-1.0, 1.0), random.integer(-120, 90));
}

TEST(Dyadic, SumsDifferencesAndProductsAreThoseOfWholeNumbers) {
  testing::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const double a = anyDouble(random);
    const double b = anyDouble(random);
    const double c = i % 3 == 0 ? -a : anyDouble(random);
    const BigInteger wholeA = BigInteger::scaled(a, kShift);
    const BigInteger wholeB = BigInteger::scaled(b, kShift);
    const BigInteger wholeC = BigInteger::scaled(c, kShift);
    const Dyadic x(a);
    const Dyadic y(b);
    const Dyadic z(c);
    ASSERT_EQ((x + z).sign(), (wholeA + wholeC).sign());
    ASSERT_EQ((x * y - z * y).sign(), (wholeA * wholeB - wholeC * wholeB).sign());
    const Dyadic cube = (x + y) * (y - z) * (z + x) - x * y * z;
    const BigInteger wholeCube =
        (wholeA + wholeB) * (wholeB - wholeC) * (wholeC + wholeA) - wholeA * wholeB * wholeC;
    ASSERT_EQ(cube.sign(), wholeCube.sign());
    // Compute the same number in another way.
    const Dyadic other =
        x * x * y - x * x * z - x * z * z + y * y * z + x * y * y - y * z * z - x * y * z;
    ASSERT_TRUE(cube == other) << i;
  }
}

TEST(Dyadic, ReturnsTheDoublesItWasMadeFrom) {
  testing::Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const double a = anyDouble(random);
    EXPECT_EQ(Dyadic(a).toDouble(), a);
    EXPECT_EQ(Dyadic(a).negated().toDouble(), -a);
    const double b = anyDouble(random);
    const double product = (Dyadic(a) * Dyadic(b)).toDouble();
    EXPECT_NEAR(product, a * b, 4e-16 * std::fabs(a * b));
    if (b != 0.0) {
      EXPECT_NEAR(quotient(Dyadic(a), Dyadic(b)), a / b, 1e-15 * std::fabs(a / b));
    }
  }
}

TEST(Dyadic, CancellationLeavesTheLastBit) {
  const Dyadic large(0x1p90);
  const Dyadic small(0x1p-200);
  EXPECT_EQ(((large + small) - large).toDouble(), 0x1p-200);
  EXPECT_EQ(((large + small) * (large - small) - large * large).sign(), -1);
  EXPECT_EQ((large - large).sign(), 0);
  EXPECT_EQ((large - large).digitCount(), 0U);
}

TEST(Dyadic, LongProductsAreExact) {
  const Dyadic span = Dyadic(0x1p100) + Dyadic(0x1p-250);
  Dyadic power(1.0);
  for (int i = 0; i < 30; ++i) power = power * span;
  EXPECT_GT(power.digitCount(), 300U);
  // Multiply by one more factor, at once and in two parts.
  const Dyadic parts = power * Dyadic(0x1p100) + power * Dyadic(0x1p-250);
  EXPECT_TRUE(parts == span * power);
  EXPECT_FALSE(parts + Dyadic(0x1p-1000) == span * power);
  EXPECT_EQ((parts - span * power - Dyadic(0x1p-1000)).sign(), -1);
  const Dyadic copy = power;
  power = Dyadic(1.0);
  EXPECT_TRUE(copy * span == parts);
}

TEST(Dyadic, DeterminantsHaveTheSignOfTheExpansions) {
  testing::Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.inBox();
    const Vec3 b = random.inBox();
    const Vec3 c = random.inBox();
    // The point is in the plane of the others, or nearly.
    const double s = random.integer(-4, 4) * 0.25;
    Vec3 d = a + (b - a) * s + (c - a) * (1.0 - s);
    if (i % 4 == 0) d = c;
    ASSERT_EQ(determinant(toDyadic(a), toDyadic(b), toDyadic(c), toDyadic(d)).sign(),
              orient3dExact(a, b, c, d));
  }
}

}  // namespace
}  // namespace tetrafront
