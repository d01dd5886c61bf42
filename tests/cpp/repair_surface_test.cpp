#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "boundary/weld.h"
#include "repair/duplicate_triangles.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::testing {
namespace {

SurfaceInspection inspect(const SurfaceRepair& repair) {
  SurfaceInspector inspector(repair.points, repair.triangles);
  while (!inspector.advance(1U << 20U)) {
  }
  return inspector.result();
}

/// Repairs, and resolves intersections if nothing else suffices.
SurfaceRepair resolve(const SurfaceMesh& mesh, const RepairOptions& options = {}) {
  const SurfaceRepair result = repairSurface(mesh.points, mesh.triangles, options);
  EXPECT_EQ(result.origin.size(), result.triangles.size() / 3);
  return result;
}

/// Repairs without resolving intersections.
SurfaceRepair repair(const SurfaceMesh& mesh, RepairOptions options = {}) {
  options.resolveIntersections = false;
  return resolve(mesh, options);
}

std::map<RepairKind, int> kindsOf(const SurfaceRepair& repair) {
  std::map<RepairKind, int> kinds;
  for (const RepairChange& change : repair.changes) ++kinds[change.kind];
  return kinds;
}

/// Returns the surface with separate nodes for every triangle, as in an STL file, each moved by up to noise / 2.
SurfaceMesh soupOf(const SurfaceMesh& mesh, double noise) {
  SurfaceMesh soup;
  Random random(7);
  for (std::uint32_t h = 0; h < mesh.triangles.size(); ++h) {
    const Vec3 p = pointOf(mesh, mesh.triangles[h]);
    for (int k = 0; k < 3; ++k) soup.points.push_back(p[k] + noise * (random.unit() - 0.5));
    soup.triangles.push_back(h);
  }
  return soup;
}

void removeTriangles(SurfaceMesh& mesh, std::vector<std::size_t> which) {
  std::sort(which.rbegin(), which.rend());
  for (const std::size_t t : which) {
    const auto first = mesh.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(t);
    mesh.triangles.erase(first, first + 3);
  }
}

TEST(DuplicateTriangles, NameTheFirstOneWithTheSameNodes) {
  SurfaceMesh mesh;
  mesh.points = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  mesh.triangles = {3, 1, 2, 0, 1, 2, 1, 0, 2, 0, 1, 3, 2, 1, 0};
  const TriangleId none;
  const TriangleId first(1U);
  EXPECT_EQ(findDuplicateTriangles(mesh),
            (std::vector<TriangleId>{none, none, first, none, first}));
}

/// Sorting is sliced too, and the result does not depend on the slices.
TEST(Weld, WorksInSlices) {
  const SurfaceMesh soup = soupOf(geodesicSphere(5), 1e-7);
  const std::size_t nodes = soup.points.size() / 3;
  for (const double distance : {0.0, 1e-6, 0.2}) {
    const auto start = [&](Work& work) { return findWeldTargets(work, soup.points, distance); };
    Job whole(start);
    Job sliced(start);
    std::size_t slices = 1;
    while (!sliced.advance(1)) ++slices;
    EXPECT_GT(slices, 2 * nodes);
    EXPECT_EQ(sliced.take(), whole.finish());
  }
}

TEST(SurfaceRepair, LeavesAValidSurfaceUnchanged) {
  SurfaceMesh mesh = cubeWithSphericalCavity(3, 2);
  shuffle(mesh, 3);
  const SurfaceRepair result = repair(mesh, {.maxHoleEdges = 50});
  EXPECT_TRUE(result.changes.empty());
  EXPECT_EQ(result.points, mesh.points);
  EXPECT_EQ(result.triangles, mesh.triangles);
}

TEST(SurfaceRepair, WeldsASoup) {
  const SurfaceMesh mesh = geodesicSphere(4);
  const SurfaceRepair exact = repair(soupOf(mesh, 0.0));
  EXPECT_TRUE(inspect(exact).isFillable);
  EXPECT_EQ(exact.points.size(), mesh.points.size());
  EXPECT_EQ(kindsOf(exact)[RepairKind::kWeldedNode],
            static_cast<int>(mesh.triangles.size() - mesh.points.size() / 3));

  const SurfaceMesh noisy = soupOf(mesh, 1e-6);
  EXPECT_FALSE(inspect(repair(noisy)).isFillable);
  const SurfaceRepair welded = repair(noisy, {.weldDistance = 1e-5});
  EXPECT_TRUE(inspect(welded).isFillable);
  EXPECT_EQ(welded.points.size(), mesh.points.size());
  EXPECT_TRUE(repair(noisy, {.weldDistance = -1.0, .orient = false}).changes.empty());
}

TEST(SurfaceRepair, DoesNotCollapseChains) {
  // Each node is close to the one before; the last is far from the first.
  SurfaceMesh mesh;
  for (int i = 0; i < 10; ++i) mesh.points.insert(mesh.points.end(), {0.6 * i, 0.0, 0.0});
  mesh.points.insert(mesh.points.end(), {0.0, 9.0, 0.0});
  for (std::uint32_t i = 0; i < 9; ++i) {
    mesh.triangles.insert(mesh.triangles.end(), {i, i + 1, 10});
  }
  const SurfaceRepair result =
      repair(mesh, {.weldDistance = 1.0, .removeTriangles = false, .orient = false});
  for (const RepairChange& change : result.changes) {
    ASSERT_EQ(change.kind, RepairKind::kWeldedNode);
    EXPECT_EQ(change.second, change.first - 1);
    EXPECT_EQ(change.first % 2, 1U);
  }
  EXPECT_EQ(result.changes.size(), 5U);
}

TEST(SurfaceRepair, WeldsNodesAtExactlyTheDistance) {
  constexpr double kDistance = 0.5;
  for (const double apart : {kDistance, std::nextafter(kDistance, 1.0)}) {
    SurfaceMesh mesh;
    mesh.points = {0.0, 0.0, 0.0, apart, 0.0, 0.0, 0.0, 9.0, 0.0};
    mesh.triangles = {0, 1, 2};
    const SurfaceRepair result =
        repair(mesh, {.weldDistance = kDistance, .removeTriangles = false, .orient = false});
    EXPECT_EQ(result.changes.size(), apart == kDistance ? 1U : 0U) << apart;
  }
}

TEST(SurfaceRepair, WeldsToTheLowestKeptNodeWithinTheDistance) {
  // Nodes that are dense and sparse relative to the distance, and nodes with equal positions.
  for (const double distance : {0.0, 0.01, 0.1, 0.5}) {
    SurfaceMesh mesh;
    Random random(3);
    for (std::uint32_t i = 0; i < 1500; ++i) {
      const bool repeats = i % 5 == 4;
      for (int k = 0; k < 3; ++k) {
        mesh.points.push_back(repeats ? mesh.points[mesh.points.size() - 9] : random.unit() - 0.5);
      }
      mesh.triangles.push_back(i);
    }
    std::vector<std::uint32_t> target(nodeCount(mesh));
    for (std::uint32_t i = 0; i < target.size(); ++i) {
      target[i] = 0;
      while (target[target[i]] != target[i] ||
             glm::length(pointOf(mesh, i) - pointOf(mesh, target[i])) > distance) {
        ++target[i];
        if (target[i] == i) break;
      }
    }
    const SurfaceRepair result =
        repair(mesh, {.weldDistance = distance, .removeTriangles = false, .orient = false});
    std::vector<std::uint32_t> found(target.size());
    for (std::uint32_t i = 0; i < found.size(); ++i) found[i] = i;
    for (const RepairChange& change : result.changes) found[change.first] = change.second;
    EXPECT_EQ(found, target) << distance;
  }
}

TEST(SurfaceRepair, RemovesDegenerateAndDuplicateTriangles) {
  SurfaceMesh mesh = gridCube(2);
  const auto count = static_cast<std::uint32_t>(triangleCount(mesh));
  const std::array<std::uint32_t, 3> first{mesh.triangles[0], mesh.triangles[1], mesh.triangles[2]};
  mesh.triangles.insert(mesh.triangles.end(), {first[1], first[0], first[2]});
  mesh.triangles.insert(mesh.triangles.end(), {first[1], first[1], first[2]});
  const SurfaceRepair result = repair(mesh);
  EXPECT_TRUE(inspect(result).isFillable);
  ASSERT_EQ(result.changes.size(), 2U);
  EXPECT_EQ(result.changes[0].kind, RepairKind::kRemovedTriangle);
  EXPECT_EQ(result.changes[0].first, count + 1);
  EXPECT_EQ(result.changes[1].kind, RepairKind::kRemovedDuplicate);
  EXPECT_EQ(result.changes[1].first, count);
  EXPECT_EQ(result.changes[1].second, 0U);
}

/// Three copies of a triangle, one of them flipped: both removed ones name the first.
TEST(SurfaceRepair, NamesTheFirstOfSeveralDuplicates) {
  SurfaceMesh mesh = gridCube(1);
  const std::array<std::uint32_t, 3> first{mesh.triangles[0], mesh.triangles[1], mesh.triangles[2]};
  const auto count = static_cast<std::uint32_t>(triangleCount(mesh));
  mesh.triangles.insert(mesh.triangles.end(), {first[1], first[2], first[0]});
  mesh.triangles.insert(mesh.triangles.end(), {first[1], first[0], first[2]});
  const SurfaceRepair result = repair(mesh);
  ASSERT_EQ(result.changes.size(), 2U);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(result.changes[i].kind, RepairKind::kRemovedDuplicate);
    EXPECT_EQ(result.changes[i].first, count + i);
    EXPECT_EQ(result.changes[i].second, 0U);
  }
}

