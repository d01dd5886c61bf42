/// Repairs of surfaces whose regions share volumes.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/ids.h"
#include "geom/measure.h"
#include "support/random.h"
#include "support/shape_building.h"
#include "support/shapes.h"
#include "tetrafront/surface_tools.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

/// Returns the surfaces in one, each the boundary of a region.
SurfaceMesh regionsOf(const std::vector<SurfaceMesh>& solids) {
  SurfaceMesh all;
  std::uint32_t region = 0;
  for (const SurfaceMesh& solid : solids) {
    append(all, solid);
    for (std::size_t t = 0; t < triangleCount(solid); ++t) {
      all.triangleRegions.insert(all.triangleRegions.end(), {region, SurfaceMesh::kNoRegion});
    }
    ++region;
  }
  return all;
}

SurfaceMesh box(const Vec3& low, const Vec3& high) { return gridBox(low, high, {1, 1, 1}); }

struct Regions {
  SurfaceRepair repair;
  SurfaceMesh surface;
  std::vector<double> volumes;
};

Regions repairRegions(const SurfaceMesh& given, double weld = 0.0) {
  RepairOptions options;
  options.weldIntersections = weld;
  Regions made;
  made.repair = repairSurface(given.points, given.triangles, options, given.triangleRegions);
  made.surface.points = made.repair.points;
  made.surface.triangles = made.repair.triangles;
  made.surface.triangleRegions = made.repair.triangleRegions;
  made.volumes = regionVolumes(made.surface);
  return made;
}

/// Expects that the surface can be meshed with its regions, and that triangles come from the given ones.
void expectFillable(const Regions& made, const SurfaceMesh& given) {
  SurfaceInspector inspector(made.surface.points, made.surface.triangles, {},
                             made.surface.triangleRegions);
  while (!inspector.advance(1U << 20U)) {
  }
  const SurfaceInspection& found = inspector.result();
  EXPECT_TRUE(found.isFillable);
  EXPECT_EQ(found.flippedTriangles, 0U);
  ASSERT_EQ(made.repair.origin.size(), triangleCount(made.surface));
  ASSERT_EQ(made.surface.triangleRegions.size(), 2 * triangleCount(made.surface));
  for (const std::uint32_t from : made.repair.origin) EXPECT_LT(from, triangleCount(given));
}

TEST(RepairedRegions, BoxesThatInterfereKeepTheirRegions) {
  for (const double depth : {0.25, 1e-2, 1e-4, 1e-6, 0x1p-50}) {
    SCOPED_TRACE(depth);
    const SurfaceMesh given =
        regionsOf({box({0, 0, 0}, {1, 1, 1}), box({1 - depth, 0.25, 0.25}, {2, 0.75, 0.5})});
    const Regions made = repairRegions(given);
    expectFillable(made, given);
    ASSERT_EQ(made.volumes.size(), 2U);
    EXPECT_NEAR(made.volumes[0], 1.0, 1e-14);
    EXPECT_NEAR(made.volumes[1], 0.125, 1e-14);
    ASSERT_EQ(made.repair.sharedVolumes.size(), 1U);
    const SharedVolume& shared = made.repair.sharedVolumes[0];
    EXPECT_EQ(shared.first, 0U);
    EXPECT_EQ(shared.second, 1U);
    EXPECT_NEAR(shared.volume, 0.125 * depth, 1e-15);
    // 2 V / A of a box of depth x 1/2 x 1/4.
    EXPECT_NEAR(shared.depth, 0.25 * depth / (0.25 + 1.5 * depth), 1e-15);
    EXPECT_NEAR(shared.position.x, 1.0 - 0.5 * depth, 0.51 * depth);
  }
}

TEST(RepairedRegions, BoxesThatShareALayerOfTheirSectionKeepTheirRegions) {
  for (const double depth : {0.25, 1e-2, 1e-4, 1e-6}) {
    SCOPED_TRACE(depth);
    const SurfaceMesh given =
        regionsOf({box({0, 0, 0}, {1, 1, 1}), box({1 - depth, 0, 0}, {2, 1, 1})});
    const Regions made = repairRegions(given);
    expectFillable(made, given);
    ASSERT_EQ(made.volumes.size(), 2U);
    EXPECT_NEAR(made.volumes[0], 1.0, 1e-14);
    EXPECT_NEAR(made.volumes[1], 1.0, 1e-14);
  }
}

