/// The improvement of given meshes: what must stay is compared with the given mesh by maps of positions, validity with the
/// tests' validator, and the angles with slow formulas.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/ids.h"
#include "support/given_meshes.h"
#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/tet_grids.h"
#include "tetrafront/mesh_improvement.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

Vec3 pointAt(const std::vector<double>& points, std::uint32_t node) {
  const auto [x, y, z] = positionOf(points, node);
  return {x, y, z};
}

using Corners3 = std::array<Position, 3>;

/// The regions at each face that does not lie inside one region; one for the boundary.
std::map<Corners3, std::vector<std::uint32_t>> wallsOf(const std::vector<double>& points,
                                                       const std::vector<std::uint32_t>& tetrahedra,
                                                       const std::vector<std::uint32_t>& regions) {
  std::map<Corners3, std::vector<std::uint32_t>> faces;
  for (std::size_t t = 0; t < tetrahedra.size() / 4; ++t) {
    for (std::size_t skipped = 0; skipped < 4; ++skipped) {
      Corners3 corners;
      for (std::size_t k = 0, to = 0; k < 4; ++k) {
        if (k != skipped) corners[to++] = positionOf(points, tetrahedra[4 * t + k]);
      }
      std::ranges::sort(corners);
      faces[corners].push_back(regions.empty() ? 0 : regions[t]);
    }
  }
  for (auto& [corners, beside] : faces) std::ranges::sort(beside);
  std::erase_if(faces, [](const auto& face) {
    return face.second.size() == 2 && face.second[0] == face.second[1];
  });
  return faces;
}

std::map<std::uint32_t, double> volumesOf(const std::vector<double>& points,
                                          const std::vector<std::uint32_t>& tetrahedra,
                                          const std::vector<std::uint32_t>& regions) {
  std::map<std::uint32_t, double> volumes;
  for (std::size_t t = 0; t < tetrahedra.size() / 4; ++t) {
    const auto at = [&](std::size_t k) { return pointAt(points, tetrahedra[4 * t + k]); };
    volumes[regions.empty() ? 0 : regions[t]] +=
        std::fabs(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0))) / 6.0;
  }
  return volumes;
}

/// Returns the mesh with the nodes of its boundary first, and this boundary, for the validator.
std::string complaintAboutImproved(const MeshImprovement& made) {
  const auto walls = wallsOf(made.points, made.tetrahedra, {});
  std::set<Position> onBoundary;
  for (const auto& [corners, regions] : walls) onBoundary.insert(corners.begin(), corners.end());
  std::vector<std::uint32_t> order;
  const auto nodes = static_cast<std::uint32_t>(made.points.size() / 3);
  for (const bool isOn : {true, false}) {
    for (std::uint32_t node = 0; node < nodes; ++node) {
      if (onBoundary.contains(positionOf(made.points, node)) == isOn) order.push_back(node);
    }
  }
  std::vector<std::uint32_t> newIndex(nodes);
  VolumeMesh mesh;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    newIndex[order[i]] = i;
    const Position at = positionOf(made.points, order[i]);
    mesh.points.insert(mesh.points.end(), at.begin(), at.end());
  }
  for (const std::uint32_t node : made.tetrahedra) mesh.tetrahedra.push_back(newIndex[node]);
  mesh.regions.assign(made.regions.size(), 0);
  return complaintAbout(mesh, surfaceOf(mesh, onBoundary.size()));
}

/// Checks everything that an improvement promises.
void expectKept(const VolumeMesh& given, const MeshImprovement& made,
                double maxGrowth = ImproveOptions{}.maxGrowth) {
  EXPECT_TRUE(made.isReadable);
  EXPECT_TRUE(made.diagnostics.empty());
  EXPECT_EQ(complaintAboutImproved(made), "");
  EXPECT_EQ(wallsOf(given.points, given.tetrahedra, given.regions),
            wallsOf(made.points, made.tetrahedra, made.regions));
  const auto before = volumesOf(given.points, given.tetrahedra, given.regions);
  const auto after = volumesOf(made.points, made.tetrahedra, made.regions);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [region, volume] : before) {
    EXPECT_NEAR(after.at(region), volume, 1e-9 * volume) << region;
  }
  const SlowShapes was = slowShapesOf(given.points, given.tetrahedra);
  const SlowShapes now = slowShapesOf(made.points, made.tetrahedra);
  EXPECT_GE(now.leastAngle, was.leastAngle - 1e-6);
  EXPECT_LE(now.greatestAngle, was.greatestAngle + 1e-6);
  EXPECT_GE(now.leastRatio, was.leastRatio - 1e-6);
  EXPECT_GE(now.meanRatio, was.meanRatio - 1e-9);
  EXPECT_LE(now.shareOutside, was.shareOutside + 1e-9);
  EXPECT_NEAR(made.after.quality.minDihedral, now.leastAngle, 1e-6);
  EXPECT_NEAR(made.before.quality.minDihedral, was.leastAngle, 1e-6);
  EXPECT_NEAR(made.after.quality.minRadiusRatio, now.leastRatio, 1e-6);
  EXPECT_NEAR(made.before.quality.minRadiusRatio, was.leastRatio, 1e-6);
  EXPECT_EQ(made.before.tetrahedra, given.tetrahedra.size() / 4);
  EXPECT_LE(made.after.tetrahedra, (1.0 + maxGrowth) * made.before.tetrahedra);
  EXPECT_EQ(made.after.tetrahedra, made.tetrahedra.size() / 4);
  EXPECT_EQ(made.after.nodes, made.points.size() / 3);
  ASSERT_EQ(made.nodeOrigin.size(), made.points.size() / 3);
  for (std::uint32_t node = 0; node < made.nodeOrigin.size(); ++node) {
    if (made.nodeOrigin[node] == kNoIndex) continue;
    EXPECT_EQ(positionOf(made.points, node), positionOf(given.points, made.nodeOrigin[node]));
  }
}