/// Splitting the triangle beyond a sliver produces a triangle that exists already.
TEST(SurfaceRepair, RemovesDuplicatesThatASplitProduces) {
  SurfaceMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0};
  mesh.triangles = {0, 2, 1, 0, 2, 3, 0, 1, 3};
  const SurfaceRepair result = repair(mesh, {.weldDistance = -1.0, .orient = false});
  ASSERT_EQ(result.changes.size(), 2U);
  EXPECT_EQ(result.changes[0].kind, RepairKind::kRemovedDuplicate);
  EXPECT_EQ(result.changes[0].first, 2U);
  EXPECT_EQ(result.changes[0].second, 1U);
  EXPECT_EQ(result.changes[1].kind, RepairKind::kSplitTriangle);
  // Both halves are parts of the triangle that was split.
  EXPECT_EQ(result.origin, (std::vector<std::uint32_t>{1, 1}));
}

TEST(SurfaceRepair, SplitsSliversWithoutChangingTheShape) {
  // Put a node on an edge of one triangle and close the gap by a sliver, at five triangles.
  SurfaceMesh mesh = gridCube(1);
  for (int i = 0; i < 5; ++i) {
    const std::size_t h = 3 * static_cast<std::size_t>(i);
    const std::uint32_t a = mesh.triangles[h];
    const std::uint32_t b = mesh.triangles[h + 1];
    const std::uint32_t c = mesh.triangles[h + 2];
    const Vec3 position = 0.5 * (pointOf(mesh, a) + pointOf(mesh, b));
    const auto middle = static_cast<std::uint32_t>(nodeCount(mesh));
    mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
    mesh.triangles[h + 1] = middle;
    mesh.triangles.insert(mesh.triangles.end(), {middle, b, c, a, b, middle});
  }
  const SurfaceRepair result = repair(mesh);
  const SurfaceInspection found = inspect(result);
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.volume, 1.0, 1e-14);
  EXPECT_NEAR(found.area, 6.0, 1e-14);
  EXPECT_GE(kindsOf(result)[RepairKind::kSplitTriangle], 1);
  EXPECT_EQ(kindsOf(result)[RepairKind::kFilledHole], 0);
}

