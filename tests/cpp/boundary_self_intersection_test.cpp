#include "boundary/self_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "boundary/triangle_pairs.h"
#include "geom/intersect.h"
#include "support/random.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

bool isFlat(const SurfaceMesh& mesh, std::uint32_t t) {
  const std::array<Vec3, 3> p = cornersOf(mesh, TriangleId(t));
  return glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) == 0.0;
}

/// Returns the expected result: tests every pair of triangles.
std::set<Pair> allIntersectingPairs(const SurfaceMesh& mesh,
                                    const std::vector<std::uint8_t>& ignored) {
  std::set<Pair> pairs;
  for (std::uint32_t a = 0; a < countTriangles(mesh); ++a) {
    for (std::uint32_t b = a + 1; b < countTriangles(mesh); ++b) {
      if (ignored[a] != 0 || ignored[b] != 0) continue;
      if (intersectImproperly(numberedTriangle(mesh, TriangleId(a)),
                              numberedTriangle(mesh, TriangleId(b)))) {
        pairs.emplace(a, b);
      }
    }
  }
  return pairs;
}

/// Returns the reported pairs in their order.
std::vector<Pair> pairsFound(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& ignored,
                             std::uint32_t budget) {
  BoundaryReport report(mesh, BoundarySource::kGivenSurface);
  const BoxTree tree(triangleBoxes(mesh));
  Job check([&](Work& work) { return checkSelfIntersections(work, mesh, ignored, tree, report); });
  double fraction = check.fraction();
  while (!check.advance(budget)) {
    EXPECT_GE(check.fraction(), fraction);
    fraction = check.fraction();
  }
  EXPECT_EQ(check.fraction(), 1.0);
  std::vector<Pair> pairs;
  for (const Diagnostic& d : report.take()) {
    pairs.emplace_back(d.entities.at(0).index, d.entities.at(1).index);
  }
  return pairs;
}

/// Returns triangles between few positions: they share nodes and edges, many are coplanar or
/// needles, and 20 or more meet at a node.
SurfaceMesh tangle(Random& random) {
  SurfaceMesh mesh;
  const int nodes = random.integer(8, 24);
  for (int i = 0; i < nodes; ++i) {
    const bool isFar = random.integer(0, 3) == 0;
    for (int k = 0; k < 3; ++k) {
      mesh.points.push_back(random.integer(0, 6) * (isFar ? 40.0 : 1.0));
    }
  }
  const auto node = [&] { return static_cast<std::uint32_t>(random.integer(0, nodes - 1)); };
  const std::uint32_t hub = node();
  while (countTriangles(mesh) < 40) {
    const std::array<std::uint32_t, 3> t{random.integer(0, 1) == 0 ? hub : node(), node(), node()};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
  }
  return mesh;
}

TEST(SelfIntersectionTest, FindsAllIntersectingPairs) {
  Random random(61);
  std::size_t found = 0;
  std::size_t clean = 0;
  for (int i = 0; i < 200; ++i) {
    const SurfaceMesh mesh = tangle(random);
    std::vector<std::uint8_t> ignored(countTriangles(mesh), 0);
    for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
      ignored[t] = isFlat(mesh, t) || random.integer(0, 9) == 0 ? 1 : 0;
    }
    const std::set<Pair> expected = allIntersectingPairs(mesh, ignored);
    const std::vector<Pair> pairs =
        pairsFound(mesh, ignored, 1 + static_cast<std::uint32_t>(i) % 7);
    ASSERT_EQ(pairs, std::vector<Pair>(expected.begin(), expected.end())) << i;
    found += expected.size();
    clean += countTriangles(mesh) * (countTriangles(mesh) - 1) / 2 - expected.size();
  }
  EXPECT_GT(found, 1000U);
  EXPECT_GT(clean, 1000U);
}

/// Returns a cone whose base is a fan too, or a slanted column; both consist of needles.
SurfaceMesh needleSurface(std::uint32_t sides, bool isCone) {
  SurfaceMesh mesh;
  const auto add = [&](const Vec3& p) { mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z}); };
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Vec3 p(std::cos(angle), std::sin(angle), 0.0);
    add(p);
    if (!isCone) add(p + Vec3(20.0, 30.0, 40.0));
  }
  if (isCone) {
    add(Vec3(0.3, 0.1, 0.0));
    add(Vec3(0.0, 0.0, 2.0));
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t j = (i + 1) % sides;
    if (isCone) {
      mesh.triangles.insert(mesh.triangles.end(), {j, i, sides, i, j, sides + 1});
    } else {
      mesh.triangles.insert(mesh.triangles.end(),
                            {2 * i, 2 * j, 2 * i + 1, 2 * j, 2 * j + 1, 2 * i + 1});
    }
  }
  return mesh;
}

