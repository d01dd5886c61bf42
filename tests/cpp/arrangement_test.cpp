#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "arrangement/enclosed_surface.h"
#include "base/task.h"
#include "boundary/boundary.h"
#include "support/exact_oracle.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::testing {
namespace {

EnclosedSurface enclose(const SurfaceMesh& mesh) {
  Job job([&](Work& work) { return encloseSurface(work, mesh); });
  return std::move(job.finish().front());
}

SurfaceInspection inspectionOf(const SurfaceMesh& mesh) {
  SurfaceInspector inspector(mesh.points, mesh.triangles);
  while (!inspector.advance(1U << 20U)) {
  }
  return inspector.result();
}

SurfaceMesh unite(std::vector<SurfaceMesh> meshes) {
  SurfaceMesh all;
  for (const SurfaceMesh& mesh : meshes) append(all, mesh);
  return all;
}

SurfaceMesh moved(SurfaceMesh mesh, const Vec3& by) {
  translate(mesh, by);
  return mesh;
}

/// Expects a surface that can be meshed and whose volume is that of its region.
void expectResolved(const EnclosedSurface& result, double volume, double tolerance) {
  EXPECT_TRUE(result.isResolved);
  EXPECT_EQ(result.origin.size(), triangleCount(result.mesh));
  const SurfaceInspection found = inspectionOf(result.mesh);
  EXPECT_TRUE(found.isFillable);
  EXPECT_NEAR(found.volume, volume, tolerance);
}

/// Returns how often the triangles wind around a position, by a ray along (1, 0, 0) and exact integers. The position must
/// not be level with a node.
int windingAround(const SurfaceMesh& mesh, const Vec3& position) {
  int winding = 0;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const Vec3 a = pointOf(mesh, mesh.triangles[3 * t]);
    const Vec3 b = pointOf(mesh, mesh.triangles[3 * t + 1]);
    const Vec3 c = pointOf(mesh, mesh.triangles[3 * t + 2]);
    const Vec3 low = glm::min(a, glm::min(b, c));
    const Vec3 high = glm::max(a, glm::max(b, c));
    const bool mayMeet = position.x <= high.x && low.y <= position.y && position.y <= high.y &&
                         low.z <= position.z && position.z <= high.z;
    if (!mayMeet) continue;
    const auto seen = [](const Vec3& p) { return Vec2(p.y, p.z); };
    const Vec2 p = seen(position);
    const int ab = oracleOrient2d(seen(a), seen(b), p);
    const int bc = oracleOrient2d(seen(b), seen(c), p);
    const int ca = oracleOrient2d(seen(c), seen(a), p);
    if (ab == 0 || ab != bc || ab != ca) continue;
    // The triangle is ahead if the position is behind its plane, as seen along the ray.
    if (oracleOrient3d(a, b, c, position) == -ab) winding += ab;
  }
  return winding;
}

SurfaceMesh withoutInterfaces(const SurfaceMesh& mesh) {
  SurfaceMesh checked = mesh;
  std::vector<Diagnostic> diagnostics;
  static_cast<void>(closeBoundary(checked, BoundarySource::kGivenSurface, diagnostics));
  SurfaceMesh result;
  result.points = mesh.points;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    if (checked.isInterface(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) result.triangles.push_back(mesh.triangles[3 * t + k]);
  }
  return result;
}

/// Counts the pairs of triangles of which an edge of one passes through the inside of the other, with exact integers.
int countCrossings(const SurfaceMesh& mesh) {
  int found = 0;
  const auto corner = [&](std::size_t t, std::size_t k) {
    return pointOf(mesh, mesh.triangles[3 * t + k % 3]);
  };
  for (std::size_t s = 0; s < triangleCount(mesh); ++s) {
    for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = corner(t, k);
        const Vec3 q = corner(t, k + 1);
        const int below = oracleOrient3d(corner(s, 0), corner(s, 1), corner(s, 2), p);
        const int above = oracleOrient3d(corner(s, 0), corner(s, 1), corner(s, 2), q);
        if (below * above >= 0) continue;
        const int first = oracleOrient3d(p, q, corner(s, 0), corner(s, 1));
        const bool isThrough = first != 0 &&
                               first == oracleOrient3d(p, q, corner(s, 1), corner(s, 2)) &&
                               first == oracleOrient3d(p, q, corner(s, 2), corner(s, 0));
        found += isThrough ? 1 : 0;
      }
    }
  }
  return found;
}