TEST(MeshImprovement, MakesPoorElementsGoodAndKeepsTheBoundary) {
  const VolumeMesh given = poorMesh(geodesicSphere(6));
  // Almost all nodes inside must be added.
  constexpr double kGrowth = 9.0;
  const MeshImprovement made = improved(given, {}, {.maxGrowth = kGrowth});
  expectKept(given, made, kGrowth);
  EXPECT_TRUE(made.isImproved);
  EXPECT_LT(made.before.quality.minDihedral, 3.0);
  EXPECT_GT(made.after.quality.minDihedral, 25.0);
  EXPECT_GT(made.after.quality.meanRadiusRatio, 0.85);
  EXPECT_EQ(made.after.outOfRange, 0U);
}

TEST(MeshImprovement, IsNeverWorse) {
  const std::vector<SurfaceMesh> surfaces{
      gridCube(4),      latitudeSphere(8, 16),   thinPlate(8, 0.05),   needlePlate(2, 12, 0.2),
      gradedCube(5, 3), randomBlocks(3, 0.5, 3), torus(1, 0.3, 20, 8), screwThread(2, 10)};
  std::size_t improvements = 0;
  for (const SurfaceMesh& surface : surfaces) {
    for (const VolumeMesh& given : {meshOfFront(surface), poorMesh(surface), meshed(surface, {})}) {
      const MeshImprovement made = improved(given);
      expectKept(given, made);
      if (made.isImproved) ++improvements;
    }
  }
  EXPECT_GT(improvements, 16U);
}

/// A mesh of random kind: optimized, of the front, without inner nodes, or a grid of cubes; of one or several regions; with
/// shaken nodes; stretched, so that all its elements are poor.
VolumeMesh randomMesh(Random& random) {
  const auto surface = [&]() -> SurfaceMesh {
    switch (random.integer(0, 5)) {
      case 0:
        return gridCube(random.integer(2, 4));
      case 1:
        return geodesicSphere(random.integer(3, 5));
      case 2:
        return randomBlocks(3, 0.5, random.bits());
      case 3:
        return dividedBox({2, 1, 1}, 3);
      case 4:
        return gradedCube(4, 2);
      default:
        return thinPlate(4, 0.2);
    }
  };
  VolumeMesh mesh;
  switch (random.integer(0, 3)) {
    case 0:
      mesh = cubeOfTetrahedra(random.integer(2, 5), random.between(0.0, 0.15), random.bits());
      break;
    case 1:
      mesh = meshOfFront(surface());
      break;
    case 2:
      mesh = poorMesh(surface());
      break;
    default:
      mesh = meshed(surface(), {.innerShells = InnerShells::kRegions,
                                .optimization = random.coin() ? Optimization::kDefault
                                                              : Optimization::kThorough});
  }
  const Vec3 stretching = random.coin() ? Vec3(1.0, random.between(1.0, 4.0), 1.0) : Vec3(1.0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    mesh.points[i] *= stretching[static_cast<int>(i % 3)];
  }
  return mesh;
}

TEST(MeshImprovement, KeepsWhatItPromisesOfMeshesOfAnyKind) {
  constexpr std::array kLevels{Optimization::kFast, Optimization::kDefault,
                               Optimization::kThorough};
  constexpr std::array kGrowths{0.05, 0.3, 10.0};
  std::size_t improvements = 0;
  for (std::uint64_t seed = 1; seed <= 45; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const VolumeMesh given = randomMesh(random);
    const Optimization level = kLevels[seed % kLevels.size()];
    for (const double maxGrowth : {0.0, kGrowths[seed / 3 % kGrowths.size()]}) {
      const MeshImprovement made =
          improved(given, {}, {.optimization = level, .maxGrowth = maxGrowth});
      expectKept(given, made, maxGrowth);
      if (made.isImproved) ++improvements;
    }
  }
  EXPECT_GT(improvements, 60U);
}