TEST(SurfaceRepair, SplitsLongChainsOfSlivers) {
  // One face of a tetrahedron is divided along an edge, the adjacent face is not. Between them lies a fan of slivers,
  // of which only the last has a neighbour with area.
  constexpr std::uint32_t kCount = 100;
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i <= kCount; ++i) {
    mesh.points.insert(mesh.points.end(), {static_cast<double>(i), 0.0, 0.0});
  }
  constexpr std::uint32_t kUp = kCount + 1;
  constexpr std::uint32_t kAside = kCount + 2;
  mesh.points.insert(mesh.points.end(), {0.0, 0.0, 1.0, 0.0, 1.0, 0.0});
  for (std::uint32_t i = 0; i < kCount; ++i) {
    mesh.triangles.insert(mesh.triangles.end(), {i, i + 1, kUp});
    if (i > 0) mesh.triangles.insert(mesh.triangles.end(), {0, i + 1, i});
  }
  mesh.triangles.insert(mesh.triangles.end(),
                        {0, kAside, kCount, kCount, kAside, kUp, 0, kUp, kAside});
  const SurfaceRepair result = repair(mesh);
  EXPECT_EQ(kindsOf(result)[RepairKind::kSplitTriangle], static_cast<int>(kCount) - 1);
  EXPECT_EQ(result.triangles.size(), mesh.triangles.size());
  const SurfaceInspection found = inspect(result);
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.volume, kCount / 6.0, 1e-9);
}