/// Returns tetrahedra with small whole coordinates, so that many of their corners, edges and planes coincide.
SurfaceMesh tetrahedronSoup(Random& random) {
  SurfaceMesh soup;
  const int count = random.integer(2, 9);
  const int size = random.integer(1, 5);
  const auto any = [&] { return static_cast<double>(random.integer(-size, size)); };
  for (int i = 0; i < count;) {
    std::array<Vec3, 4> p;
    for (Vec3& corner : p) corner = {any(), any(), any()};
    if (oracleOrient3d(p[0], p[1], p[2], p[3]) == 0) continue;
    append(soup, tetrahedronSurface(p));
    ++i;
  }
  return soup;
}

/// Seeds of the random soups of a test; TETRAFRONT_SEEDS=FIRST:COUNT chooses others.
std::vector<std::uint64_t> soupSeeds() {
  unsigned long long first = 0;
  unsigned long long count = 40;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no other thread changes the environment.
  const char* chosen = std::getenv("TETRAFRONT_SEEDS");
  if (chosen != nullptr) std::sscanf(chosen, "%llu:%llu", &first, &count);
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = first; seed < first + count; ++seed) seeds.push_back(seed);
  return seeds;
}

/// Flips all triangles.
void flip(SurfaceMesh& mesh) {
  for (std::size_t h = 0; h < mesh.triangles.size(); h += 3) {
    std::swap(mesh.triangles[h], mesh.triangles[h + 1]);
  }
}

/// A body on the lattice of whole numbers: a box, or half of one, cut along a diagonal.
struct LatticeBody {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  bool isReversed = false;
  bool isPrism = false;
  SurfaceMesh mesh;

  [[nodiscard]] bool contains(const Vec3& p) const {
    double along = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = p[static_cast<int>(k)];
      if (x < low[k] || x > high[k]) return false;
      if (k < 2) along += (x - low[k]) / (high[k] - low[k]);
    }
    return !isPrism || along < 1.0;
  }
};

/// Returns a box with sides of 1 or 2 and any diagonals on its faces.
SurfaceMesh latticeBox(Random& random, LatticeBody& body) {
  SurfaceMesh mesh;
  const auto x = [&](int k, int bit) {
    const auto axis = static_cast<std::size_t>(k);
    return static_cast<double>(bit == 0 ? body.low[axis] : body.high[axis]);
  };
  for (int i = 0; i < 8; ++i) {
    mesh.points.insert(mesh.points.end(), {x(0, i & 1), x(1, (i >> 1) & 1), x(2, i >> 2)});
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    if (random.coin()) {
      mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
    } else {
      mesh.triangles.insert(mesh.triangles.end(), {b, c, d, b, d, a});
    }
  }
  return mesh;
}

/// Returns half of the box of a body: a prism along the z axis.
SurfaceMesh latticePrism(const LatticeBody& body) {
  const auto at = [](int x) { return static_cast<double>(x); };
  const auto [x0, y0, z0] = std::array{at(body.low[0]), at(body.low[1]), at(body.low[2])};
  const auto [x1, y1, z1] = std::array{at(body.high[0]), at(body.high[1]), at(body.high[2])};
  SurfaceMesh mesh;
  mesh.points = {x0, y0, z0, x1, y0, z0, x0, y1, z0, x0, y0, z1, x1, y0, z1, x0, y1, z1};
  mesh.triangles = {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5};
  return mesh;
}

/// Which bodies a soup has.
enum class Soup : std::uint8_t { kBoxesOfAnyOrientation, kBoxesAndPrisms };

