// The sine, cosine and angles that replace the library's.

#include "geom/sine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tetrafront::testing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(GeomSine, AgreesWithTheLibraryToTheLastBits) {
  for (int i = 0; i <= 100'000; ++i) {
    const double angle = i * (kTurn / 100'000);
    const auto [sine, cosine] = sineCosine(angle);
    ASSERT_NEAR(sine, std::sin(angle), 2.3e-16) << angle;
    ASSERT_NEAR(cosine, std::cos(angle), 2.3e-16) << angle;
  }
}

TEST(GeomSine, SmallAnglesAreExactRelativeToTheirSize) {
  for (double angle = 0.5; angle > 1e-300; angle *= 0.37)
    ASSERT_NEAR(sineCosine(angle).sine / std::sin(angle), 1.0, 5e-16) << angle;
}

TEST(GeomSine, QuartersOfATurnAreExact) {
  EXPECT_EQ(sineCosine(0.0).sine, 0.0);
  EXPECT_EQ(sineCosine(0.0).cosine, 1.0);
  EXPECT_EQ(sineCosine(kTurn / 4.0).sine, 1.0);
  EXPECT_EQ(sineCosine(kTurn / 2.0).cosine, -1.0);
  EXPECT_EQ(sineCosine(0.75 * kTurn).sine, -1.0);
  EXPECT_EQ(sineCosine(kTurn).cosine, 1.0);
}

TEST(GeomSine, AnglesOfDirectionsAreThoseOfTheLibrary) {
  for (int i = 0; i < 10'000; ++i) {
    const double angle = (i + 0.5) * (kTurn / 10'000);
    const Vec2 direction = 3.7 * Vec2(std::cos(angle), std::sin(angle));
    ASSERT_NEAR(angleOf(direction), angle, 2e-15) << angle;
  }
  EXPECT_EQ(angleOf({2.0, 0.0}), 0.0);
  EXPECT_NEAR(angleOf({0.0, 1.0}), kTurn / 4.0, 1e-15);
  EXPECT_NEAR(angleOf({-1.0, 0.0}), kTurn / 2.0, 1e-15);
  EXPECT_NEAR(angleOf({0.0, -1.0}), 0.75 * kTurn, 1e-15);
  EXPECT_NEAR(angleOf({1.0, 1e-300}), 1e-300, 1e-310);
}

}  // namespace
}  // namespace tetrafront::testing
