/// Splitting a surface into patches at its sharp edges, and their order by position.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront {
namespace {

PatchSplit splitSurface(const SurfaceMesh& surface, std::vector<std::uint32_t> groups = {},
                        double angle = kPatchAngle) {
  PatchSplitter splitter(surface.points, surface.triangles, groups, angle);
  while (!splitter.advance(1)) {
  }
  return splitter.result();
}

/// Adds a quadrilateral a b c d as two triangles.
void addSquare(SurfaceMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
               std::uint32_t d) {
  for (const std::uint32_t node : {a, b, c, a, c, d}) mesh.triangles.push_back(node);
}

/// A cylinder around the z axis, with a fan of triangles at each end.
SurfaceMesh cylinderOf(std::uint32_t sectors) {
  SurfaceMesh mesh;
  for (const double z : {0.0, 2.0}) {
    for (std::uint32_t i = 0; i < sectors; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sectors;
      mesh.points.insert(mesh.points.end(), {std::cos(angle), std::sin(angle), z});
    }
  }
  for (std::uint32_t i = 0; i < sectors; ++i) {
    const std::uint32_t next = (i + 1) % sectors;
    addSquare(mesh, i, next, sectors + next, sectors + i);
    if (i == 0 || next == 0) continue;
    mesh.triangles.insert(mesh.triangles.end(), {0, next, i, sectors, sectors + i, sectors + next});
  }
  return mesh;
}

Vec3 centroidOfTriangle(const SurfaceMesh& mesh, std::size_t t) {
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double* at = &mesh.points[3 * std::size_t{mesh.triangles[3 * t + k]}];
    sum += Vec3(at[0], at[1], at[2]);
  }
  return sum / 3.0;
}

/// The mean of the centroids of the triangles of each patch.
std::vector<Vec3> patchCentroids(const SurfaceMesh& mesh, const PatchSplit& split) {
  std::vector<Vec3> sums(split.patchGroup.size(), Vec3(0.0));
  std::vector<double> counts(sums.size(), 0.0);
  for (std::size_t t = 0; t < split.trianglePatch.size(); ++t) {
    sums[split.trianglePatch[t]] += centroidOfTriangle(mesh, t);
    counts[split.trianglePatch[t]] += 1.0;
  }
  for (std::size_t p = 0; p < sums.size(); ++p) sums[p] /= counts[p];
  return sums;
}

void expectNear(const Vec3& a, const Vec3& b) { EXPECT_LT(glm::length(a - b), 1e-9); }

/// Returns the surface with its triangles, their corners and its nodes in another order.
SurfaceMesh shuffledCopy(const SurfaceMesh& mesh, std::uint64_t seed,
                         std::vector<std::uint32_t>& triangleOrder) {
  testing::Random random(seed);
  const auto shuffle = [&](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) {
      std::swap(order[i - 1],
                order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    }
    return order;
  };
  const std::vector<std::uint32_t> nodeAt = shuffle(mesh.points.size() / 3);
  triangleOrder = shuffle(mesh.triangles.size() / 3);
  SurfaceMesh copy;
  copy.points.resize(mesh.points.size());
  for (std::size_t i = 0; i < nodeAt.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      copy.points[3 * std::size_t{nodeAt[i]} + k] = mesh.points[3 * i + k];
    }
  }
  for (const std::uint32_t t : triangleOrder) {
    for (std::size_t k = 0; k < 3; ++k) {
      copy.triangles.push_back(nodeAt[mesh.triangles[3 * std::size_t{t} + (k + t) % 3]]);
    }
  }
  return copy;
}

TEST(PatchSplitting, ACubeHasSixPatchesFromTheBottomUp) {
  const std::array<Vec3, 6> centroids{Vec3(0.5, 0.5, 0.0), Vec3(0.5, 0.0, 0.5),
                                      Vec3(0.0, 0.5, 0.5), Vec3(1.0, 0.5, 0.5),
                                      Vec3(0.5, 1.0, 0.5), Vec3(0.5, 0.5, 1.0)};
  for (const int n : {1, 2, 5}) {
    const SurfaceMesh cube = testing::gridCube(n);
    const PatchSplit split = splitSurface(cube);
    ASSERT_EQ(split.patchGroup, std::vector<std::uint32_t>(6, 0)) << n;
    const std::vector<Vec3> found = patchCentroids(cube, split);
    for (std::size_t p = 0; p < 6; ++p) expectNear(found[p], centroids[p]);
  }
}

TEST(PatchSplitting, ACylinderHasThreePatches) {
  for (const std::uint32_t sectors : {12U, 50U}) {
    const SurfaceMesh cylinder = cylinderOf(sectors);
    const PatchSplit split = splitSurface(cylinder);
    ASSERT_EQ(split.patchGroup.size(), 3U);
    const std::vector<Vec3> found = patchCentroids(cylinder, split);
    EXPECT_NEAR(found[0].z, 0.0, 1e-12);
    EXPECT_NEAR(found[1].z, 1.0, 1e-12);
    EXPECT_NEAR(found[2].z, 2.0, 1e-12);
  }
}

TEST(PatchSplitting, TheAngleDecides) {
  // Neighbouring squares of an octagonal prism form 45 degrees.
  EXPECT_EQ(splitSurface(cylinderOf(8), {}, 40.0).patchGroup.size(), 10U);
  EXPECT_EQ(splitSurface(cylinderOf(8), {}, 50.0).patchGroup.size(), 3U);
  EXPECT_EQ(splitSurface(cylinderOf(8), {}, 179.0).patchGroup.size(), 1U);
  EXPECT_EQ(splitSurface(testing::geodesicSphere(4)).patchGroup.size(), 1U);
}