/// Returns bodies of which faces, edges and nodes coincide exactly; some are there twice.
std::vector<LatticeBody> latticeSoup(Random& random, Soup kind) {
  std::vector<LatticeBody> bodies;
  const int count = random.integer(2, 7);
  while (std::ssize(bodies) < count) {
    if (!bodies.empty() && random.integer(0, 4) == 0) {
      LatticeBody copy =
          bodies[static_cast<std::size_t>(random.integer(0, static_cast<int>(bodies.size()) - 1))];
      bodies.push_back(std::move(copy));
    } else {
      LatticeBody body;
      for (std::size_t k = 0; k < 3; ++k) {
        body.low[k] = random.integer(-2, 1);
        body.high[k] = body.low[k] + random.integer(1, 2);
      }
      body.isPrism = kind == Soup::kBoxesAndPrisms && random.coin();
      body.mesh = body.isPrism ? latticePrism(body) : latticeBox(random, body);
      bodies.push_back(std::move(body));
    }
    if (kind == Soup::kBoxesOfAnyOrientation && random.coin()) {
      LatticeBody& body = bodies.back();
      body.isReversed = !body.isReversed;
      flip(body.mesh);
    }
  }
  return bodies;
}

/// Returns whether the edge from a node of the lattice along an axis is on the boundary of a box.
bool isOnBox(const LatticeBody& box, const std::array<int, 3>& node, std::size_t axis) {
  bool isOn = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int end = node[k] + (k == axis ? 1 : 0);
    if (node[k] < box.low[k] || end > box.high[k]) return false;
    isOn |= k != axis && (node[k] == box.low[k] || node[k] == box.high[k]);
  }
  return isOn;
}

/// Returns whether the boundaries of two boxes have more than points in common.
bool areJoined(const LatticeBody& a, const LatticeBody& b) {
  for (int x = -2; x <= 3; ++x) {
    for (int y = -2; y <= 3; ++y) {
      for (int z = -2; z <= 3; ++z) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (isOnBox(a, {x, y, z}, axis) && isOnBox(b, {x, y, z}, axis)) return true;
        }
      }
    }
  }
  return false;
}

/// Returns per body the first of those that it is joined with, directly or by others.
std::vector<std::size_t> componentsOf(const std::vector<LatticeBody>& bodies) {
  std::vector<std::size_t> first(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    first[i] = i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!areJoined(bodies[i], bodies[j])) continue;
      const auto [onto, from] = std::minmax({first[i], first[j]});
      std::ranges::replace(first, from, onto);
    }
  }
  return first;
}

/// Positions in both halves of every cell of the lattice, level with no node and on no diagonal.
std::vector<Vec3> positionsInCells() {
  std::vector<Vec3> positions;
  for (int x = -2; x < 3; ++x) {
    for (int y = -2; y < 3; ++y) {
      for (int z = -2; z < 3; ++z) {
        for (const double part : {0.27, 0.71})
          positions.emplace_back(x + part, y + part + 0.011, z + 0.513);
      }
    }
  }
  return positions;
}

/// Returns per position whether the bodies enclose it. In each component this is where the winding number is positive, or where it is
/// negative if it is positive nowhere. Boxes are so small that none has another one inside that it is not joined with.
std::vector<bool> enclosedBy(const std::vector<LatticeBody>& bodies,
                             const std::vector<Vec3>& positions) {
  const std::vector<std::size_t> first = componentsOf(bodies);
  std::vector<bool> isInside(positions.size(), false);
  for (std::size_t root = 0; root < bodies.size(); ++root) {
    std::vector<int> winding(positions.size(), 0);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (first[i] != root) continue;
      for (std::size_t p = 0; p < positions.size(); ++p) {
        if (bodies[i].contains(positions[p])) winding[p] += bodies[i].isReversed ? -1 : 1;
      }
    }
    const bool isAnyPositive = std::ranges::any_of(winding, [](int w) { return w > 0; });
    for (std::size_t p = 0; p < positions.size(); ++p) {
      if (isAnyPositive ? winding[p] > 0 : winding[p] < 0) isInside[p] = true;
    }
  }
  return isInside;
}

/// Returns per position whether a surface without self-intersections encloses it, by exact integers.
std::vector<bool> enclosedBy(const SurfaceMesh& mesh, const std::vector<Vec3>& positions) {
  const SurfaceMesh boundary = withoutInterfaces(mesh);
  std::vector<bool> isInside;
  for (const Vec3& position : positions) isInside.push_back(windingAround(boundary, position) > 0);
  return isInside;
}

