#include "field/size_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "field/size_octree_builder.h"
#include "field/size_sites.h"
#include "support/random.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

std::vector<Vec3> pointsOf(const SurfaceMesh& mesh) {
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < nodeCount(mesh); ++i) points.push_back(pointOf(mesh, i));
  return points;
}

/// Evaluates the definition over all nodes.
double bruteForce(const std::vector<Vec3>& points, const std::vector<double>& sizes, double growth,
                  double cap, const Vec3& position) {
  double least = cap;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (sizes[i] > 0.0)
      least = std::min(least, sizes[i] + growth * glm::length(position - points[i]));
  }
  return least;
}

/// A sphere with much smaller triangles in the south than in the north.
SurfaceMesh gradedSphere() {
  SurfaceMesh mesh = geodesicSphere(24);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    Vec3 p(mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]);
    p = p - Vec3(0.0, 0.0, 0.85);
    p /= glm::dot(p, p);  // an inversion about a position near the north pole keeps it a sphere
    mesh.points[i] = p.x;
    mesh.points[i + 1] = p.y;
    mesh.points[i + 2] = p.z;
  }
  return mesh;
}

TEST(SizeOctreeTest, MeanEdgeOfACubeOfUnitSquares) {
  // Every node of the single-square cube has three sides of length 1 and 0 to 3 diagonals.
  const SurfaceMesh mesh = gridCube(1);
  const std::vector<double> sizes = averagedEdgeLengths(pointsOf(mesh), mesh.triangles);
  for (const double size : sizes) {
    EXPECT_GT(size, 1.0);
    EXPECT_LT(size, std::sqrt(2.0));
  }
}

TEST(SizeOctreeTest, UniformTriangulationGivesItsEdgeLength) {
  const SurfaceMesh mesh = gridCube(8, Diagonals::kUnionJack);
  const SizeOctree octree(pointsOf(mesh), mesh.triangles, 0.3, 0.0);
  for (const Vec3& position : {Vec3(0.5), Vec3(0.0), Vec3(1.0, 0.5, 0.2), Vec3(-3.0, 0.4, 9.0)}) {
    EXPECT_GT(octree.sizeAt(position), 1.0 / 8.0);
    EXPECT_LT(octree.sizeAt(position), std::sqrt(2.0) / 8.0);
  }
}

TEST(SizeOctreeTest, SitesAgreeWithBruteForce) {
  const SurfaceMesh mesh = gradedSphere();
  const std::vector<Vec3> points = pointsOf(mesh);
  const std::vector<double> sizes = averagedEdgeLengths(points, mesh.triangles);
  SizeSites sites(points, sizes, 0.3);
  constexpr std::size_t kOctreeBudget = 100;
  std::size_t calls = 1;
  Job building([&](Work& work) { return sites.build(work, 1); });
  while (!building.advance(kOctreeBudget)) ++calls;
  EXPECT_GE(calls * kOctreeBudget, 12 * points.size()) << "no call comes to more";
  Random random(301);
  for (int i = 0; i < 500; ++i) {
    const Vec3 position = random.inBox(8.0) - Vec3(0.0, 0.0, 3.0);
    const double expected = bruteForce(points, sizes, 0.3, 1e30, position);
    const double found = sites.at(position, SiteId(0U)).size;
    EXPECT_GE(found, expected * (1.0 - 1e-6)) << "single precision";
    EXPECT_LE(found, expected * 1.07);
  }
}

/// Also near the smallest sites, for any distance and size of the guess.
TEST(SizeOctreeTest, SitesAgreeWithBruteForceFromAFarGuess) {
  const SurfaceMesh mesh = gradedSphere();
  const std::vector<Vec3> points = pointsOf(mesh);
  const std::vector<double> sizes = averagedEdgeLengths(points, mesh.triangles);
  SizeSites sites(points, sizes, 0.3);
  Job([&](Work& work) { return sites.build(work, 1); }).finish();
  for (std::size_t i = 0; i < points.size(); i += 11) {
    const double expected = bruteForce(points, sizes, 0.3, 1e30, points[i]);
    EXPECT_LE(sites.at(points[i], SiteId(0U)).size, expected * 1.07) << i;
    EXPECT_LE(sites.at(points[i], SiteId(4000U)).size, expected * 1.07) << i;
  }
}

TEST(SizeOctreeTest, OctreeAgreesWithBruteForce) {
  for (const double cap : {0.0, 0.5, 1e9}) {
    const SurfaceMesh mesh = gradedSphere();
    const std::vector<Vec3> points = pointsOf(mesh);
    const std::vector<double> sizes = averagedEdgeLengths(points, mesh.triangles);
    const SizeOctree octree(points, mesh.triangles, 0.3, cap);
    Random random(302);
    double sum = 0.0;
    constexpr int kSamples = 1000;
    for (int i = 0; i < kSamples; ++i) {
      // Half of the positions are near the surface, where the field is not smooth.
      const Vec3 near = points[static_cast<std::size_t>(random.integer(0, 5000))];
      const Vec3 position =
          i % 2 == 0 ? near + random.inBox(0.05) : random.inBox(3.0) - Vec3(0.0, 0.0, 3.0);
      const Vec3 held = glm::clamp(position, Vec3(-8.0), Vec3(8.0));
      const double expected = bruteForce(points, sizes, 0.3, octree.cap(), held);
      const double error = octree.sizeAt(held) / expected - 1.0;
      sum += std::fabs(error);
      EXPECT_LT(std::fabs(error), 0.45) << "cap " << cap;
    }
    EXPECT_LT(sum / kSamples, 0.06) << "cap " << cap;
  }
}