/// Holes of one body are closed with its region, whether the repair fills them or closes them only to find what is enclosed.
TEST(RepairedRegions, ABodyWithAHoleKeepsItsRegion) {
  const SurfaceMesh closed =
      regionsOf({gridBox({0, 0, 0}, {1, 1, 1}, {4, 4, 4}), box({0.75, 0.25, 0.25}, {2, 0.75, 0.5}),
                 box({0, 2, 0}, {1, 3, 1})});
  for (const std::uint32_t maxHoleEdges : {0U, 20U}) {
    for (const std::size_t removed : {std::size_t{0}, triangleCount(closed) - 1}) {
      SCOPED_TRACE(removed);
      SurfaceMesh given = closed;
      const auto at = static_cast<std::ptrdiff_t>(removed);
      given.triangles.erase(given.triangles.begin() + 3 * at, given.triangles.begin() + 3 * at + 3);
      given.triangleRegions.erase(given.triangleRegions.begin() + 2 * at,
                                  given.triangleRegions.begin() + 2 * at + 2);
      const SurfaceRepair repair = repairSurface(
          given.points, given.triangles, {.maxHoleEdges = maxHoleEdges}, given.triangleRegions);
      SurfaceMesh made;
      made.points = repair.points;
      made.triangles = repair.triangles;
      made.triangleRegions = repair.triangleRegions;
      ASSERT_EQ(made.triangleRegions.size(), 2 * triangleCount(made));
      const std::vector<double> volumes = regionVolumes(made);
      ASSERT_EQ(volumes.size(), 3U);
      EXPECT_NEAR(volumes[0], 1.0, 1e-14);
      EXPECT_NEAR(volumes[1], 0.125, 1e-14);
      EXPECT_NEAR(volumes[2], 1.0, 1e-14);
      const auto isFilled = [](const RepairChange& change) {
        return change.kind == RepairKind::kFilledHole;
      };
      EXPECT_EQ(std::ranges::count_if(repair.changes, isFilled), 1);
    }
  }
}

/// A weld makes thin steps disappear, and keeps the regions.
TEST(RepairedRegions, AWeldKeepsTheRegions) {
  const SurfaceMesh given =
      regionsOf({box({0, 0, 0}, {1, 1, 1}), box({1 - 1e-4, 0, 0}, {2, 1, 1})});
  const Regions made = repairRegions(given, 1e-3);
  expectFillable(made, given);
  ASSERT_EQ(made.volumes.size(), 2U);
  EXPECT_NEAR(made.volumes[0], 1.0, 1e-3);
  EXPECT_NEAR(made.volumes[1], 1.0, 1e-3);
  EXPECT_EQ(made.repair.sharedVolumes.size(), 1U);
}

/// Returns the length of the shortest edge.
double shortestEdge(const SurfaceMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const std::array<Vec3, 3> p = cornersOf(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      shortest = std::min(shortest, glm::length(p[(k + 1) % 3] - p[k]));
    }
  }
  return shortest;
}