SurfaceMesh surfaceOf(const std::vector<LatticeBody>& bodies) {
  SurfaceMesh soup;
  for (const LatticeBody& body : bodies) append(soup, body.mesh);
  return soup;
}

SurfaceMesh repaired(const SurfaceMesh& mesh, const RepairOptions& options) {
  const SurfaceRepair repair = repairSurface(mesh.points, mesh.triangles, options);
  SurfaceMesh result;
  result.points = repair.points;
  result.triangles = repair.triangles;
  return result;
}

TEST(Arrangement, LeavesASurfaceWithoutIntersectionsUnchanged) {
  const SurfaceMesh mesh = geodesicSphere(4);
  const EnclosedSurface result = enclose(mesh);
  EXPECT_TRUE(result.isResolved);
  EXPECT_EQ(result.mesh.points, mesh.points);
  EXPECT_EQ(result.mesh.triangles, mesh.triangles);
}

TEST(Arrangement, UnitesTwoCubes) {
  const EnclosedSurface result =
      enclose(unite({gridCube(1), moved(gridCube(1), {0.5, 0.25, 0.375})}));
  expectResolved(result, 2.0 - 0.5 * 0.75 * 0.625, 1e-14);
}

TEST(Arrangement, UnitesCubesWithCommonPlanes) {
  const EnclosedSurface result =
      enclose(unite({gridCube(2), moved(gridCube(3), {0.5, 0.25, 0.0})}));
  expectResolved(result, 2.0 - 0.5 * 0.75, 1e-13);
}

TEST(Arrangement, MergesACubeWithItself) {
  expectResolved(enclose(unite({gridCube(2), gridCube(2)})), 1.0, 1e-14);
  // Other triangles on the same cube.
  expectResolved(enclose(unite({gridCube(2), gridCube(3, Diagonals::kUnionJack)})), 1.0, 1e-14);
}

TEST(Arrangement, SubtractsAShellThatFacesInward) {
  SurfaceMesh tool = moved(gridCube(1), {0.5, 0.25, -0.5});
  turnInsideOut(tool);
  // The part of the tool outside the cube has winding number -1.
  const EnclosedSurface result = enclose(unite({gridCube(2), tool}));
  expectResolved(result, 1.0 - 0.5 * 0.75 * 0.5, 1e-14);
}

TEST(Arrangement, UnderstandsBodiesThatFaceInward) {
  SurfaceMesh mesh = unite({gridCube(1), moved(gridCube(1), {0.5, 0.25, 0.375})});
  turnInsideOut(mesh);
  expectResolved(enclose(mesh), 2.0 - 0.5 * 0.75 * 0.625, 1e-14);
}

TEST(Arrangement, ResolvesTJunctions) {
  // A cube whose sides have different divisions: no edge matches.
  const auto isOnTop = [](const SurfaceMesh& m, std::size_t t) {
    double lowest = 1.0;
    for (std::size_t k = 0; k < 3; ++k)
      lowest = std::min(lowest, pointOf(m, m.triangles[3 * t + k]).z);
    return lowest == 1.0;
  };
  const auto partOf = [&](const SurfaceMesh& source, bool isTop) {
    SurfaceMesh part;
    part.points = source.points;
    for (std::size_t t = 0; t < triangleCount(source); ++t) {
      if (isOnTop(source, t) != isTop) continue;
      for (std::size_t k = 0; k < 3; ++k) part.triangles.push_back(source.triangles[3 * t + k]);
    }
    return part;
  };
  const SurfaceMesh mixed = unite({partOf(gridCube(1), false), partOf(gridCube(3), true)});
  EXPECT_FALSE(inspectionOf(mixed).isClosed);
  expectResolved(enclose(mixed), 1.0, 1e-14);
}

TEST(Arrangement, LeavesOutSheets) {
  SurfaceMesh mesh = gridCube(2);
  // One sheet through the cube, one beside it, one on it.
  const auto addTriangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(nodeCount(mesh));
    for (const Vec3& p : {a, b, c}) mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
    mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2});
  };
  addTriangle({-1.0, 0.3, 0.4}, {2.0, 0.35, 0.4}, {0.5, 0.4, 3.0});
  addTriangle({5.0, 0.0, 0.0}, {6.0, 0.0, 0.0}, {5.0, 1.0, 0.0});
  addTriangle({0.5, 0.5, 1.0}, {1.5, 0.5, 1.0}, {0.5, 0.5, 2.0});
  expectResolved(enclose(mesh), 1.0, 1e-14);
}

