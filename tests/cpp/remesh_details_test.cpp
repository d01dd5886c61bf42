/// @file Details of remeshed surfaces that are merged.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

/// A block of 4 x 2 x 1 whose top has a step of this height in the middle, straight across.
SurfaceMesh blockWithStep(double height) {
  return extruded(
      {{0.0, 0.0}, {4.0, 0.0}, {4.0, 1.0}, {2.0, 1.0}, {2.0, 1.0 + height}, {0.0, 1.0 + height}},
      2.0, 1, 1);
}

double largestOffset(const SurfaceRemesh& result) {
  double largest = 0.0;
  for (const MergedDetail& merged : result.mergedDetails) {
    largest = std::max(largest, glm::length(merged.onto - merged.from));
  }
  return largest;
}

TEST(RemeshDetails, AreKeptUnlessAsked) {
  const SurfaceRemesh result = remesh(blockWithStep(0.004));
  EXPECT_TRUE(result.mergedDetails.empty());
  EXPECT_NEAR(std::fabs(enclosedVolume(surfaceOf(result))), 8.0 + 0.004 * 4.0, 1e-9);
}

TEST(RemeshDetails, HaveSmallTrianglesUnlessASmallestSizeIsGiven) {
  const SurfaceMesh given = blockWithStep(0.004);
  const SurfaceRemesh automatic = remesh(given);
  EXPECT_GT(automatic.smallestAngle, 17.0);
  RemeshOptions options;
  options.minSize = automatic.minSize;
  const SurfaceRemesh limited = remesh(given, options);
  EXPECT_LT(limited.smallestAngle, 15.0);
  EXPECT_LT(limited.triangles.size(), automatic.triangles.size());
}

/// Details that would need millions of triangles change nothing but the triangles next to them.
TEST(RemeshDetails, AreNotResolvedIfMuchSmallerThanTheBody) {
  const SurfaceRemesh plain = remesh(blockWithStep(0.4));
  const SurfaceRemesh tiny = remesh(blockWithStep(1e-6));
  EXPECT_LT(tiny.triangles.size(), 2 * plain.triangles.size());
}

TEST(RemeshDetails, StepsNarrowerThanTheLengthDisappear) {
  RemeshOptions options;
  options.dropDetails = 0.01;
  const SurfaceRemesh result = remesh(blockWithStep(0.004), options);
  const SurfaceMesh made = surfaceOf(result);
  EXPECT_TRUE(errorsOf(made, InnerShells::kCavities).empty());
  EXPECT_FALSE(result.mergedDetails.empty());
  EXPECT_LE(largestOffset(result), 0.01);
  EXPECT_GT(result.smallestAngle, 20.0);
  EXPECT_LE(result.deviation, result.tolerance + 0.01);
  EXPECT_NEAR(std::fabs(enclosedVolume(made)), 8.0, 0.004 * 8.0);
  for (const std::uint32_t origin : result.origin) {
    EXPECT_LT(origin, countTriangles(blockWithStep(0.004)));
  }
}

TEST(RemeshDetails, StepsAboveTheLengthStay) {
  RemeshOptions options;
  options.dropDetails = 0.003;
  EXPECT_TRUE(remesh(blockWithStep(0.004), options).mergedDetails.empty());
}

/// The triangles along the strip would have angles of .04 degrees.
TEST(RemeshDetails, PoorOnesAreDroppedWithinTheTolerance) {
  const SurfaceMesh given = blockWithStep(1e-5);
  EXPECT_LT(remesh(given).smallestAngle, 1.0);
  RemeshOptions options;
  options.dropPoorDetails = true;
  const SurfaceRemesh result = remesh(given, options);
  const SurfaceMesh made = surfaceOf(result);
  EXPECT_TRUE(errorsOf(made, InnerShells::kCavities).empty());
  EXPECT_GT(result.smallestAngle, 20.0);
  EXPECT_FALSE(result.mergedDetails.empty());
  EXPECT_DOUBLE_EQ(result.tolerance, remesh(given).tolerance);
  EXPECT_LE(result.deviation, result.tolerance);
  EXPECT_LE(sampledDistance(made, given, 500), result.deviation);
  EXPECT_LE(sampledDistance(given, made, 500), result.deviation);
  ASSERT_EQ(result.triangleDeviation.size(), result.origin.size());
  for (const std::uint32_t origin : result.origin) EXPECT_LT(origin, countTriangles(given));
}

TEST(RemeshDetails, WellShapedOnesAreNotDropped) {
  RemeshOptions options;
  options.dropPoorDetails = true;
  for (const SurfaceMesh& given : {blockWithStep(0.004), gridCube(4)}) {
    const SurfaceRemesh plain = remesh(given);
    const SurfaceRemesh result = remesh(given, options);
    EXPECT_TRUE(result.mergedDetails.empty());
    EXPECT_EQ(result.points, plain.points);
    EXPECT_EQ(result.triangles, plain.triangles);
    EXPECT_DOUBLE_EQ(result.tolerance, plain.tolerance);
    EXPECT_LE(result.deviation, result.tolerance);
  }
}

