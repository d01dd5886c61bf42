#include "geom/insphere.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "geom/predicates.h"
#include "support/exact_oracle.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 4>;

/// Returns the sign of the determinant with rows (v, v.v), where v is the vector from p to each
/// corner.
int oracleInsphere(const Corners& c, const Vec3& p) {
  const std::array<ExactVec3, 5> e = exactly<5>({c[0], c[1], c[2], c[3], p});
  std::array<ExactVec3, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = e[i] - e[4];
  const auto term = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    return exactDot(v[i], v[i]) * exactDot(v[j], exactCross(v[k], v[l]));
  };
  return (term(0, 1, 2, 3) - term(1, 0, 2, 3) + term(2, 0, 1, 3) - term(3, 0, 1, 2)).sign();
}

Corners inOrder(Corners c) {
  if (orient3d(c[0], c[1], c[2], c[3]) < 0) std::swap(c[0], c[1]);
  return c;
}

TEST(InsphereTest, FollowsTheConvention) {
  const Corners corners = inOrder(
      {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0)});
  EXPECT_TRUE(isInsideSphere(corners, Vec3(0.1, -0.2, 0.3)));
  EXPECT_TRUE(isInsideSphere(corners, Vec3(0.0, -0.999999, 0.0)));
  EXPECT_FALSE(isInsideSphere(corners, Vec3(0.0, -1.000001, 0.0)));
  EXPECT_FALSE(isInsideSphere(corners, Vec3(3.0, 4.0, 5.0)));
}

TEST(InsphereTest, WhatIsOnTheSphereIsOutside) {
  // All 8 corners of a box.
  std::array<Vec3, 8> box;
  for (std::size_t i = 0; i < 8; ++i) {
    box.at(i) = Vec3(i % 2 == 0 ? 0.1 : 0.7, i / 2 % 2 == 0 ? -3.3 : 5.7, i < 4 ? 1e-3 : 2e3);
  }
  const Corners corners = inOrder({box[0], box[1], box[2], box[4]});
  for (const Vec3& p : box) EXPECT_FALSE(isInsideSphere(corners, p));
}

/// The nodes of a ring of needles: up to rounding, they lie on two circles of one sphere.
Vec3 onRings(Random& random) {
  const double angle = random.between(0.0, 6.3);
  return {0.2 * std::cos(angle), 0.2 * std::sin(angle), random.integer(0, 1) == 0 ? -0.7 : 0.7};
}

TEST(InsphereTest, IsRightAmongNeedles) {
  Random random(301);
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < 3000; ++i) {
    Corners corners;
    for (Vec3& c : corners) c = onRings(random);
    const Vec3 p = onRings(random);
    corners = inOrder(corners);
    if (orient3d(corners[0], corners[1], corners[2], corners[3]) == 0) continue;
    const bool expected = oracleInsphere(corners, p) > 0;
    (expected ? inside : outside) += 1;
    ASSERT_EQ(isInsideSphere(corners, p), expected) << "case " << i;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

}  // namespace
}  // namespace tetrafront::testing