/// Returns the largest distance of points spread over the triangles of a surface from another surface.
double sampledDistance(const SurfaceMesh& from, const SurfaceMesh& to) {
  constexpr int kSteps = 8;
  double largest = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(from))) {
    const std::array<Vec3, 3> p = cornersOf(from, t);
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const Vec3 position =
            p[0] + (p[1] - p[0]) * (1.0 * i / kSteps) + (p[2] - p[0]) * (1.0 * j / kSteps);
        double nearest = std::numeric_limits<double>::infinity();
        for (const TriangleId other : IdRange<TriangleId>(countTriangles(to))) {
          const auto [a, b, c] = cornersOf(to, other);
          nearest =
              std::min(nearest, glm::length(nearestPointOfTriangle(position, a, b, c) - position));
        }
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

/// A step of 1e-4 disappears by a weld of 0.01 or a quarter of it, but a plate of 0.008 would by the first one.
TEST(RepairedRegions, AQuarterOfTheWeldIsTriedIfAllOfItChangesTheVolume) {
  const std::vector<SurfaceMesh> cubes{box({0, 0, 0}, {1, 1, 1}), box({1 - 1e-4, 0, 0}, {2, 1, 1})};
  std::vector<SurfaceMesh> withPlate = cubes;
  withPlate.push_back(box({-1, 0.25, 0.5}, {0.5, 0.75, 0.508}));
  const auto volumeOf = [](const Regions& made) {
    return std::accumulate(made.volumes.begin(), made.volumes.end(), 0.0);
  };
  constexpr double kWeld = 0.01;
  for (const std::vector<SurfaceMesh>& solids : {cubes, withPlate}) {
    const SurfaceMesh given = regionsOf(solids);
    const Regions exact = repairRegions(given);
    const Regions welded = repairRegions(given, kWeld);
    expectFillable(welded, given);
    const bool hasPlate = solids.size() > 2;
    EXPECT_LT(shortestEdge(exact.surface), 2e-4);
    EXPECT_GT(shortestEdge(welded.surface), 1e-3);
    EXPECT_EQ(welded.volumes.size(), solids.size());
    EXPECT_NEAR(volumeOf(welded), volumeOf(exact), 1e-3 * volumeOf(exact));
    EXPECT_LT(welded.repair.deviation, hasPlate ? 2.0 * kWeld / 4.0 : 2.0 * kWeld);
    EXPECT_LE(sampledDistance(welded.surface, given), welded.repair.deviation + 1e-12);
    EXPECT_LE(sampledDistance(exact.surface, welded.surface), welded.repair.deviation + 1e-12);
  }
}

TEST(RepairedRegions, WhatSharesNothingIsRepairedAsWithoutRegions) {
  const SurfaceMesh given =
      regionsOf({box({0, 0, 0}, {1, 1, 1}), box({1, 0.25, 0.25}, {2, 0.75, 0.5})});
  const Regions made = repairRegions(given);
  const SurfaceRepair plain = repairSurface(given.points, given.triangles, {});
  EXPECT_TRUE(made.repair.triangleRegions.empty());
  EXPECT_TRUE(made.repair.sharedVolumes.empty());
  EXPECT_EQ(made.repair.points, plain.points);
  EXPECT_EQ(made.repair.triangles, plain.triangles);
  EXPECT_EQ(made.repair.origin, plain.origin);
  EXPECT_EQ(made.repair.changes.size(), plain.changes.size());
}

/// The second body lies wholly inside the first one, and touches neither it nor the third one.
TEST(RepairedRegions, WhatLiesInsideAnotherRegionStays) {
  const SurfaceMesh given =
      regionsOf({box({0, 0, 0}, {1, 1, 1}), box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}),
                 box({0.75, 0.5, 0.5}, {1.5, 0.75, 0.75})});
  const Regions made = repairRegions(given);
  expectFillable(made, given);
  ASSERT_EQ(made.volumes.size(), 3U);
  EXPECT_DOUBLE_EQ(made.volumes[0], 63.0 / 64);
  EXPECT_DOUBLE_EQ(made.volumes[1], 1.0 / 64);
  EXPECT_DOUBLE_EQ(made.volumes[2], 1.0 / 32);
  ASSERT_EQ(made.repair.sharedVolumes.size(), 2U);
  const auto isInside = [](const SharedVolume& shared) { return shared.isNested; };
  const auto inner = std::ranges::find_if(made.repair.sharedVolumes, isInside);
  ASSERT_NE(inner, made.repair.sharedVolumes.end());
  EXPECT_EQ(inner->first, 1U);
  EXPECT_EQ(inner->second, 0U);
  for (const SharedVolume& shared : made.repair.sharedVolumes) {
    EXPECT_DOUBLE_EQ(shared.volume, 1.0 / 64);
  }
}

