#include "geom/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "support/exact_oracle.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 4>;

std::string described(const Corners& p) {
  std::string text;
  for (const Vec3& v : p) {
    text +=
        " (" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ")";
  }
  return text;
}

double nudged(double value, int steps) {
  for (; steps > 0; --steps) value = std::nextafter(value, 1e300);
  for (; steps < 0; ++steps) value = std::nextafter(value, -1e300);
  return value;
}

/// The fourth corner is a rounded combination of the others, moved by a few units in the last
/// place: in the plane, or as close to it as numbers allow.
Corners nearlyFlat(Random& random, double size, const Vec3& offset) {
  Corners p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = offset + size * random.inBox();
  const double s = random.between(-1.0, 2.0);
  const double t = random.between(-1.0, 2.0);
  p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
  for (int a = 0; a < 3; ++a) p[3][a] = nudged(p[3][a], random.integer(-3, 3));
  return p;
}

TEST(PredicatesTest, Orient3dFollowsTheConvention) {
  const Vec3 o(0.0), x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0);
  EXPECT_EQ(orient3d(o, x, y, z), 1);
  EXPECT_EQ(orient3d(o, y, x, z), -1);
  EXPECT_EQ(orient3d(o, x, y, x + y), 0);
}

TEST(PredicatesTest, Orient3dIsExactOnNearlyFlatCorners) {
  Random random(101);
  int zeros = 0;
  int signs = 0;
  for (const double size : {1.0, 1e-9, 1e9}) {
    for (const double offset : {0.0, 1e6}) {
      for (int i = 0; i < 700; ++i) {
        const Corners p = nearlyFlat(random, size, Vec3(offset, -offset, 0.5 * offset));
        const int expected = oracleOrient3d(p[0], p[1], p[2], p[3]);
        (expected == 0 ? zeros : signs) += 1;
        ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected) << described(p);
        ASSERT_EQ(orient3dExact(p[0], p[1], p[2], p[3]), expected) << described(p);
      }
    }
  }
  // Both results must occur, or the test would prove nothing.
  EXPECT_GT(signs, 1000);
  EXPECT_GT(zeros, 0);
}

TEST(PredicatesTest, Orient3dIsExactOnSmallIntegerGrids) {
  Random random(102);
  int zeros = 0;
  for (int i = 0; i < 5000; ++i) {
    Corners p;
    for (Vec3& v : p) {
      const int x = random.integer(-2, 2);
      const int y = random.integer(-2, 2);
      v = Vec3(x, y, random.integer(-2, 2));
    }
    // Adding these offsets to the numbers of the grid is exact.
    for (Vec3& v : p) v += Vec3(0x1p40, -0x1p40, 0.0);
    const int expected = oracleOrient3d(p[0], p[1], p[2], p[3]);
    zeros += expected == 0 ? 1 : 0;
    ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), expected) << described(p);
  }
  EXPECT_GT(zeros, 100);
}

TEST(PredicatesTest, Orient3dChangesSignWithEveryExchange) {
  Random random(103);
  for (int i = 0; i < 200; ++i) {
    const Corners p = nearlyFlat(random, 1.0, random.inBox(1e3));
    const int sign = orient3d(p[0], p[1], p[2], p[3]);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
      int exchanges = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) exchanges += order[a] > order[b] ? 1 : 0;
      }
      const int expected = exchanges % 2 == 0 ? sign : -sign;
      ASSERT_EQ(orient3d(p[order[0]], p[order[1]], p[order[2]], p[order[3]]), expected)
          << described(p);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

TEST(PredicatesTest, Orient2dIsExactAndAntisymmetric) {
  Random random(104);
  int zeros = 0;
  for (const double size : {1.0, 1e-9, 1e9}) {
    for (const double offset : {0.0, 1e6}) {
      for (int i = 0; i < 700; ++i) {
        const auto position = [&] {
          const double x = offset + size * random.between(-1.0, 1.0);
          return Vec2(x, -offset + size * random.between(-1.0, 1.0));
        };
        const Vec2 a = position();
        const Vec2 b = position();
        Vec2 c = a + random.between(-1.0, 2.0) * (b - a);
        if (i % 4 == 0) c = b;
        c.x = nudged(c.x, random.integer(-2, 2));
        const int expected = oracleOrient2d(a, b, c);
        zeros += expected == 0 ? 1 : 0;
        ASSERT_EQ(orient2d(a, b, c), expected);
        ASSERT_EQ(orient2d(b, c, a), expected);
        ASSERT_EQ(orient2d(c, a, b), expected);
        ASSERT_EQ(orient2d(b, a, c), -expected);
        ASSERT_EQ(orient2d(a, c, b), -expected);
        ASSERT_EQ(orient2d(c, b, a), -expected);
      }
    }
  }
  EXPECT_GT(zeros, 10);
}

TEST(PredicatesTest, CollinearMeansExactlyOnOneLine) {
  EXPECT_TRUE(collinear(Vec3(0.0), Vec3(1.0, 2.0, 3.0), Vec3(2.0, 4.0, 6.0)));
  EXPECT_TRUE(collinear(Vec3(1.0), Vec3(1.0), Vec3(0.0, 5.0, 0.0)));
  EXPECT_FALSE(collinear(Vec3(0.0), Vec3(1.0, 2.0, 3.0), Vec3(2.0, 4.0, std::nextafter(6.0, 7.0))));
  EXPECT_FALSE(collinear(Vec3(0.0), Vec3(0.1, 0.2, 0.3), Vec3(0.2, 0.4, 0.7)));
}

TEST(PredicatesTest, CountsOnlySignsThatNeededTheExactStage) {
  const std::uint64_t before = exactPredicateCount();
  EXPECT_EQ(orient3d(Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)), 1);
  EXPECT_EQ(exactPredicateCount(), before);
  EXPECT_EQ(orient3d(Vec3(0.1), Vec3(0.3, 0.7, 0.9), Vec3(0.2, 0.2, 0.2), Vec3(0.7, 0.7, 0.7)), 0);
  EXPECT_EQ(exactPredicateCount(), before + 1);
}

TEST(PredicatesTest, NeedsNoExactStageInAxisParallelPlanes) {
  Random random(77);
  const std::uint64_t before = exactPredicateCount();
  for (int i = 0; i < 300; ++i) {
    std::array<Vec3, 4> points;
    for (Vec3& p : points) {
      p = random.inBox();
      p[i % 3] = 0.1;
    }
    EXPECT_EQ(orient3d(points[0], points[1], points[2], points[3]), 0);
  }
  EXPECT_EQ(exactPredicateCount(), before);
  // A point that is one unit in the last place away from the plane is not in it.
  const double above = std::nextafter(0.1, 1.0);
  EXPECT_EQ(orient3d(Vec3(0.0, 0.0, 0.1), Vec3(1.0, 0.0, 0.1), Vec3(0.0, 1.0, 0.1),
                     Vec3(0.3, 0.3, above)),
            1);
}

}  // namespace
}  // namespace tetrafront::testing