TEST(SurfaceRepair, OrientsTrianglesOutward) {
  SurfaceMesh mesh = cubeWithSphericalCavity(3, 2);
  SurfaceMesh mixed = mesh;
  flipRandomly(mixed, 11);
  const SurfaceRepair result = repair(mixed);
  EXPECT_EQ(inspect(result).flippedTriangles, 0U);
  std::size_t differing = 0;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    if (mesh.triangles[3 * t + 1] != mixed.triangles[3 * t + 1]) ++differing;
  }
  EXPECT_EQ(result.changes.size(), differing);
  EXPECT_EQ(repair(mixed, {.orient = false}).triangles, mixed.triangles);
}

TEST(SurfaceRepair, OrientsAnOpenSurfaceConsistently) {
  SurfaceMesh mesh = gridCube(3);
  removeTriangles(mesh, {0, 20});
  flipRandomly(mesh, 5);
  const SurfaceRepair result = repair(mesh);
  EXPECT_FALSE(inspect(result).isClosed);
  // No two triangles have a half-edge in the same direction.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
  for (std::size_t h = 0; h < result.triangles.size(); ++h) {
    const std::size_t next = h % 3 == 2 ? h - 2 : h + 1;
    EXPECT_EQ(++(seen[{result.triangles[h], result.triangles[next]}]), 1);
  }
}

/// Three triangles at one edge: it is unknown which two of them should agree.
TEST(SurfaceRepair, FlipsNothingOfAnOpenSurfaceWithANonManifoldEdge) {
  SurfaceMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 1, 1, 0};
  mesh.triangles = {0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 2, 5};
  EXPECT_TRUE(repair(mesh).changes.empty());
  // Without the third triangle, two neighbours of the first are flipped.
  removeTriangles(mesh, {2});
  EXPECT_EQ(kindsOf(repair(mesh))[RepairKind::kFlippedTriangle], 2);
}

TEST(SurfaceRepair, FillsHolesUpToTheGivenNumberOfEdges) {
  SurfaceMesh mesh = gridCube(4);
  // One hole has three edges, another one four.
  removeTriangles(mesh, {0, 100, 101});
  const SurfaceRepair small = repair(mesh, {.maxHoleEdges = 3});
  EXPECT_EQ(inspect(small).openEdges, 4U);
  const SurfaceRepair both = repair(mesh, {.maxHoleEdges = 4});
  const SurfaceInspection found = inspect(both);
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.volume, 1.0, 1e-14);
  EXPECT_EQ(kindsOf(both)[RepairKind::kFilledHole], 2);
  EXPECT_EQ(std::count(both.origin.begin(), both.origin.end(), kNoOrigin), 3);
  EXPECT_EQ(found.flippedTriangles, 0U);
}

