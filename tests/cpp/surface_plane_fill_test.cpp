// Polygons filled in the plane: the front of a patch, with other orders and rules if asked for. Areas, edges and orientations are
// checked by sums and exact signs, not by the code of the front.

#include "tetrafront/plane_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <utility>

#include "geom/predicates.h"
#include "support/meshed_surface.h"
#include "support/planes.h"

namespace tetrafront::testing {
namespace {

constexpr std::array kOrders{FrontOrder::kLayered, FrontOrder::kSmallestFirst, FrontOrder::kFirstIn,
                             FrontOrder::kRandom};

Vec2 nodeOf(const PlaneFill& fill, std::uint32_t node) {
  return {fill.points[2 * node], fill.points[2 * node + 1]};
}

/// Area by the shoelace formula: that of the first loop minus those of the others.
double areaOf(const Plane& plane) {
  double area = 0.0;
  std::size_t first = 0;
  for (const std::uint32_t count : plane.loops) {
    double twice = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t a = 2 * (first + i);
      const std::size_t b = 2 * (first + (i + 1) % count);
      twice += plane.points[a] * plane.points[b + 1] - plane.points[a + 1] * plane.points[b];
    }
    area += first == 0 ? std::fabs(0.5 * twice) : -std::fabs(0.5 * twice);
    first += count;
  }
  return area;
}

/// Expects triangles that cover the polygon once: exact orientations, areas that add up, and edges of two triangles or of the
/// boundary, which close as many loops as the polygon has.
void expectCovered(const Plane& plane, const PlaneFill& fill) {
  ASSERT_EQ(fill.status, PlaneStatus::kDone);
  double area = 0.0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  std::set<std::uint32_t> used;
  for (std::size_t t = 0; t < fill.triangles.size(); t += 3) {
    const std::array<std::uint32_t, 3> n{fill.triangles[t], fill.triangles[t + 1],
                                         fill.triangles[t + 2]};
    const Vec2 a = nodeOf(fill, n[0]);
    const Vec2 b = nodeOf(fill, n[1]);
    const Vec2 c = nodeOf(fill, n[2]);
    EXPECT_EQ(orient2d(a, b, c), 1);
    area += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(directed.emplace(n[i], n[(i + 1) % 3]).second);
      used.insert(n[i]);
    }
  }
  EXPECT_NEAR(area, areaOf(plane), 1e-9 * areaOf(plane));
  EXPECT_EQ(used.size(), fill.points.size() / 2);
  const auto border = std::ranges::count_if(
      directed, [&](const auto& edge) { return !directed.contains({edge.second, edge.first}); });
  const auto edges = static_cast<long>((directed.size() + static_cast<std::size_t>(border)) / 2);
  const auto triangles = static_cast<long>(fill.triangles.size() / 3);
  // A disc with h holes has the Euler characteristic 1 - h.
  EXPECT_EQ(static_cast<long>(used.size()) - edges + triangles,
            2 - static_cast<long>(plane.loops.size()));
}

TEST(PlaneFill, CoversRandomPolygonsWithHoles) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    Plane plane = randomPlane(seed, static_cast<int>(seed % 4));
    plane.options.order = kOrders[seed / 4 % 4];
    plane.options.seed = static_cast<std::uint32_t>(seed);
    plane.options.improve = seed % 3 != 0;
    plane.options.divide = seed % 5 != 0;
    plane.options.height = seed % 7 == 0 ? 0.6 : 1.0;
    SCOPED_TRACE(seed);
    expectCovered(plane, fillOf(plane));
  }
}

TEST(PlaneFill, CoversPolygonsOfAnyOrientationEquallyWell) {
  Plane plane = randomPlane(5, 2);
  const PlaneFill fill = fillOf(plane);
  Plane turned = plane;
  std::size_t first = 0;
  for (const std::uint32_t count : plane.loops) {
    for (std::size_t i = 0; i < count; ++i) {
      turned.points[2 * (first + i)] = plane.points[2 * (first + count - 1 - i)];
      turned.points[2 * (first + i) + 1] = plane.points[2 * (first + count - 1 - i) + 1];
    }
    first += count;
  }
  const PlaneFill other = fillOf(turned);
  expectCovered(turned, other);
  EXPECT_NEAR(static_cast<double>(other.triangles.size()),
              static_cast<double>(fill.triangles.size()),
              0.1 * static_cast<double>(fill.triangles.size()));
}

/// The triangles of a planar mesh as the positions of their corners, in thousandths.
std::multiset<std::set<std::pair<long, long>>> trianglesOf(const std::vector<double>& points,
                                                           const std::vector<std::uint32_t>& nodes,
                                                           std::size_t stride) {
  std::multiset<std::set<std::pair<long, long>>> triangles;
  for (std::size_t t = 0; t < nodes.size(); t += 3) {
    std::set<std::pair<long, long>> corners;
    for (std::size_t i = t; i < t + 3; ++i) {
      const std::size_t at = stride * nodes[i];
      corners.emplace(std::lround(1e3 * points[at]), std::lround(1e3 * points[at + 1]));
    }
    triangles.insert(corners);
  }
  return triangles;
}