/// The first body has a void, which stays one, with a body in it, and one inside that; the last one overlaps the first.
TEST(RepairedRegions, AVoidStaysEmptyAroundWhatLiesInIt) {
  const std::vector<SurfaceMesh> solids{box({0, 0, 0}, {8, 8, 8}), box({2, 2, 2}, {5, 5, 5}),
                                        box({3, 3, 3}, {4, 4, 4}), box({7, 1, 1}, {9, 3, 3})};
  SurfaceMesh given = regionsOf(solids);
  SurfaceMesh around = box({1, 1, 1}, {6, 6, 6});
  turnInsideOut(around);
  append(given, around);
  for (std::size_t t = 0; t < triangleCount(around); ++t) {
    given.triangleRegions.insert(given.triangleRegions.end(), {0U, SurfaceMesh::kNoRegion});
  }
  const Regions made = repairRegions(given);
  expectFillable(made, given);
  ASSERT_EQ(made.volumes.size(), 4U);
  EXPECT_NEAR(made.volumes[0], 512.0 - 125.0, 1e-12);
  EXPECT_NEAR(made.volumes[1], 27.0 - 1.0, 1e-12);
  EXPECT_NEAR(made.volumes[2], 1.0, 1e-12);
  EXPECT_NEAR(made.volumes[3], 4.0, 1e-12);
}

/// A lower region inside another one keeps its volume.
TEST(RepairedRegions, ALowerRegionInsideAnotherStays) {
  const SurfaceMesh given =
      regionsOf({box({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5}), box({0, 0, 0}, {1, 1, 1}),
                 box({0.75, 0.5, 0.5}, {1.5, 0.75, 0.75})});
  const Regions made = repairRegions(given);
  expectFillable(made, given);
  ASSERT_EQ(made.volumes.size(), 3U);
  EXPECT_DOUBLE_EQ(made.volumes[0], 1.0 / 64);
  EXPECT_DOUBLE_EQ(made.volumes[1], 63.0 / 64);
  EXPECT_DOUBLE_EQ(made.volumes[2], 1.0 / 32);
}

/// Boxes on a coarse grid, with common planes and edges, inside one another, and equal ones: the cells of the grid say which
/// region each volume belongs to: of the boxes around it that contain no other such box, the lowest one.
TEST(RepairedRegions, RandomBoxesGetTheCellsOfTheInnermost) {
  constexpr int kCells = 4;
  Random random(11);
  int resolved = 0;
  for (int trial = 0; trial < 120; ++trial) {
    SCOPED_TRACE(trial);
    struct Range {
      std::array<int, 3> low;
      std::array<int, 3> high;
      bool operator==(const Range&) const = default;
    };
    std::vector<Range> ranges;
    std::vector<SurfaceMesh> boxes;
    const int count = 2 + trial % 3;
    for (int i = 0; i < count; ++i) {
      Range range{};
      Vec3 low(0.0);
      Vec3 high(0.0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(random.between(0.0, kCells));
        const int b = static_cast<int>(random.between(0.0, kCells));
        range.low[axis] = std::min(a, b);
        range.high[axis] = std::max(a, b) + 1;
        low[static_cast<int>(axis)] = range.low[axis];
        high[static_cast<int>(axis)] = range.high[axis];
      }
      ranges.push_back(range);
      boxes.push_back(box(low, high));
    }
    std::vector<double> expected(ranges.size(), 0.0);
    std::vector<double> shared(ranges.size() * ranges.size(), 0.0);
    for (int cell = 0; cell < kCells * kCells * kCells; ++cell) {
      const std::array<int, 3> at{cell % kCells, cell / kCells % kCells, cell / kCells / kCells};
      std::vector<std::size_t> around;
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        bool isInside = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          isInside = isInside && ranges[i].low[axis] <= at[axis] && at[axis] < ranges[i].high[axis];
        }
        if (isInside) around.push_back(i);
      }
      const auto contains = [&](std::size_t outer, std::size_t inner) {
        return ranges[outer] != ranges[inner] &&
               std::ranges::all_of(std::array{0U, 1U, 2U}, [&](std::size_t axis) {
                 return ranges[outer].low[axis] <= ranges[inner].low[axis] &&
                        ranges[inner].high[axis] <= ranges[outer].high[axis];
               });
      };
      const auto owner = std::ranges::find_if(around, [&](std::size_t outer) {
        return std::ranges::none_of(around,
                                    [&](std::size_t inner) { return contains(outer, inner); });
      });
      if (owner == around.end()) continue;
      expected[*owner] += 1.0;
      for (const std::size_t other : around) {
        if (other != *owner) shared[*owner * ranges.size() + other] += 1.0;
      }
    }
    const SurfaceMesh given = regionsOf(boxes);
    Regions made = repairRegions(given);
    if (made.repair.triangleRegions.empty()) continue;
    ++resolved;
    expectFillable(made, given);
    made.volumes.resize(ranges.size(), 0.0);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      EXPECT_NEAR(made.volumes[i], expected[i], 1e-12) << i;
    }
    double told = 0.0;
    for (const SharedVolume& pair : made.repair.sharedVolumes) {
      EXPECT_NEAR(pair.volume, shared[pair.first * ranges.size() + pair.second], 1e-12);
      told += pair.volume;
    }
    double all = 0.0;
    for (const double volume : shared) all += volume;
    EXPECT_NEAR(told, all, 1e-12);
  }
  EXPECT_GT(resolved, 72);
}