/// Details below a fifth of the tolerance are dropped, unless sizes are small enough for good triangles across them.
TEST(RemeshDetails, SmallOnesStayIfSizesAreAsSmall) {
  const SurfaceMesh given = blockWithStep(0.004);
  RemeshOptions options;
  options.dropPoorDetails = true;
  options.tolerance = 0.021;
  options.minSize = 0.011;
  const SurfaceRemesh fine = remesh(given, options);
  EXPECT_TRUE(fine.mergedDetails.empty());
  EXPECT_GT(fine.smallestAngle, 12.0);
  options.minSize = 0.03;
  const SurfaceRemesh coarse = remesh(given, options);
  EXPECT_FALSE(coarse.mergedDetails.empty());
  EXPECT_LE(coarse.deviation, coarse.tolerance);
  EXPECT_GT(coarse.smallestAngle, 20.0);
}

/// Whenever the work is stopped, the surface is a valid boundary near the given one.
TEST(RemeshDetails, AreDroppedOrNotIfTheWorkIsStopped) {
  const SurfaceMesh given = blockWithStep(1e-5);
  RemeshOptions options;
  options.dropPoorDetails = true;
  bool isComplete = false;
  for (int slices = 8; !isComplete; slices *= 2) {
    SurfaceRemesher remesher(given.points, given.triangles, {}, {}, options);
    isComplete = true;
    for (int i = 0; !remesher.advance(500); ++i) {
      if (i < slices) continue;
      remesher.stop();
      isComplete = false;
    }
    const SurfaceRemesh& result = remesher.result();
    EXPECT_FALSE(result.isPartial && isComplete);
    const SurfaceMesh made = surfaceOf(result);
    EXPECT_TRUE(errorsOf(made, InnerShells::kCavities).empty()) << slices;
    EXPECT_LE(sampledDistance(given, made, 100), result.deviation) << slices;
  }
}

/// What is as thin as rounding after a merge would have no volume.
TEST(RemeshDetails, RegionsDoNotDisappear) {
  SurfaceMesh plates = dividedBox({2, 1, 1}, 1);
  stretch(plates, {1.0, 1.0, 1e-7});
  RemeshOptions options;
  options.innerShells = InnerShells::kRegions;
  options.minSize = 0.2;
  options.maxSize = 0.6;
  options.dropDetails = 2.0;
  const SurfaceRemesh result = remesh(plates, options);
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kRegions).empty());
}

/// The length is above the thickness: lines on opposite sides of a wall must not become one.
TEST(RemeshDetails, ThinPartsStay) {
  for (const Body& body : std::vector<Body>{
           {"plate", [] { return gridBox(Vec3(0.0), Vec3(1.0, 1.0, 0.02), {1, 1, 1}); }},
           {"fine plate", [] { return thinPlate(12, 0.02); }},
           {"rod", [] { return gridBox(Vec3(0.0), Vec3(0.03, 0.03, 1.0), {1, 1, 20}); }},
           {"tube", [] { return coarseTube(60, 0.95, 0.5); }},
           {"bent sheet", [] { return bentSheet(24, 0.02); }},
           {"blade", [] { return twistedBlade(12, 6, 0.02); }},
       }) {
    RemeshOptions options;
    const SurfaceMesh given = body.make();
    options.dropDetails = 0.06;
    options.minSize = diagonalOf(given) / 40.0;
    const SurfaceRemesh result = remesh(given, options);
    ASSERT_TRUE(result.diagnostics.empty()) << body;
    EXPECT_NEAR(enclosedVolume(surfaceOf(result)) / enclosedVolume(given), 1.0, 0.02) << body;
  }
}

/// Short edges along a feature line and around corners are no details.
TEST(RemeshDetails, FineTrianglesAreNoDetails) {
  RemeshOptions options;
  options.dropDetails = 0.1;
  EXPECT_TRUE(remesh(gridCube(10), options).mergedDetails.empty());
  EXPECT_TRUE(remesh(coarseTube(100, 0.6, 2.0), options).mergedDetails.empty());
  EXPECT_TRUE(remesh(geodesicSphere(10), options).mergedDetails.empty());
}

/// Everything may be a detail here; what cannot be merged without harm must stay.
TEST(RemeshDetails, TheSurfaceStaysAValidBoundary) {
  const std::vector<SurfaceMesh> bodies{
      screwThread(1, 16),        needleGear(8, 0.3),       thinPlate(4, 0.05),
      twistedBlade(12, 6, 0.02), dividedBox({2, 2, 1}, 3), cubesSharingEdge(),
      cubeWithCubicCavity(3, 3), bentSheet(12, 0.05),
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const InnerShells shells = i == 4 ? InnerShells::kRegions : InnerShells::kCavities;
    for (const double part : {0.01, 0.05, 0.2}) {
      RemeshOptions options;
      options.innerShells = shells;
      options.dropDetails = part * diagonalOf(bodies[i]);
      options.minSize = diagonalOf(bodies[i]) / 12.0;
      const SurfaceRemesh result = remesh(bodies[i], options);
      ASSERT_TRUE(result.diagnostics.empty());
      const SurfaceMesh made = surfaceOf(result);
      EXPECT_TRUE(errorsOf(made, shells).empty()) << i << ' ' << part;
      EXPECT_LE(largestOffset(result), options.dropDetails);
      EXPECT_LE(sampledDistance(made, bodies[i], 100), result.deviation) << i << ' ' << part;
      EXPECT_LE(sampledDistance(bodies[i], made, 100), result.deviation) << i << ' ' << part;
    }
  }
}

}  // namespace
}  // namespace tetrafront::testing