TEST(Arrangement, KeepsAnInterfaceBetweenTouchingBodies) {
  // A small cube stands on a large one.
  SurfaceMesh small = gridCube(1);
  scale(small, 0.5);
  const EnclosedSurface result = enclose(unite({gridCube(1), moved(small, {0.25, 0.25, 1.0})}));
  expectResolved(result, 1.125, 1e-14);
  EXPECT_EQ(inspectionOf(result.mesh).regions, 2U);
}

TEST(Arrangement, UnitesRotatedSpheres) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    SurfaceMesh other = geodesicSphere(5);
    rotateRandomly(other, seed);
    const SurfaceMesh mesh = unite({geodesicSphere(6), moved(other, {1.0, 0.0, 0.0})});
    const EnclosedSurface result = enclose(mesh);
    EXPECT_TRUE(result.isResolved);
    const SurfaceInspection found = inspectionOf(result.mesh);
    EXPECT_TRUE(found.isFillable);
    // Two unit spheres at distance 1 have 27/12 pi in common or alone; the facets cut off up to 4 %.
    EXPECT_NEAR(found.volume, 2.25 * 3.141592653589793, 0.3);
    EXPECT_LT(found.volume, 2.25 * 3.141592653589793);
  }
}

/// Small rotations make thousands of nearly coplanar triangles. Their intersections lie closer together than doubles can
/// tell, so rounding makes them intersect again.
TEST(Arrangement, RoundsNearlyCoplanarCubes) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    SurfaceMesh mesh;
    for (int i = 0; i < 3; ++i) {
      SurfaceMesh cube = gridCube(random.integer(1, 3), Diagonals::kRandom, seed);
      rotateRandomly(cube, seed);
      translate(cube, std::pow(10.0, -random.integer(4, 15)) * random.inBox());
      append(mesh, cube);
    }
    const EnclosedSurface result = enclose(mesh);
    expectResolved(result, 1.0, 1e-3);
    EXPECT_LT(result.deviation, 1e-5);
  }
}

/// Exact integers decide what is inside the given tetrahedra and the result.
TEST(Arrangement, EnclosesWhatRandomTetrahedraEnclose) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const SurfaceMesh soup = tetrahedronSoup(random);
    const EnclosedSurface result = enclose(soup);
    ASSERT_TRUE(result.isResolved) << seed;
    ASSERT_TRUE(inspectionOf(result.mesh).isFillable) << seed;
    const SurfaceMesh boundary = withoutInterfaces(result.mesh);
    for (int sample = 0; sample < 8; ++sample) {
      const Vec3 position = random.inBox(4.0);
      EXPECT_EQ(windingAround(soup, position) > 0, windingAround(boundary, position) > 0) << seed;
    }
  }
}

TEST(Arrangement, EnclosesWhatBoxesOfAnyOrientationEnclose) {
  const std::vector<Vec3> positions = positionsInCells();
  for (const std::uint64_t seed : soupSeeds()) {
    Random random(seed);
    const std::vector<LatticeBody> bodies = latticeSoup(random, Soup::kBoxesOfAnyOrientation);
    const std::vector<bool> isInside = enclosedBy(bodies, positions);
    const EnclosedSurface result = enclose(surfaceOf(bodies));
    const bool isAny = std::ranges::find(isInside, true) != isInside.end();
    ASSERT_EQ(isAny ? Unresolved::kNone : Unresolved::kNothingEnclosed, result.reason) << seed;
    if (!isAny) continue;
    EXPECT_TRUE(inspectionOf(result.mesh).isFillable) << seed;
    EXPECT_EQ(enclosedBy(result.mesh, positions), isInside) << seed;
  }
}