/// Returns the angle of corner k of a polygon with n corners.
double angleOf(int k, int n, double turn) { return turn + 2.0 * std::numbers::pi * k / n; }

/// A tube with n sides, from z = low to high; a full cylinder if `inner` is 0.
SurfaceMesh tube(int n, double inner, double outer, double low, double high, double turn) {
  SurfaceMesh mesh;
  const auto ring = [&](double radius, double z) {
    const auto first = static_cast<std::uint32_t>(nodeCount(mesh));
    for (int k = 0; k < n; ++k) {
      const double angle = angleOf(k, n, turn);
      addPoint(mesh, {radius * std::cos(angle), radius * std::sin(angle), z});
    }
    return first;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    for (int k = 0; k < n; ++k) {
      const auto here = static_cast<std::uint32_t>(k);
      const auto next = static_cast<std::uint32_t>((k + 1) % n);
      addSquare(mesh, {a + here, a + next, b + next, b + here}, false);
    }
  };
  const std::uint32_t outerLow = ring(outer, low);
  const std::uint32_t outerHigh = ring(outer, high);
  join(outerLow, outerHigh);
  if (inner > 0.0) {
    const std::uint32_t innerLow = ring(inner, low);
    const std::uint32_t innerHigh = ring(inner, high);
    join(outerHigh, innerHigh);
    join(innerHigh, innerLow);
    join(innerLow, outerLow);
    return mesh;
  }
  for (int k = 1; k + 1 < n; ++k) {
    const auto here = static_cast<std::uint32_t>(k);
    addTriangle(mesh, outerHigh, outerHigh + here, outerHigh + here + 1);
    addTriangle(mesh, outerLow, outerLow + here + 1, outerLow + here);
  }
  return mesh;
}

/// A pin in its hole, with sides turned by an angle: gaps and shared slivers alternate.
TEST(RepairedRegions, APinInAHoleWithATurnedSeamKeepsItsRegion) {
  constexpr int kSides = 48;
  const double polygon = 0.5 * kSides * std::sin(2.0 * std::numbers::pi / kSides);
  for (const double turn : {0.03, 0.3}) {
    SCOPED_TRACE(turn);
    const SurfaceMesh given =
        regionsOf({tube(kSides, 1.0, 2.0, 0.0, 1.0, 0.0), tube(kSides, 0.0, 1.0, -0.5, 1.5, turn)});
    const Regions made = repairRegions(given);
    expectFillable(made, given);
    ASSERT_EQ(made.volumes.size(), 2U);
    EXPECT_NEAR(made.volumes[0], 3.0 * polygon, 1e-9);
    EXPECT_NEAR(made.volumes[1] + made.repair.sharedVolumes[0].volume, 2.0 * polygon, 1e-9);
    EXPECT_LT(made.repair.sharedVolumes[0].depth, 1.0 - std::cos(std::numbers::pi / kSides));
  }
}

}  // namespace
}  // namespace tetrafront::testing