/// A few tiny triangles inside a large cell must be found.
TEST(SizeOctreeTest, FindsASmallFeatureAmongLargeTriangles) {
  SurfaceMesh mesh = gridCube(2);
  SurfaceMesh speck = geodesicSphere(2);
  scale(speck, 1e-3);
  translate(speck, Vec3(0.41, 0.53, 0.37));
  append(mesh, speck);
  for (const double cap : {0.0, 0.4}) {
    const SizeOctree octree(pointsOf(mesh), mesh.triangles, 0.3, cap);
    EXPECT_LT(octree.sizeAt(Vec3(0.41, 0.53, 0.37)), 2e-3);
    EXPECT_GT(octree.sizeAt(Vec3(0.9)), 0.1);
  }
}

/// More sites than a list holds lie far from the samples of the first cells; those in all but the last octant have a size near the cap.
TEST(SizeOctreeTest, FindsSmallSizesAmongManyNearTheCap) {
  std::vector<Vec3> points;
  std::vector<double> sizes;
  Random random(77);
  while (points.size() < 1000) {
    const Vec3 position = random.inBox(1.0);
    if (std::fabs(glm::length(position) - 0.6) > 0.02) continue;
    points.push_back(position);
    sizes.push_back(std::min({position.x, position.y, position.z}) > 0.3 ? 0.05 : 0.19);
  }
  constexpr double kCap = 0.2;
  SizeOctreeBuilder builder(points, sizes, 0.3, kCap);
  while (!builder.advance(1U << 30U)) {
  }
  const SizeOctree octree = builder.take();
  for (const Vec3& position : points) {
    const double expected = bruteForce(points, sizes, 0.3, kCap, position);
    EXPECT_LT(octree.sizeAt(position), 1.6 * expected);
  }
}

TEST(SizeOctreeTest, DefaultCapIsTheNinetiethPercentile) {
  SurfaceMesh mesh = geodesicSphere(8);
  Random random(310);
  for (double& coordinate : mesh.points) coordinate += random.between(-0.02, 0.02);
  std::vector<double> sizes = averagedEdgeLengths(pointsOf(mesh), mesh.triangles);
  const SizeOctree octree(pointsOf(mesh), mesh.triangles, 0.3, 0.0);
  const auto below =
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size <= octree.cap(); });
  EXPECT_NEAR(static_cast<double>(below) / static_cast<double>(sizes.size()), 0.9, 0.01);
}

/// A small solid with many nodes does not determine the cap in a large solid with few nodes.
TEST(SizeOctreeTest, DefaultCapIsAtLeastTheMeanOverTheArea) {
  SurfaceMesh mesh = gridBox(Vec3(-5.0), Vec3(5.0), {4, 4, 4});
  SurfaceMesh small = geodesicSphere(20);
  scale(small, 0.1);
  append(mesh, small);
  const SizeOctree octree(pointsOf(mesh), mesh.triangles, 0.3, 0.0);
  EXPECT_GT(octree.cap(), 2.5);
  EXPECT_LT(octree.cap(), 2.5 * std::numbers::sqrt2);
  EXPECT_LT(octree.sizeAt(Vec3(0.1, 0.0, 0.0)), 0.02);
}

TEST(SizeOctreeTest, FollowsScaleAndOffset) {
  const SurfaceMesh mesh = gradedSphere();
  const SizeOctree original(pointsOf(mesh), mesh.triangles, 0.3, 1e30);
  Random random(303);
  for (const double factor : {1e-9, 1e9}) {
    const Vec3 offset = 1e4 * factor * Vec3(1.0, -2.0, 0.5);
    SurfaceMesh moved = mesh;
    scale(moved, factor);
    translate(moved, offset);
    const SizeOctree octree(pointsOf(moved), moved.triangles, 0.3, 1e30);
    for (int i = 0; i < 200; ++i) {
      const Vec3 position = random.inBox(3.0) - Vec3(0.0, 0.0, 3.0);
      const double expected = factor * original.sizeAt(position);
      // A leaf may be split in only one of them if a comparison is a tie.
      EXPECT_NEAR(octree.sizeAt(factor * position + offset), expected, 0.1 * expected);
    }
  }
}

TEST(SizeOctreeTest, OutsideItsBoxUsesTheNearestValue) {
  const SurfaceMesh mesh = geodesicSphere(6);
  const SizeOctree octree(pointsOf(mesh), mesh.triangles, 0.3, 1e9);
  EXPECT_NEAR(octree.sizeAt(Vec3(1e30, 0.0, 0.0)), octree.sizeAt(Vec3(5.0, 0.0, 0.0)), 1e-12);
  EXPECT_TRUE(std::isfinite(octree.sizeAt(Vec3(-1e300))));
}

