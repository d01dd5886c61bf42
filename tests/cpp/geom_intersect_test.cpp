#include "geom/intersect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "geom/measure.h"
#include "geom/predicates.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

// ---- the oracle: clip one triangle by the other in fractions, and inspect the remaining part ----

/// A fraction of small numbers, always reduced.
struct Fraction {
  long long top = 0;
  long long bottom = 1;

  Fraction() = default;
  Fraction(long long t, long long b = 1) {  // NOLINT(google-explicit-constructor)
    const long long common = std::gcd(t, b) * (b < 0 ? -1 : 1);
    top = t / common;
    bottom = b / common;
  }
  [[nodiscard]] int sign() const { return top > 0 ? 1 : (top < 0 ? -1 : 0); }
  friend Fraction operator+(Fraction a, Fraction b) {
    return {a.top * b.bottom + b.top * a.bottom, a.bottom * b.bottom};
  }
  friend Fraction operator-(Fraction a, Fraction b) { return a + Fraction(-b.top, b.bottom); }
  friend Fraction operator*(Fraction a, Fraction b) { return {a.top * b.top, a.bottom * b.bottom}; }
  friend Fraction operator/(Fraction a, Fraction b) { return {a.top * b.bottom, a.bottom * b.top}; }
};

using Position = std::array<Fraction, 3>;
using Polygon = std::vector<Position>;

Position minus(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Fraction dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Returns the part of a convex polygon, segment or point where normal . (x - origin) >= 0.
Polygon clipped(const Polygon& polygon, const Position& origin, const Position& normal) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Position& a = polygon[i];
    const Position& b = polygon[(i + 1) % polygon.size()];
    const Fraction da = dot(normal, minus(a, origin));
    const Fraction db = dot(normal, minus(b, origin));
    if (da.sign() >= 0) result.push_back(a);
    if (da.sign() * db.sign() >= 0) continue;
    const Fraction t = da / (da - db);
    result.push_back(
        {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
  }
  return result;
}

Polygon commonPart(const Polygon& a, const Polygon& b) {
  const Position normal = cross(minus(b[1], b[0]), minus(b[2], b[0]));
  const Position opposite{Fraction(0) - normal[0], Fraction(0) - normal[1],
                          Fraction(0) - normal[2]};
  Polygon part = clipped(clipped(a, b[0], normal), b[0], opposite);
  for (std::size_t k = 0; k < 3; ++k) {
    part = clipped(part, b[k], cross(normal, minus(b[(k + 1) % 3], b[k])));
  }
  return part;
}

/// a and b may be one position.
bool isOnSegment(const Position& p, const Position& a, const Position& b) {
  const Position turn = cross(minus(p, a), minus(b, a));
  if (turn[0].sign() != 0 || turn[1].sign() != 0 || turn[2].sign() != 0) return false;
  return dot(minus(p, a), minus(p, b)).sign() <= 0;
}

/// A triangle on an integer grid; its nodes are numbered by their positions.
using GridTriangle = std::array<std::array<int, 3>, 3>;

Polygon polygonOf(const GridTriangle& t) {
  Polygon polygon;
  for (const auto& p : t) polygon.push_back({Fraction(p[0]), Fraction(p[1]), Fraction(p[2])});
  return polygon;
}

bool oracleIntersectsImproperly(const GridTriangle& a, const GridTriangle& b) {
  Polygon shared;
  for (const auto& p : a) {
    if (std::find(b.begin(), b.end(), p) == b.end()) continue;
    shared.push_back({Fraction(p[0]), Fraction(p[1]), Fraction(p[2])});
  }
  if (shared.size() == 3) return true;
  const Polygon part = commonPart(polygonOf(a), polygonOf(b));
  return std::any_of(part.begin(), part.end(), [&](const Position& p) {
    return shared.empty() || !isOnSegment(p, shared.front(), shared.back());
  });
}

NumberedTriangle numbered(const GridTriangle& t) {
  NumberedTriangle result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.nodes[k] = static_cast<std::uint32_t>(t[k][0] + 10 * t[k][1] + 100 * t[k][2]);
    result.corners[k] = Vec3(t[k][0], t[k][1], t[k][2]);
  }
  return result;
}

std::string described(const GridTriangle& a, const GridTriangle& b) {
  std::string text;
  for (const GridTriangle& t : {a, b}) {
    for (const auto& p : t) {
      for (const int c : p) text += std::to_string(c);
      text += ' ';
    }
    text += "| ";
  }
  return text;
}

bool isDegenerate(const GridTriangle& t) {
  const NumberedTriangle n = numbered(t);
  return collinear(n.corners[0], n.corners[1], n.corners[2]);
}

std::vector<GridTriangle> trianglesOfUnitCube() {
  std::vector<GridTriangle> triangles;
  const auto corner = [](int i) { return std::array<int, 3>{i & 1, i >> 1 & 1, i >> 2}; };
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      for (int k = j + 1; k < 8; ++k) triangles.push_back({corner(i), corner(j), corner(k)});
    }
  }
  return triangles;
}

TEST(IntersectTest, AgreesWithTheOracleOnAllTrianglesOfTheUnitCube) {
  const std::vector<GridTriangle> triangles = trianglesOfUnitCube();
  ASSERT_EQ(triangles.size(), 56U);
  int meeting = 0;
  for (const GridTriangle& a : triangles) {
    for (const GridTriangle& b : triangles) {
      const bool expected = oracleIntersectsImproperly(a, b);
      meeting += expected ? 1 : 0;
      ASSERT_EQ(intersectImproperly(numbered(a), numbered(b)), expected) << described(a, b);
    }
  }
  EXPECT_GT(meeting, 56);
  EXPECT_LT(meeting, 56 * 56);
}

