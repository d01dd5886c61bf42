#include "geom/oriented_box.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "geom/intersect.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

using Triangle = std::array<Vec3, 3>;

Vec3 direction(Random& random) {
  const Vec3 v = random.inBox();
  return v / glm::length(v);
}

/// Returns a random triangle, from a well shaped one to a needle of 1e-9, far from the origin or
/// near it.
Triangle anyTriangle(Random& random, const Vec3& around) {
  const Vec3 along = direction(random) * std::pow(10.0, -random.integer(0, 2));
  const Vec3 aside = direction(random) * std::pow(10.0, -random.integer(0, 9));
  const Vec3 start = around + 0.3 * random.inBox();
  return {start, start + along, start + 0.5 * along + aside};
}

OrientedBox boxOf(const Triangle& t) { return OrientedBox::of(t[0], t[1], t[2]); }

TEST(OrientedBoxTest, NeverSeparatesBoxesThatIntersect) {
  Random random(51);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 around = Vec3(1.0, -2.0, 0.5) * (i % 2 == 0 ? 0.0 : 1e6);
    std::array<Triangle, 3> t{anyTriangle(random, around), anyTriangle(random, around),
                              anyTriangle(random, around)};
    // Move the third triangle so that it intersects the first one, up to rounding.
    const Vec3 way = (t[0][0] + t[0][1] + t[0][2] - t[2][0] - t[2][1] - t[2][2]) / 3.0;
    for (Vec3& corner : t[2]) corner += way;
    const OrientedBox both = OrientedBox::hull(boxOf(t[0]), boxOf(t[1]));
    // The box is not apart from the triangles that it was made from, nor from their corners.
    for (const Triangle& inside : {t[0], t[1]}) {
      ASSERT_FALSE(both.isApartFrom(boxOf(inside)));
      for (const Vec3& corner : inside)
        ASSERT_FALSE(both.isApartFrom(OrientedBox::of(corner, corner, corner)));
    }
    if (!trianglesIntersect(t[0], t[2])) continue;
    ++met;
    ASSERT_FALSE(boxOf(t[0]).isApartFrom(boxOf(t[2])));
    ASSERT_FALSE(both.isApartFrom(boxOf(t[2])));
  }
  EXPECT_GT(met, 500);
}

/// If the width of a needle is only rounding, so is the direction across it. The box must contain
/// the corners nevertheless.
TEST(OrientedBoxTest, HoldsNeedlesAsThinAsRounding) {
  Random random(52);
  for (int i = 0; i < 4000; ++i) {
    const Vec3 from = random.inBox();
    const Vec3 to = i % 2 == 0 ? -from : random.inBox();
    const double height = std::pow(10.0, -random.integer(11, 17));
    const Vec3 tip = from + random.unit() * (to - from) + height * random.inBox();
    const OrientedBox box = OrientedBox::of(from, to, tip);
    for (const Vec3& corner : {from, to, tip, 0.5 * (from + to)}) {
      ASSERT_FALSE(box.isApartFrom(OrientedBox::of(corner, corner, corner))) << height;
    }
    // The box is still thin, so it is separated from a slightly displaced one.
    const Vec3 aside = 1e-3 * glm::cross(to - from, direction(random));
    ASSERT_TRUE(box.isApartFrom(OrientedBox::of(from + aside, to + aside, tip + aside)) ||
                glm::length(aside) < 1e-6)
        << height;
  }
}

TEST(OrientedBoxTest, SlantedNeedlesSideBySideAreApart) {
  const Vec3 along(1.0, 2.0, 3.0);
  const Vec3 aside = 1e-4 * glm::cross(along, Vec3(0.0, 0.0, 1.0));
  std::vector<OrientedBox> needles;
  for (int i = 0; i < 8; ++i) {
    const Vec3 start = static_cast<double>(i) * aside;
    needles.push_back(OrientedBox::of(start, start + along, start + aside));
  }
  for (std::size_t i = 0; i < needles.size(); ++i) {
    for (std::size_t j = i + 2; j < needles.size(); ++j) {
      EXPECT_TRUE(needles[i].isApartFrom(needles[j])) << i << ' ' << j;
    }
  }
  const auto four = [&](std::size_t first) {
    return OrientedBox::hull(OrientedBox::hull(needles[first], needles[first + 1]),
                             OrientedBox::hull(needles[first + 2], needles[first + 3]));
  };
  EXPECT_TRUE(four(0).isApartFrom(needles[5]));
  EXPECT_TRUE(needles[2].isApartFrom(four(4)));
}

TEST(OrientedBoxTest, NeedlesThatPassEachOtherAreApart) {
  const OrientedBox below =
      OrientedBox::of(Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 0.0, 0.01));
  const OrientedBox above =
      OrientedBox::of(Vec3(-1.0, 1.0, 0.02), Vec3(1.0, -1.0, 0.02), Vec3(0.0, 0.0, 0.03));
  EXPECT_TRUE(below.isApartFrom(above));
}

/// If squares overflow or vanish, boxes must not count as apart.
TEST(OrientedBoxTest, NumbersOutOfRangeAreNotSeparated) {
  for (const double scale : {1e200, 1e-200, 1e-300}) {
    const Triangle t{Vec3(0.0), Vec3(scale, scale, 0.0), Vec3(0.0, scale, scale)};
    const Triangle crossing{Vec3(0.0, scale, 0.0), Vec3(scale, 0.0, 0.5 * scale),
                            Vec3(scale, scale, scale)};
    EXPECT_FALSE(boxOf(t).isApartFrom(boxOf(crossing))) << scale;
    EXPECT_FALSE(OrientedBox::hull(boxOf(t), boxOf(t)).isApartFrom(boxOf(crossing))) << scale;
  }
}

}  // namespace
}  // namespace tetrafront::testing