TEST(MeshImprovement, AddsElementsOnlyWherePoorOnesGetBetter) {
  std::size_t improvements = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const VolumeMesh given = cubeOfTetrahedra(2, 0.1, seed);
    const MeshImprovement made = improved(given);
    expectKept(given, made);
    EXPECT_EQ(made.before.outOfRange, 0U);
    EXPECT_LE(made.after.tetrahedra, made.before.tetrahedra);
    if (made.isImproved) ++improvements;
  }
  EXPECT_GT(improvements, 10U);
}

TEST(MeshImprovement, SaysThatItsGrowthWasLimited) {
  const VolumeMesh given = poorMesh(geodesicSphere(5));
  const MeshImprovement made = improved(given);
  EXPECT_TRUE(made.isGrowthLimited);
  EXPECT_GT(made.after.outOfRange, 0U);
  EXPECT_FALSE(improved(given, {}, {.maxGrowth = 100.0}).isGrowthLimited);
}

TEST(MeshImprovement, RefusesANegativeGrowth) {
  EXPECT_FALSE(improved(cubeOfTetrahedra(1), {}, {.maxGrowth = -0.1}).isReadable);
}

TEST(MeshImprovement, KeepsInterfacesAndRegionNumbers) {
  VolumeMesh given = meshOfFront(dividedBox({2, 2, 1}, 3));
  constexpr std::uint32_t kLarge = 0xffffffffU;
  for (std::uint32_t& region : given.regions) region = region == 3 ? kLarge : 7 * region;
  const MeshImprovement made = improved(given);
  expectKept(given, made);
  EXPECT_TRUE(made.isImproved);
  const std::set<std::uint32_t> numbers(made.regions.begin(), made.regions.end());
  EXPECT_EQ(numbers, (std::set<std::uint32_t>{0, 7, 14, kLarge}));
}

/// The three positions of each triangle.
std::set<Corners3> facesAmong(const std::vector<double>& points,
                              const std::vector<std::uint32_t>& tetrahedra) {
  std::set<Corners3> faces;
  for (std::size_t t = 0; t < tetrahedra.size() / 4; ++t) {
    for (std::size_t skipped = 0; skipped < 4; ++skipped) {
      Corners3 corners;
      for (std::size_t k = 0, to = 0; k < 4; ++k) {
        if (k != skipped) corners[to++] = positionOf(points, tetrahedra[4 * t + k]);
      }
      std::ranges::sort(corners);
      faces.insert(corners);
    }
  }
  return faces;
}

TEST(MeshImprovement, KeepsTrianglesInsideARegion) {
  const VolumeMesh given = cubeOfTetrahedra(5, 0.15, 3);
  // A sheet with a rim inside the cube: interior faces around one interior node.
  std::vector<std::uint32_t> kept;
  std::set<Corners3> wanted;
  const auto walls = wallsOf(given.points, given.tetrahedra, {});
  for (std::size_t t = 0; t < given.tetrahedra.size() / 4; t += 9) {
    const auto* const nodes = &given.tetrahedra[4 * t];
    Corners3 corners{positionOf(given.points, nodes[0]), positionOf(given.points, nodes[1]),
                     positionOf(given.points, nodes[2])};
    std::ranges::sort(corners);
    if (walls.contains(corners)) continue;
    kept.insert(kept.end(), {nodes[0], nodes[1], nodes[2]});
    wanted.insert(corners);
  }
  ASSERT_GT(wanted.size(), 30U);
  const MeshImprovement made = improved(given, kept);
  expectKept(given, made);
  const std::set<Corners3> faces = facesAmong(made.points, made.tetrahedra);
  EXPECT_TRUE(std::ranges::includes(faces, wanted));
  // Without the triangles, some of these faces go.
  const MeshImprovement free = improved(given);
  EXPECT_TRUE(free.isImproved);
  EXPECT_FALSE(std::ranges::includes(facesAmong(free.points, free.tetrahedra), wanted));
}

TEST(MeshImprovement, OrientsInvertedElements) {
  VolumeMesh given = cubeOfTetrahedra(4, 0.1);
  const MeshImprovement expected = improved(given);
  for (std::size_t t = 0; t < given.tetrahedra.size() / 4; t += 3) {
    std::swap(given.tetrahedra[4 * t + 2], given.tetrahedra[4 * t + 3]);
  }
  const MeshImprovement made = improved(given);
  EXPECT_EQ(made.orientedTetrahedra, (given.tetrahedra.size() / 4 + 2) / 3);
  EXPECT_EQ(made.tetrahedra, expected.tetrahedra);
  EXPECT_EQ(made.points, expected.points);
}