TEST(SurfaceRepair, FillsManyHolesOneByOne) {
  SurfaceMesh mesh = geodesicSphere(8);
  std::vector<std::size_t> lost;
  for (std::size_t t = 0; t < mesh.triangles.size() / 3; t += 20) lost.push_back(t);
  removeTriangles(mesh, lost);
  const RepairOptions options{
      .weldDistance = -1.0, .removeTriangles = false, .maxHoleEdges = 10, .orient = false};
  SurfaceRepairer repairer(mesh.points, mesh.triangles, options);
  std::size_t calls = 1;
  while (!repairer.advance(1)) ++calls;
  const std::size_t filled = repairer.result().changes.size();
  EXPECT_GT(filled, 50U);
  EXPECT_GT(calls, filled);
}

TEST(SurfaceRepair, FillsHolesThatShareANode) {
  // Remove two triangles of a sphere that share a node.
  const SurfaceMesh sphere = geodesicSphere(3);
  const std::uint32_t node = sphere.triangles[0];
  std::vector<std::size_t> around;
  for (std::size_t h = 0; h < sphere.triangles.size(); ++h) {
    if (sphere.triangles[h] == node) around.push_back(h / 3);
  }
  for (std::size_t i = 1; i < around.size(); ++i) {
    SurfaceMesh mesh = sphere;
    removeTriangles(mesh, {around[0], around[i]});
    const SurfaceRepair result = repair(mesh, {.maxHoleEdges = 4});
    EXPECT_TRUE(inspect(result).isFillable) << i;
    EXPECT_EQ(result.triangles.size(), sphere.triangles.size()) << i;
  }
}

TEST(SurfaceRepair, FillsALargeHoleWithTheLeastArea) {
  // The open top of a box has a rim of 32 edges; the flat lid has the least area.
  SurfaceMesh mesh = gridCube(8);
  std::vector<std::size_t> top;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    double lowest = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      lowest = std::min(lowest, pointOf(mesh, mesh.triangles[3 * t + k]).z);
    }
    if (lowest == 1.0) top.push_back(t);
  }
  removeTriangles(mesh, top);
  EXPECT_FALSE(inspect(repair(mesh, {.maxHoleEdges = 31})).isClosed);
  const SurfaceInspection found = inspect(repair(mesh, {.maxHoleEdges = 32}));
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.area, 6.0, 1e-13);
  EXPECT_NEAR(found.volume, 1.0, 1e-13);
}

/// Returns an open box with one corner of its rim raised by 0.2 and a spike on its floor. The rim has two
/// triangulations: the one of less area passes the spike at height 1, the other at height 1.1.
SurfaceMesh boxWithSpike(double height) {
  SurfaceMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 1,   1, 0, 0, 1,   0,   0,     0,
                 1, 1, 0, 1, 1, 1, 1.2, 0, 1, 1, 0.5, 0.5, height};
  mesh.triangles = {0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6,
                    3, 0, 4, 3, 4, 7, 1, 0, 8, 2, 1, 8, 3, 2, 8, 0, 3, 8};
  return mesh;
}

TEST(SurfaceRepair, FillsAHoleWithoutIntersectingTheSurface) {
  const SurfaceInspection low = inspect(repair(boxWithSpike(0.9), {.maxHoleEdges = 4}));
  EXPECT_TRUE(low.isFillable);
  EXPECT_NEAR(low.volume, 1.0 + 0.2 / 6.0 - 0.3, 1e-14);
  const SurfaceInspection high = inspect(repair(boxWithSpike(1.05), {.maxHoleEdges = 4}));
  EXPECT_TRUE(high.isFillable);
  EXPECT_NEAR(high.volume, 1.0 + 0.2 / 3.0 - 0.35, 1e-14);
}

TEST(SurfaceRepair, LeavesAHoleOpenIfEveryFillingIntersectsTheSurface) {
  const SurfaceRepair result = repair(boxWithSpike(1.15), {.maxHoleEdges = 4});
  EXPECT_EQ(inspect(result).openEdges, 4U);
  EXPECT_TRUE(result.changes.empty());
}