TEST(PatchSplitting, ShuffledTrianglesGiveTheSamePatches) {
  const std::vector<SurfaceMesh> surfaces{testing::gridCube(3), cylinderOf(30), cylinderOf(8)};
  for (const SurfaceMesh& surface : surfaces) {
    const PatchSplit given = splitSurface(surface);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      std::vector<std::uint32_t> order;
      const SurfaceMesh copy = shuffledCopy(surface, seed, order);
      const PatchSplit split = splitSurface(copy);
      ASSERT_EQ(split.patchGroup.size(), given.patchGroup.size());
      for (std::size_t t = 0; t < order.size(); ++t) {
        ASSERT_EQ(split.trianglePatch[t], given.trianglePatch[order[t]]) << "seed " << seed;
      }
    }
  }
}

TEST(PatchSplitting, OtherTrianglesGiveTheSameOrder) {
  const SurfaceMesh coarse = testing::gridCube(1);
  const SurfaceMesh fine = testing::gridCube(4, testing::Diagonals::kRandom, 7);
  const std::vector<Vec3> expected = patchCentroids(coarse, splitSurface(coarse));
  const std::vector<Vec3> found = patchCentroids(fine, splitSurface(fine));
  ASSERT_EQ(found.size(), expected.size());
  // Means of centroids depend on the triangles, but not on the plane of a face.
  for (std::size_t p = 0; p < 6; ++p) EXPECT_LT(glm::length(found[p] - expected[p]), 0.2);
}

TEST(PatchSplitting, SymmetricPatchesInOneBoxHaveAnOrder) {
  // The diagonal walls of an X have the same box, centroid and area.
  SurfaceMesh walls;
  const auto addWall = [&](double y0, double y1, double offset) {
    const auto first = static_cast<std::uint32_t>(walls.points.size() / 3);
    walls.points.insert(walls.points.end(),
                        {-1.0, y0, offset, 1.0, y1, offset, 1.0, y1, 1.0, -1.0, y0, 1.0});
    addSquare(walls, first, first + 1, first + 2, first + 3);
  };
  addWall(-1.0, 1.0, 0.0);
  addWall(1.0, -1.0, 0.0);
  const PatchSplit split = splitSurface(walls);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<std::uint32_t> order;
    const PatchSplit shuffled = splitSurface(shuffledCopy(walls, seed, order));
    for (std::size_t t = 0; t < order.size(); ++t) {
      ASSERT_EQ(shuffled.trianglePatch[t], split.trianglePatch[order[t]]);
    }
  }
}

TEST(PatchSplitting, ALineThatEndsWithinAFaceDoesNotSplitIt) {
  // A tent over the middle of a flat sheet: the ridge is sharp in the middle and flat towards both ends.
  SurfaceMesh sheet;
  constexpr std::uint32_t kColumns = 9;
  for (std::uint32_t j = 0; j < 3; ++j) {
    for (std::uint32_t i = 0; i < kColumns; ++i) {
      const bool isRidge = j == 1 && i >= 3 && i <= 5;
      sheet.points.insert(sheet.points.end(), {1.0 * i, 1.0 * j, isRidge ? 0.6 : 0.0});
    }
  }
  for (std::uint32_t j = 0; j < 2; ++j) {
    for (std::uint32_t i = 0; i + 1 < kColumns; ++i) {
      const std::uint32_t a = kColumns * j + i;
      addSquare(sheet, a, a + 1, a + kColumns + 1, a + kColumns);
    }
  }
  EXPECT_EQ(splitSurface(sheet, {}, 50.0).patchGroup.size(), 1U);
}

TEST(PatchSplitting, GroupsStaySeparateAndAreSplitFurther) {
  const SurfaceMesh cube = testing::gridCube(2);
  // Everything below the middle is group 7, everything above it group 3.
  std::vector<std::uint32_t> groups;
  for (std::size_t t = 0; t < cube.triangles.size() / 3; ++t) {
    groups.push_back(centroidOfTriangle(cube, t).z < 0.5 ? 7 : 3);
  }
  const PatchSplit split = splitSurface(cube, groups);
  EXPECT_EQ(split.patchGroup.size(), 10U);
  EXPECT_EQ(split.patchGroup, (std::vector<std::uint32_t>{7, 7, 7, 7, 7, 3, 3, 3, 3, 3}));
  for (std::size_t t = 0; t < groups.size(); ++t) {
    EXPECT_EQ(split.patchGroup[split.trianglePatch[t]], groups[t]);
  }
}

TEST(PatchSplitting, OpenAndNonManifoldSurfacesAreSplitToo) {
  SurfaceMesh open = testing::gridCube(1);
  open.triangles.resize(open.triangles.size() - 3);
  EXPECT_EQ(splitSurface(open).patchGroup.size(), 6U);
}

TEST(PatchSplitting, ReportsInvalidInput) {
  SurfaceMesh cube = testing::gridCube(1);
  for (const double angle : {0.5, 181.0, std::nan("")}) {
    const PatchSplit split = splitSurface(cube, {}, angle);
    ASSERT_EQ(split.diagnostics.size(), 1U);
    EXPECT_EQ(split.diagnostics[0].code, DiagnosticCode::kOptionOutOfRange);
    EXPECT_TRUE(split.trianglePatch.empty());
  }
  cube.triangles[5] = 99;
  EXPECT_EQ(splitSurface(cube).diagnostics.at(0).code, DiagnosticCode::kIndexOutOfRange);
  cube.triangles.clear();
  EXPECT_EQ(splitSurface(cube).diagnostics.at(0).code, DiagnosticCode::kEmptyModel);
}

}  // namespace
}  // namespace tetrafront