/// A repair orients bodies that face inward, removes what is there twice, and may weld points.
TEST(Arrangement, RepairsSoupsOfBoxesAndPrisms) {
  const std::vector<Vec3> positions = positionsInCells();
  const std::array<RepairOptions, 3> all{{
      {},
      {.removeTriangles = false},
      {.weldIntersections = 1e-3},
  }};
  for (const std::uint64_t seed : soupSeeds()) {
    Random random(seed);
    const std::vector<LatticeBody> bodies = latticeSoup(random, Soup::kBoxesAndPrisms);
    const std::vector<bool> isInside = enclosedBy(bodies, positions);
    SurfaceMesh soup = surfaceOf(bodies);
    for (const RepairOptions& options : all) {
      for (int i = 0; i < 2; ++i) {
        const SurfaceMesh result = repaired(soup, options);
        EXPECT_TRUE(inspectionOf(result).isFillable) << seed;
        EXPECT_EQ(enclosedBy(result, positions), isInside) << seed;
        flip(soup);
      }
    }
  }
}

/// Bodies that share edges may face either way then; nothing outside of them is enclosed.
TEST(Arrangement, RepairsSoupsOfBoxesOfAnyOrientation) {
  const std::vector<Vec3> positions = positionsInCells();
  for (const std::uint64_t seed : soupSeeds()) {
    Random random(seed);
    std::vector<LatticeBody> bodies = latticeSoup(random, Soup::kBoxesOfAnyOrientation);
    const SurfaceMesh result = repaired(surfaceOf(bodies), {});
    EXPECT_TRUE(inspectionOf(result).isFillable) << seed;
    const std::vector<bool> isInside = enclosedBy(result, positions);
    for (LatticeBody& body : bodies) body.isReversed = false;
    const std::vector<bool> isInBodies = enclosedBy(bodies, positions);
    for (std::size_t p = 0; p < positions.size(); ++p) {
      EXPECT_TRUE(isInBodies[p] || !isInside[p]) << seed;
    }
  }
}

TEST(Arrangement, LeavesNoCrossingByExactIntegers) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Random random(1000 + seed);
    const EnclosedSurface result = enclose(tetrahedronSoup(random));
    if (triangleCount(result.mesh) > 150) continue;
    EXPECT_EQ(countCrossings(result.mesh), 0) << seed;
  }
}

TEST(Arrangement, ReturnsTheResultWithWeldedPointsFirstAndTheExactOneNext) {
  // The faces of the cubes lie 1e-4 beside each other.
  const SurfaceMesh mesh = unite({gridCube(2), moved(gridCube(2), {0.5, 1e-4, 1e-4})});
  Job job([&](Work& work) { return encloseSurface(work, mesh, 1e-3); });
  const std::vector<EnclosedSurface> results = job.finish();
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results[0].isResolved);
  EXPECT_GT(results[0].deviation, 5e-5);
  EXPECT_LE(results[0].deviation, 1e-3);
  EXPECT_EQ(results[1].mesh.points, enclose(mesh).mesh.points);
  EXPECT_EQ(results[1].mesh.triangles, enclose(mesh).mesh.triangles);
}

/// Returns the smallest height of a triangle above its longest edge.
double smallestHeight(const SurfaceMesh& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = pointOf(mesh, mesh.triangles[3 * t + k]);
    const double longest =
        std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
    smallest = std::min(smallest, glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / longest);
  }
  return smallest;
}