TEST(SurfaceRepair, RemovesUnusedNodes) {
  SurfaceMesh mesh = gridCube(1);
  mesh.points.insert(mesh.points.begin(), {9.0, 9.0, 9.0});
  for (std::uint32_t& node : mesh.triangles) ++node;
  const SurfaceRepair result = repair(mesh);
  ASSERT_EQ(result.changes.size(), 1U);
  EXPECT_EQ(result.changes[0].kind, RepairKind::kRemovedNode);
  EXPECT_EQ(result.changes[0].first, 0U);
  EXPECT_EQ(result.points, gridCube(1).points);
}

TEST(SurfaceRepair, ListsChangesInTheOrderOfTheirKinds) {
  SurfaceMesh mesh = soupOf(gridCube(2), 0.0);
  mesh.points.insert(mesh.points.end(), {9.0, 9.0, 9.0});
  mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
  mesh.triangles.insert(mesh.triangles.end(), {0, 2, 1});
  removeTriangles(mesh, {5});
  const SurfaceRepair result = repair(mesh, {.maxHoleEdges = 3});
  EXPECT_TRUE(std::ranges::is_sorted(result.changes, {}, &RepairChange::kind));
  const std::map<RepairKind, int> kinds = kindsOf(result);
  // Of the unused nodes, only the additional one is listed as removed: the others are welded.
  const std::map<RepairKind, int> expected{{RepairKind::kWeldedNode, 3 * 48 - 26},
                                           {RepairKind::kRemovedNode, 1},
                                           {RepairKind::kRemovedTriangle, 1},
                                           {RepairKind::kRemovedDuplicate, 1},
                                           {RepairKind::kFilledHole, 1}};
  EXPECT_EQ(kinds, expected);
}

TEST(SurfaceRepair, ResolvesCrossingBodies) {
  SurfaceMesh mesh = gridCube(2);
  SurfaceMesh other = gridCube(1);
  translate(other, {0.5, 0.25, 0.375});
  append(mesh, other);
  const SurfaceRepair result = resolve(mesh);
  const SurfaceInspection found = inspect(result);
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.volume, 2.0 - 0.5 * 0.75 * 0.625, 1e-14);
  // Each triangle lies in the plane of its origin.
  for (std::size_t t = 0; t < result.origin.size(); ++t) {
    ASSERT_LT(result.origin[t], triangleCount(mesh));
    const auto given = [&](std::size_t k) {
      return pointOf(mesh, mesh.triangles[3 * result.origin[t] + k]);
    };
    const Vec3 normal = glm::cross(given(1) - given(0), given(2) - given(0));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t node = 3 * std::size_t{result.triangles[3 * t + k]};
      const Vec3 p(result.points[node], result.points[node + 1], result.points[node + 2]);
      EXPECT_NEAR(glm::dot(normal, p - given(0)), 0.0, 1e-14);
    }
  }
  // Changes name the triangles that others intersect, and how many parts of each remain.
  std::map<std::uint32_t, std::uint32_t> parts;
  for (const std::uint32_t origin : result.origin) ++parts[origin];
  int resolved = 0;
  for (const RepairChange& change : result.changes) {
    if (change.kind != RepairKind::kResolvedIntersection) continue;
    EXPECT_EQ(change.second, parts[change.first]);
    ++resolved;
  }
  EXPECT_GT(resolved, 8);
}