TEST(SelfIntersectionTest, AcceptsNeedlesAndFindsANodePulledThroughThem) {
  for (const bool isCone : {true, false}) {
    SurfaceMesh mesh = needleSurface(60, isCone);
    std::vector<std::uint8_t> ignored(countTriangles(mesh), 0);
    EXPECT_TRUE(pairsFound(mesh, ignored, 1000).empty());
    // Pull a node through the opposite side.
    mesh.points[0] = isCone ? -1.5 : 1.0;
    mesh.points[1] = isCone ? 0.2 : 6.0;
    mesh.points[2] = isCone ? 0.0 : 8.0;
    const std::set<Pair> expected = allIntersectingPairs(mesh, ignored);
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(pairsFound(mesh, ignored, 1000), std::vector<Pair>(expected.begin(), expected.end()));
  }
}

/// Counts the pairs of branches per triangle. The axis-parallel boxes of the needles of a slanted column all overlap;
/// without boxes along the triangles, the number would grow with the number of needles.
TEST(TrianglePairsTest, VisitsFewPairsOfNeedles) {
  for (const bool isCone : {true, false}) {
    std::vector<double> perTriangle;
    for (const std::uint32_t sides : {250U, 4000U}) {
      const SurfaceMesh mesh = needleSurface(sides, isCone);
      const BoxTree tree(triangleBoxes(mesh));
      TrianglePairs pairs(mesh, tree);
      std::uint32_t steps = 1;
      std::uint32_t visited = 0;
      const auto visit = [&](TriangleId, TriangleId) { ++visited; };
      while (!pairs.advance(1, visit)) ++steps;
      perTriangle.push_back(static_cast<double>(steps + visited) / countTriangles(mesh));
    }
    EXPECT_LT(perTriangle[1], 2.0 * perTriangle[0]) << isCone;
  }
}

/// Returns `count` triangles along x and `count` along y; each of the former intersects each of the latter.
SurfaceMesh crossingTriangles(std::uint32_t count) {
  SurfaceMesh mesh;
  const auto far = static_cast<double>(count);
  for (const bool alongX : {true, false}) {
    for (std::uint32_t i = 0; i < count; ++i) {
      for (const Vec2& p : {Vec2(-1.0, -1.0), Vec2(far, -1.0), Vec2(far, 1.0)}) {
        mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.points.size() / 3));
        const auto at = static_cast<double>(i);
        mesh.points.insert(mesh.points.end(), {alongX ? p.x : at, alongX ? at : p.x, p.y});
      }
    }
  }
  return mesh;
}

/// Returns the number of diagnostics, and their distinct values.
std::pair<std::size_t, std::set<std::vector<double>>> reportOf(const SurfaceMesh& mesh,
                                                               std::uint32_t budget,
                                                               std::size_t maxDiagnostics) {
  const std::vector<std::uint8_t> ignored(countTriangles(mesh), 0);
  BoundaryReport report(mesh, BoundarySource::kGivenSurface, maxDiagnostics);
  const BoxTree tree(triangleBoxes(mesh));
  Job check([&](Work& work) { return checkSelfIntersections(work, mesh, ignored, tree, report); });
  while (!check.advance(budget)) {
  }
  const std::vector<Diagnostic> diagnostics = report.take();
  std::set<std::vector<double>> values;
  for (const Diagnostic& diagnostic : diagnostics) values.insert(diagnostic.values);
  return {diagnostics.size(), values};
}

TEST(SelfIntersectionTest, ReportsWhetherTheTotalIsALowerBound) {
  const auto [fewListed, few] = reportOf(crossingTriangles(40), 1000, 1000);
  EXPECT_EQ(fewListed, 1000U);
  EXPECT_EQ(few, (std::set<std::vector<double>>{{1600.0}}));
  const SurfaceMesh many = crossingTriangles(330);
  const auto [manyListed, atLeast] = reportOf(many, 1000, 1000);
  EXPECT_EQ(manyListed, 1000U);
  ASSERT_EQ(atLeast.size(), 1U);
  const std::vector<double>& values = *atLeast.begin();
  ASSERT_EQ(values.size(), 2U);
  EXPECT_GE(values[0], 100'000.0);
  EXPECT_LT(values[0], 330.0 * 330.0);
  EXPECT_EQ(values[1], 1.0);
  EXPECT_EQ(reportOf(many, 7, 1000).second, atLeast);
}

TEST(SelfIntersectionTest, FindsAllIfTheReportKeepsMoreThanTheLimitOfTheSearch) {
  const auto [listed, values] = reportOf(crossingTriangles(330), 1000, 200'000);
  EXPECT_EQ(listed, 330U * 330U);
  EXPECT_EQ(values, (std::set<std::vector<double>>{{330.0 * 330.0}}));
}

}  // namespace
}  // namespace tetrafront::testing