TEST(MeshImprovement, ReturnsTheGivenMeshIfNothingIsBetter) {
  VolumeMesh given;
  given.points = {0, 0, 0, 9, 9, 9, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  given.tetrahedra = {0, 2, 3, 4};
  const MeshImprovement made = improved(given);
  EXPECT_FALSE(made.isImproved);
  expectKept(given, made);
  EXPECT_EQ(made.tetrahedra, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(made.nodeOrigin, (std::vector<std::uint32_t>{0, 2, 3, 4}));
}

/// Changes one element, node or region of the mesh.
void damage(VolumeMesh& mesh, Random& random) {
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.bits() % count);
  };
  const std::size_t elements = mesh.tetrahedra.size() / 4;
  const std::size_t element = 4 * below(elements);
  const auto corner = static_cast<std::ptrdiff_t>(element);
  switch (below(6)) {
    case 0:  // another node
      mesh.tetrahedra[element + below(4)] =
          static_cast<std::uint32_t>(below(mesh.points.size() / 3));
      return;
    case 1:  // the same element twice
      for (std::size_t k = 0; k < 4; ++k) mesh.tetrahedra.push_back(mesh.tetrahedra[element + k]);
      mesh.regions.push_back(mesh.regions[element / 4]);
      return;
    case 2:  // a hole
      mesh.tetrahedra.erase(mesh.tetrahedra.begin() + corner, mesh.tetrahedra.begin() + corner + 4);
      mesh.regions.erase(mesh.regions.begin() + corner / 4);
      return;
    case 3:  // another region
      mesh.regions[element / 4] = static_cast<std::uint32_t>(below(3));
      return;
    case 4:  // inverted
      std::swap(mesh.tetrahedra[element], mesh.tetrahedra[element + 1]);
      return;
    default:  // a moved node
      for (std::size_t k = 0; k < 3; ++k) {
        mesh.points[3 * mesh.tetrahedra[element] + k] += 0.2 * (random.unit() - 0.5);
      }
  }
}

TEST(MeshImprovement, RefusesDamagedMeshesOrKeepsTheirBoundary) {
  const VolumeMesh whole = meshOfFront(gridCube(3));
  std::size_t refused = 0;
  std::size_t improvements = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    Random random(seed);
    VolumeMesh mesh = whole;
    for (std::size_t i = 0; i <= seed % 4; ++i) damage(mesh, random);
    const MeshImprovement made = improved(mesh);
    ASSERT_TRUE(made.isReadable) << seed;
    if (!made.diagnostics.empty()) {
      EXPECT_NE(made.diagnostics[0].code, DiagnosticCode::kVerificationFailed) << seed;
      ++refused;
      continue;
    }
    if (made.isImproved) ++improvements;
    EXPECT_EQ(wallsOf(mesh.points, mesh.tetrahedra, mesh.regions),
              wallsOf(made.points, made.tetrahedra, made.regions))
        << seed;
    EXPECT_EQ(complaintAboutImproved(made), "") << seed;
  }
  EXPECT_GT(refused, 30U);
  EXPECT_GT(improvements, 30U);
}

TEST(MeshImprovement, IsTheSameInSlicesOfAnySize) {
  const VolumeMesh given = poorMesh(gridCube(3));
  const MeshImprovement whole = improved(given);
  for (const std::uint32_t budget : {1U, 37U, 1000U}) {
    MeshImprover improver(given.points, given.tetrahedra, given.regions, {}, {});
    slicesOf(improver, budget);
    EXPECT_EQ(improver.result().points, whole.points);
    EXPECT_EQ(improver.result().tetrahedra, whole.tetrahedra);
  }
}

TEST(MeshImprovement, ReturnsAValidMeshWheneverItIsStopped) {
  const VolumeMesh given = poorMesh(geodesicSphere(4));
  std::size_t improvements = 0;
  for (const int slices : {0, 5, 60, 100, 150, 200}) {
    MeshImprover improver(given.points, given.tetrahedra, given.regions, {}, {});
    for (int i = 0; i < slices; ++i) improver.advance(200);
    improver.stop();
    while (!improver.advance(200)) {
    }
    expectKept(given, improver.result());
    EXPECT_TRUE(improver.result().isPartial);
    if (improver.result().isImproved) ++improvements;
  }
  EXPECT_GT(improvements, 0U);
}

}  // namespace
}  // namespace tetrafront::testing