TEST(SurfaceRepair, ResolvesDamagedSpheres) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    SurfaceMesh mesh = soupOf(geodesicSphere(4), seed % 2 == 0 ? 0.0 : 1e-5);
    SurfaceMesh other = geodesicSphere(3);
    rotateRandomly(other, seed);
    translate(other, 0.5 * random.inBox());
    append(mesh, other);
    flipRandomly(mesh, seed);
    removeTriangles(mesh, {3, 50, 100, 300});
    append(mesh, tetrahedronSurface(
                     {Vec3(0.0), Vec3(2.0, 0.1, 0.2), Vec3(0.3, 0.2, 0.1), Vec3(0.1, 0.3, 0.4)}));
    mesh.triangles.resize(mesh.triangles.size() - 9);  // a fin remains
    EXPECT_FALSE(inspect(repair(mesh)).isFillable);
    const SurfaceInspection found = inspect(resolve(mesh));
    EXPECT_TRUE(found.isFillable) << seed;
    // The volume of the union, less than that of two unit spheres and more than that of one.
    EXPECT_GT(found.volume, 0.93 * 4.18879);
    EXPECT_LT(found.volume, 2.0 * 4.18879);
  }
}

TEST(SurfaceRepair, KeepsTheOrderOfFilledHolesWhenItResolves) {
  SurfaceMesh mesh = gridCube(3);
  removeTriangles(mesh, {0, 1, 40});
  SurfaceMesh other = gridCube(1);
  translate(other, {0.5, 0.45, 0.375});
  append(mesh, other);
  const SurfaceRepair result = resolve(mesh, {.maxHoleEdges = 3});
  EXPECT_TRUE(inspect(result).isFillable);
  std::uint32_t filled = 0;
  for (const RepairChange& change : result.changes) {
    if (change.kind != RepairKind::kFilledHole) continue;
    for (std::uint32_t t = 0; t < change.second; ++t) {
      EXPECT_EQ(result.origin[change.first + t], kNoOrigin);
      ++filled;
    }
  }
  EXPECT_EQ(filled, std::count(result.origin.begin(), result.origin.end(), kNoOrigin));
  EXPECT_GT(filled, 2U);
}

TEST(SurfaceRepair, LeavesASheetAsItIs) {
  SurfaceMesh mesh;
  mesh.points = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.1};
  mesh.triangles = {0, 1, 2, 1, 3, 2};
  const SurfaceRepair result = resolve(mesh);
  EXPECT_EQ(result.triangles, mesh.triangles);
  EXPECT_TRUE(result.changes.empty());
}

/// Three crossing pairs of squares enclose a small cube, but are no body.
TEST(SurfaceRepair, LeavesCrossingSheetsAsTheyAre) {
  SurfaceMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double level : {-0.1, 0.1}) {
      const auto first = static_cast<std::uint32_t>(nodeCount(mesh));
      for (const auto& [u, v] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vec3 p(0.0);
        p[axis] = level;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.triangles.push_back(first + k);
    }
  }
  const SurfaceRepair result = resolve(mesh);
  EXPECT_EQ(result.triangles, mesh.triangles);
  EXPECT_FALSE(inspect(result).isFillable);
}

TEST(SurfaceRepair, RefusesInvalidNumbers) {
  SurfaceMesh mesh = gridCube(1);
  mesh.triangles[0] = 99;
  const SurfaceRepair result = repair(mesh);
  EXPECT_EQ(result.triangles, mesh.triangles);
  ASSERT_EQ(result.diagnostics.size(), 1U);
}

TEST(SurfaceRepair, AcceptsBadlyDamagedSurfaces) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    SurfaceMesh mesh = gridCube(2);
    for (std::uint32_t& node : mesh.triangles) {
      if (random.unit() < 0.2) node = static_cast<std::uint32_t>(random.unit() * 26.0);
    }
    const RepairOptions options{
        .weldDistance = 0.3 * random.unit(), .removeTriangles = seed % 2 == 0, .maxHoleEdges = 20};
    const SurfaceRepair once = resolve(mesh, options);
    SurfaceRepairer inSteps(mesh.points, mesh.triangles, options);
    while (!inSteps.advance(1)) {
    }
    EXPECT_EQ(inSteps.fraction(), 1.0);
    EXPECT_EQ(once.triangles, inSteps.result().triangles);
    EXPECT_EQ(once.origin, inSteps.result().origin);
    EXPECT_EQ(once.changes.size(), inSteps.result().changes.size());
    static_cast<void>(inspect(once));
  }
}

}  // namespace
}  // namespace tetrafront::testing