/// A prism above the z axis, between two heights.
SurfaceMesh prism(int sides, double radius, double low, double high) {
  SurfaceMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (const double z : {low, high}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / n;
      mesh.points.insert(mesh.points.end(),
                         {radius * std::cos(angle), radius * std::sin(angle), z});
    }
    mesh.points.insert(mesh.points.end(), {0.0, 0.0, z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    const std::uint32_t top = n + 1;
    mesh.triangles.insert(mesh.triangles.end(), {n, next, i, top + n, top + i, top + next, i, next,
                                                 top + next, i, top + next, top + i});
  }
  return mesh;
}

/// Each face of one body in one plane with a face of another, but for a rounding of its coordinate.
TEST(Arrangement, MakesFacesCoincideThatDifferByRoundings) {
  const double above = std::nextafter(13.2, 14.0);
  const SurfaceMesh mesh =
      unite({prism(24, 2.0, 10.0, 13.2), prism(31, 2.5, above, 15.0),
             moved(prism(17, 1.7, 11.0, std::nextafter(above, 14.0)), {0.3, 0.2, 0.0})});
  Job job([&](Work& work) { return encloseSurface(work, mesh, 1e-3); });
  const std::vector<EnclosedSurface> results = job.finish();
  ASSERT_EQ(results.size(), 2U);
  EXPECT_GT(smallestHeight(results[0].mesh), 1e-4);
  EXPECT_LE(results[0].deviation, 1e-3);
}

/// A rod in a hole of its own radius, divided otherwise: the overlaps and gaps are lenses as wide as the height of an arc.
TEST(Arrangement, ResolvesSolidsOfWhichCurvedFacesNearlyCoincide) {
  SurfaceMesh mesh = unite({prism(37, 1.0, 0.0, 3.0), prism(90, 1.002, 1.0, 2.0)});
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    const bool isFirst = t < 4 * std::size_t{37};
    mesh.triangleRegions.insert(mesh.triangleRegions.end(),
                                {isFirst ? 0U : 1U, SurfaceMesh::kNoRegion});
  }
  Job job([&](Work& work) { return encloseSurface(work, mesh, 1e-3); });
  const std::vector<EnclosedSurface> results = job.finish();
  ASSERT_EQ(results.size(), 2U);
  EXPECT_TRUE(results[0].isResolved);
  EXPECT_GT(smallestHeight(results[0].mesh), 1e-5);
  EXPECT_LE(results[0].deviation, 1e-3);
}

/// Crossing plates, `count` in each direction, 0.4 thick and 1 apart.
SurfaceMesh latticeOf(int count) {
  SurfaceMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < count; ++i) {
      SurfaceMesh plate = gridCube(1);
      for (std::size_t k = 0; k < plate.points.size(); ++k) {
        double& x = plate.points[k];
        x = k % 3 == axis ? i + 0.3 + 0.4 * x : count * x;
      }
      append(mesh, plate);
    }
  }
  return mesh;
}

/// A few large triangles become many.
TEST(Arrangement, UnitesALatticeOfPlates) {
  const double empty = 0.6 * 0.6 * 0.6;
  expectResolved(enclose(latticeOf(6)), 216.0 * (1.0 - empty), 1e-9);
}

TEST(Arrangement, SaysWhyASurfaceIsNotResolved) {
  SurfaceMesh sphere = geodesicSphere(5);
  rotateRandomly(sphere, 1);
  const SurfaceMesh spheres = unite({geodesicSphere(6), moved(sphere, {1.0, 0.0, 0.0})});
  const SurfaceMesh lattice = latticeOf(6);
  const auto expectReason = [](const SurfaceMesh& mesh, const EnclosingLimits& limits,
                               Unresolved reason, std::size_t limit) {
    Job job([&](Work& work) { return encloseSurface(work, mesh, 0.0, limits); });
    const EnclosedSurface result = std::move(job.finish().front());
    EXPECT_FALSE(result.isResolved);
    EXPECT_EQ(result.reason, reason);
    EXPECT_EQ(result.limit, limit);
    ASSERT_FALSE(result.where.isNone());
    EXPECT_LT(result.where.index(), triangleCount(mesh));
    EXPECT_GT(result.pairs, 0U);
  };
  expectReason(lattice, {.pairs = 100}, Unresolved::kTooManyPairs, 100);
  expectReason(lattice, {.freeTriangles = 0}, Unresolved::kTooMuchWork,
               20 * triangleCount(lattice));
  expectReason(spheres, {.rounds = 0}, Unresolved::kRounding, 0);
}

TEST(Arrangement, DoesNotDependOnSlices) {
  const SurfaceMesh mesh = unite({geodesicSphere(3), moved(gridCube(2), {0.1, 0.2, 0.3})});
  const EnclosedSurface whole = enclose(mesh);
  Job sliced([&](Work& work) { return encloseSurface(work, mesh); });
  std::size_t slices = 1;
  while (!sliced.advance(1)) ++slices;
  const EnclosedSurface result = std::move(sliced.take().front());
  EXPECT_GT(slices, 100U);
  EXPECT_EQ(result.mesh.points, whole.mesh.points);
  EXPECT_EQ(result.mesh.triangles, whole.mesh.triangles);
}

}  // namespace
}  // namespace tetrafront::testing