TEST(PlaneFill, IsTheTriangulationOfADrawnPatch) {
  // Corners without symmetry: rounding decides nothing.
  Plane plane{{0.0, 0.0, 4.1, 0.3, 3.7, 2.9, 1.9, 2.2, 0.2, 3.3, 1.3, 1.0, 2.4, 1.1, 1.7, 1.7},
              {5, 3}};
  plane.options.size = 0.33;
  Model model;
  Patch patch;
  std::uint32_t first = 0;
  for (const std::uint32_t count : plane.loops) {
    Loop loop;
    for (std::uint32_t i = 0; i < count; ++i) {
      model.points.emplace_back(plane.points[2 * (first + i)], plane.points[2 * (first + i) + 1],
                                0.0);
      model.lines.push_back({LineType::kStraight, {first + i, first + (i + 1) % count}});
      loop.push_back({first + i, false});
    }
    patch.loops.push_back(loop);
    first += count;
  }
  model.patches.push_back(patch);
  const SurfaceMesh drawn = meshOf(model, plane.options.size);
  const PlaneFill fill = fillOf(plane);
  expectCovered(plane, fill);
  EXPECT_EQ(trianglesOf(fill.points, fill.triangles, 2),
            trianglesOf(drawn.points, drawn.triangles, 3));
}

TEST(PlaneFill, OrdersDiffer) {
  std::set<std::string> prints;
  for (const FrontOrder order : kOrders) {
    Plane plane = randomPlane(11, 1);
    plane.options.order = order;
    plane.options.size = 0.5;
    plane.options.improve = false;
    prints.insert(fingerprintOf(fillOf(plane)));
    EXPECT_EQ(fingerprintOf(fillOf(plane)), fingerprintOf(fillOf(plane)));
  }
  EXPECT_EQ(prints.size(), kOrders.size());
}

TEST(PlaneFill, OnlyTheRandomOrderHasASeed) {
  for (const FrontOrder order : kOrders) {
    Plane plane = randomPlane(11, 1);
    plane.options.order = order;
    plane.options.size = 0.5;
    const std::string first = fingerprintOf(fillOf(plane));
    plane.options.seed = 1;
    EXPECT_EQ(first == fingerprintOf(fillOf(plane)), order != FrontOrder::kRandom);
  }
}

TEST(PlaneFill, ReportsTheSegmentsThatCross) {
  // Segment 1 runs through segment 4.
  const Plane plane{{0, 0, 4, 0, 4, 3, 3, 3, 3, 4, 4.5, 1, 0, 4}, {7}, {}, {.size = 0.5}};
  const PlaneFill fill = fillOf(plane);
  EXPECT_EQ(fill.status, PlaneStatus::kCrossing);
  EXPECT_EQ(fill.culprits, (std::vector<std::uint32_t>{1, 4}));
  EXPECT_TRUE(fill.triangles.empty());
}

TEST(PlaneFill, ReportsMisplacedHoles) {
  const std::vector<double> outer{0, 0, 9, 0, 9, 9, 0, 9};
  const auto with = [&](const std::vector<double>& holes, std::vector<std::uint32_t> loops) {
    Plane plane{outer, std::move(loops), {}, {.size = 1.0}};
    plane.points.insert(plane.points.end(), holes.begin(), holes.end());
    return fillOf(plane);
  };
  const PlaneFill outside = with({1, 1, 2, 1, 1, 2, 10, 1, 11, 1, 10, 2}, {4, 3, 3});
  EXPECT_EQ(outside.status, PlaneStatus::kHoleOutside);
  EXPECT_EQ(outside.culprits, (std::vector<std::uint32_t>{2, 0}));
  const PlaneFill nested = with({4, 4, 5, 4, 4, 5, 2, 2, 8, 2, 2, 8}, {4, 3, 3});
  EXPECT_EQ(nested.status, PlaneStatus::kNestedHoles);
  EXPECT_EQ(nested.culprits, (std::vector<std::uint32_t>{1, 2}));
}

TEST(PlaneFill, StopsWhereItIsTold) {
  Plane plane = randomPlane(3, 0);
  plane.options.size = 0.5;
  plane.options.maxSteps = 10;
  const PlaneFill fill = fillOf(plane);
  EXPECT_EQ(fill.status, PlaneStatus::kStopped);
  EXPECT_LE(fill.triangles.size() / 3, 10U);
  EXPECT_GE(fill.triangles.size() / 3, 1U);
  plane.options.maxSteps = 0;
  EXPECT_TRUE(fillOf(plane).triangles.empty());
}

TEST(PlaneFill, WithoutRelaxationSomeFrontsStall) {
  int stalled = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Plane plane = randomPlane(seed, 2);
    plane.experiment.relaxation = false;
    const PlaneFill fill = fillOf(plane);
    ASSERT_TRUE(fill.status == PlaneStatus::kDone || fill.status == PlaneStatus::kStalled);
    if (fill.status == PlaneStatus::kDone) expectCovered(plane, fill);
    stalled += fill.status == PlaneStatus::kStalled ? 1 : 0;
  }
  EXPECT_GT(stalled, 0);
  EXPECT_LT(stalled, 40);
}

TEST(PlaneFill, TooManySidesAreRefusedAtOnce) {
  const Plane plane{{0, 0, 1, 0, 0, 1}, {3}, {}, {.size = 1e-9}};
  EXPECT_EQ(fillOf(plane).status, PlaneStatus::kTooManySides);
}

TEST(PlaneFill, Fingerprints) {
  std::vector<StoredPlane> planes = storedPlanes();
  ASSERT_GE(planes.size(), 10U);
  if (std::getenv("TETRAFRONT_STORE_FINGERPRINTS") != nullptr) {
    for (StoredPlane& stored : planes) stored.fingerprint = fingerprintOf(fillOf(stored.plane));
    storePlanes(planes);
    return;
  }
  for (const StoredPlane& stored : planes) {
    const PlaneFill fill = fillOf(stored.plane);
    SCOPED_TRACE(stored.name);
    expectCovered(stored.plane, fill);
    EXPECT_EQ(fingerprintOf(fill), stored.fingerprint)
        << "The triangles have changed. If that is right: npm run fingerprints";
  }
}

}  // namespace
}  // namespace tetrafront::testing