/// The sizes of a shape may end in a single site, for example at its only thin corner.
TEST(SizeOctreeTest, EndsIfAllSitesAreAtOnePosition) {
  for (const std::size_t count : {1, 5}) {
    const std::vector<Vec3> points(count, Vec3(2.0, 0.1, 0.9));
    const std::vector<double> sizes(count, 0.5);
    SizeOctreeBuilder builder(points, sizes, 0.3, 0.75);
    bool isFinished = false;
    for (int i = 0; i < 1000 && !isFinished; ++i) isFinished = builder.advance(100);
    ASSERT_TRUE(isFinished);
    const double size = builder.take().sizeAt(points[0]);
    EXPECT_GE(size, 0.5);
    EXPECT_LT(size, 0.75);
  }
}

TEST(SizeOctreeTest, SlicesGiveTheSameAsOneRun) {
  const SurfaceMesh mesh = gradedSphere();
  const SizeOctree whole(pointsOf(mesh), mesh.triangles, 0.3, 1e9);
  SizeOctreeBuilder builder(pointsOf(mesh), mesh.triangles, 0.3, 1e9);
  int slices = 1;
  while (!builder.advance(100)) ++slices;
  EXPECT_GT(slices, 50);
  const SizeOctree sliced = builder.take();
  EXPECT_EQ(sliced.leafCount(), whole.leafCount());
  Random random(304);
  for (int i = 0; i < 500; ++i) {
    const Vec3 position = random.inBox(4.0);
    EXPECT_EQ(sliced.sizeAt(position), whole.sizeAt(position));
  }
}

/// Nodes without triangles have no influence.
TEST(SizeOctreeTest, IgnoresUnusedNodes) {
  const SurfaceMesh mesh = geodesicSphere(4);
  std::vector<Vec3> points = pointsOf(mesh);
  const SizeOctree without(points, mesh.triangles, 0.3, 1e9);
  points.push_back(Vec3(100.0));
  const SizeOctree with(points, mesh.triangles, 0.3, 1e9);
  EXPECT_EQ(with.leafCount(), without.leafCount());
  EXPECT_EQ(with.sizeAt(Vec3(0.3)), without.sizeAt(Vec3(0.3)));
}

double slowDescent(const std::vector<Vec3>& positions, const std::vector<double>& lengths,
                   double descent, const Vec3& at) {
  double most = -1e300;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    most = std::max(most, lengths[i] - descent * glm::length(at - positions[i]));
  }
  return most;
}

TEST(SizeOctreeTest, FallsWithTheDistanceFromASurface) {
  const SurfaceMesh mesh = testing::gridCube(4, testing::Diagonals::kAlternating);
  const std::vector<Vec3> points = pointsOf(mesh);
  std::vector<double> lengths = averagedEdgeLengths(points, mesh.triangles);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x > 0.9) lengths[i] *= 0.6;
  }
  SizeOctreeBuilder builder(points, lengths, SizeDescent{0.3, 0.02});
  while (!builder.advance(7)) {
  }
  const SizeOctree octree = builder.take();
  Random random(305);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 position = 0.5 * (Vec3(1.0) + random.inBox(1.0));
    const double expected = slowDescent(points, lengths, 0.3, position);
    EXPECT_NEAR(octree.sizeAt(position), expected, 0.2 * std::max(expected, 0.25 * 0.3)) << i;
  }
}

/// Fine triangles keep their lengths near triangles two hundred times as large.
TEST(SizeOctreeTest, FallsWithTheDistanceFromAStronglyGradedSurface) {
  const SurfaceMesh mesh = gradedSphere();
  const std::vector<Vec3> points = pointsOf(mesh);
  const std::vector<double> edges = averagedEdgeLengths(points, mesh.triangles);
  std::vector<double> lengths;
  for (const Vec3& point : points) lengths.push_back(bruteForce(points, edges, 0.3, 1e30, point));
  SizeOctreeBuilder builder(points, lengths, SizeDescent{0.3, 1e-5});
  while (!builder.advance(1000)) {
  }
  const SizeOctree octree = builder.take();
  for (std::size_t i = 0; i < points.size(); i += 3) {
    // A cell may be 1.5 times as wide as the smallest size in it.
    EXPECT_NEAR(octree.sizeAt(points[i]), lengths[i], 0.4 * lengths[i]) << i;
  }
}

/// Cells depend on the surface's triangles, not on how small the target sizes are.
TEST(SizeOctreeTest, CellsOfFallingSizesDoNotDependOnTheSmallestSize) {
  const SurfaceMesh mesh = geodesicSphere(12);
  const std::vector<Vec3> points = pointsOf(mesh);
  const std::vector<double> lengths = averagedEdgeLengths(points, mesh.triangles);
  SizeOctreeBuilder builder(points, lengths, SizeDescent{0.3, 1e-9});
  while (!builder.advance(1000)) {
  }
  EXPECT_LT(builder.take().leafCount(), 40 * mesh.triangles.size() / 3);
}

}  // namespace
}  // namespace tetrafront::testing