/// The grid is so small that most corners are coplanar, collinear or touching.
TEST(IntersectTest, AgreesWithTheOracleOnRandomGridTriangles) {
  Random random(201);
  std::array<int, 2> outcomes{};
  for (const std::array<int, 3>& extent :
       {std::array<int, 3>{3, 3, 3}, {4, 4, 0}, {2, 2, 1}, {4, 1, 1}}) {
    const auto position = [&] {
      return std::array<int, 3>{random.integer(0, extent[0]), random.integer(0, extent[1]),
                                random.integer(0, extent[2])};
    };
    for (int i = 0; i < 20000; ++i) {
      GridTriangle a{position(), position(), position()};
      GridTriangle b{position(), position(), position()};
      // Random corners rarely coincide: share one or two on purpose.
      const int shared = random.integer(0, 2);
      for (int k = 0; k < shared; ++k) {
        b[static_cast<std::size_t>(random.integer(0, 2))] = a[static_cast<std::size_t>(k)];
      }
      if (isDegenerate(a) || isDegenerate(b)) continue;
      const bool expected = oracleIntersectsImproperly(a, b);
      ++outcomes[expected ? 1 : 0];
      ASSERT_EQ(intersectImproperly(numbered(a), numbered(b)), expected) << described(a, b);
      ASSERT_EQ(intersectImproperly(numbered(b), numbered(a)), expected) << described(b, a);
    }
  }
  EXPECT_GT(outcomes[0], 5000);
  EXPECT_GT(outcomes[1], 5000);
}

TEST(IntersectTest, DoesNotDependOnTheOrderOfCorners) {
  Random random(202);
  for (int i = 0; i < 300; ++i) {
    const auto position = [&] {
      return std::array<int, 3>{random.integer(0, 2), random.integer(0, 2), random.integer(0, 2)};
    };
    GridTriangle a{position(), position(), position()};
    GridTriangle b{a[0], position(), position()};
    if (isDegenerate(a) || isDegenerate(b)) continue;
    const bool expected = intersectImproperly(numbered(a), numbered(b));
    std::sort(a.begin(), a.end());
    do {
      std::sort(b.begin(), b.end());
      do {
        ASSERT_EQ(intersectImproperly(numbered(a), numbered(b)), expected) << described(a, b);
      } while (std::next_permutation(b.begin(), b.end()));
    } while (std::next_permutation(a.begin(), a.end()));
  }
}

TEST(IntersectTest, NodeIndicesNotPositionsDecideWhichNodesAreShared) {
  NumberedTriangle a = numbered({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
  NumberedTriangle b = numbered({{{1, 0, 0}, {0, 0, 0}, {0, 0, 1}}});
  EXPECT_FALSE(intersectImproperly(a, b));
  b.nodes = {50, 51, 52};
  EXPECT_TRUE(intersectImproperly(a, b)) << "the sheets are not joined: they touch";
}

/// Returns the weights of a triangle's corners at p, and the distance of p from the triangle's
/// plane relative to the triangle's size.
std::array<double, 4> mixtureOf(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double square = glm::dot(normal, normal);
  const auto share = [&](const Vec3& a, const Vec3& b) {
    return glm::dot(glm::cross(b - a, p - a), normal) / square;
  };
  return {share(t[1], t[2]), share(t[2], t[0]), share(t[0], t[1]),
          glm::dot(normal, p - t[0]) / square};
}

TEST(IntersectionPosition, IsInBothTriangles) {
  Random random(203);
  int met = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto position = [&] {
      return std::array<int, 3>{random.integer(0, 3), random.integer(0, 3), random.integer(0, 2)};
    };
    const GridTriangle a{position(), position(), position()};
    const GridTriangle b{position(), position(), position()};
    if (isDegenerate(a) || isDegenerate(b)) continue;
    const std::array<Vec3, 3> inA = numbered(a).corners;
    const std::array<Vec3, 3> inB = numbered(b).corners;
    if (!trianglesIntersect(inA, inB)) continue;
    ++met;
    const Vec3 common = intersectionPosition(inA, inB);
    for (const auto& triangle : {inA, inB}) {
      const std::array<double, 4> mixture = mixtureOf(common, triangle);
      for (std::size_t k = 0; k < 3; ++k) ASSERT_GE(mixture[k], -1e-9) << described(a, b);
      ASSERT_NEAR(mixture[3], 0.0, 1e-9) << described(a, b);
    }
  }
  EXPECT_GT(met, 500);
}

/// A corner that is one unit in the last place away from a plane is not in it.
TEST(IntersectTest, DistinguishesTouchingFromNearlyTouching) {
  const std::array<Vec3, 3> floor{Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0)};
  for (const double gap : {0.0, 5e-324, 1e-300, 1e-16}) {
    const std::array<Vec3, 3> above{Vec3(0.25, 0.25, gap), Vec3(0.5, 0.25, 1.0),
                                    Vec3(0.2, 0.4, 1.0)};
    EXPECT_EQ(trianglesIntersect(floor, above), gap == 0.0) << gap;
  }
}

}  // namespace
}  // namespace tetrafront::testing
