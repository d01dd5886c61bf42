/// @file Properties of remeshed surfaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "geom/measure.h"
#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/remeshed.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 3>;

/// Cosine of the angle at `a` in the triangle a b c.
double cosineAt(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(glm::normalize(b - a), glm::normalize(c - a));
}

class RemeshBody : public ::testing::TestWithParam<Body> {};

TEST_P(RemeshBody, StaysAValidBoundaryNearTheGivenOne) {
  const SurfaceMesh given = GetParam().make();
  RemeshOptions options;
  options.innerShells = GetParam().innerShells;
  options.minSize = diagonalOf(given) / 60.0;
  const SurfaceRemesh result = remesh(given, options);
  ASSERT_TRUE(result.diagnostics.empty());
  const SurfaceMesh made = surfaceOf(result);
  EXPECT_TRUE(errorsOf(made, options.innerShells).empty());
  EXPECT_LE(result.deviation, result.tolerance);
  EXPECT_LE(sampledDistance(made, given, 300), result.tolerance);
  EXPECT_LE(sampledDistance(given, made, 300), result.tolerance);
  const double volume = std::fabs(enclosedVolume(given));
  double area = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(given))) {
    area += areaOf(cornersOf(given, t));
  }
  EXPECT_NEAR(std::fabs(enclosedVolume(made)), volume, 1.05 * area * result.tolerance);
  // Right triangles with two equal sides have 0.828.
  EXPECT_GT(result.meanRadiusRatio, 0.82);
  EXPECT_EQ(result.origin.size(), countTriangles(made));
  for (const std::uint32_t origin : result.origin) EXPECT_LT(origin, countTriangles(given));
  EXPECT_EQ(result.triangleDeviation.size(), countTriangles(made));
  for (const float sampled : result.triangleDeviation) EXPECT_LE(sampled, result.deviation);
}

const std::vector<Body> kBodies{
    {"cube", [] { return gridCube(1); }},
    {"graded_cube", [] { return gradedCube(4, 3); }},
    {"sphere", [] { return geodesicSphere(12); }},
    {"needle_sphere", [] { return latitudeSphere(12, 60); }},
    {"torus", [] { return torus(2.0, 0.5, 40, 16); }},
    {"needle_plate", [] { return needlePlate(2, 24, 0.1); }},
    {"needle_gear", [] { return needleGear(12, 0.3); }},
    {"screw", [] { return screwThread(2, 24); }},
    {"blade", [] { return twistedBlade(12, 6, 0.02); }},
    {"bent_sheet", [] { return bentSheet(40, 0.05); }},
    {"tube", [] { return coarseTube(40, 0.6, 2.0); }},
    {"loft", [] { return loft(5, 24, 2.0, 0.5); }},
    {"cavity", [] { return cubeWithSphericalCavity(2, 6); }},
    {"shared_edge", [] { return cubesSharingEdge(); }},
    {"shared_node", [] { return cubesSharingNode(); }},
    {"interfaces", [] { return dividedBox({2, 2, 1}, 1); }, InnerShells::kRegions},
    {"knot", [] { return torusKnot(2, 3, 120, 10); }},
    // Within the tolerance of both faces at a fillet, or at the rim of a sheet, the surface could cut off the corner.
    {"tiny_fillets", [] { return prism({filleted(rectangle({0, 0}, {2, 1}), 1e-4, 8), {}}, 0.5); }},
    // Edges are far shorter than the target sizes, and caps of one node are collapsed along their rims.
    {"needle_drum", [] { return needleDrum(600, 0); }},
    {"needle_star", [] { return needleDrum(600, 5); }},
    // So many needles lie under a triangle that the surface is coarsened first.
    {"fine_drum", [] { return needleDrum(3000, 0); }},
    {"round_rim",
     [] { return prism({filleted(rectangle({0, 0}, {2, 1e-3}), 4.9e-4, 8), {}}, 1.0); }},
};

INSTANTIATE_TEST_SUITE_P(Remesh, RemeshBody, ::testing::ValuesIn(kBodies),
                         [](const auto& tested) { return tested.param.name; });

TEST(Remesh, KeepsFlatFacesAndSharpEdgesExactly) {
  const SurfaceMesh given = gridBox(Vec3(0.0), Vec3(1.0, 2.0, 3.0), {1, 1, 1});
  RemeshOptions options;
  options.size = 0.3;
  const SurfaceMesh made = surfaceOf(remesh(given, options));
  EXPECT_NEAR(enclosedVolume(made), 6.0, 1e-12);
  for (const float sampled : remesh(given, options).triangleDeviation) EXPECT_LT(sampled, 1e-12F);
  double area = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    area += areaOf(cornersOf(made, t));
  }
  EXPECT_NEAR(area, 22.0, 1e-12);
}

/// Below the goal of 0.5 %: nodes on a curved surface would leave all triangles on one side of it.
TEST(RemeshVolume, IsThatOfTheGivenSurface) {
  for (const Body& body : std::vector<Body>{
           {"ring", [] { return torus(1.0, 0.06, 96, 24); }},
           {"ball", [] { return geodesicSphere(24); }},
           {"cone", [] { return revolved({{0.0, 0.0}, {0.3, 0.0}, {0.0, 4.0}}, 60); }},
           {"bore",
            [] { return prism({rectangle({-1, -1}, {1, 1}), {circle({0, 0}, 0.9, 48)}}, 0.2); }},
           {"ball in a ball", [] { return nestedSpheres(2, 16); }},
           {"coarse ring", [] { return torus(1.0, 0.02, 120, 10); }},
           {"thin shell",
            [] {
              SurfaceMesh shell = geodesicSphere(12);
              SurfaceMesh cavity = geodesicSphere(12);
              scale(cavity, 0.94);
              turnInsideOut(cavity);
              append(shell, cavity);
              return shell;
            }},
       }) {
    const SurfaceMesh given = body.make();
    const SurfaceRemesh result = remesh(given);
    ASSERT_TRUE(result.diagnostics.empty()) << body;
    const SurfaceMesh made = surfaceOf(result);
    EXPECT_NEAR(enclosedVolume(made) / enclosedVolume(given), 1.0, 4e-3) << body;
    EXPECT_LE(result.deviation, result.tolerance) << body;
    EXPECT_TRUE(errorsOf(made, InnerShells::kCavities).empty()) << body;
  }
}

TEST(RemeshVolume, OfAThinTubeIsKept) {
  // The automatic tolerance of a body of this extent would be twice the thickness of the wall.
  const double thickness = 0.005;
  const SurfaceMesh given =
      prism({circle({0, 0}, 1.0, 240), {circle({0, 0}, 1.0 - thickness, 240)}}, 0.2);
  const SurfaceRemesh result = remesh(given);
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_LE(result.tolerance, 0.5 * thickness);
  EXPECT_NEAR(enclosedVolume(surfaceOf(result)) / enclosedVolume(given), 1.0, 3e-3);
}

TEST(RemeshVolume, FlatFacesWithRoundHolesStayExactlyFlat) {
  const SurfaceMesh given = prism({rectangle({-1, -1}, {1, 1}), {circle({0, 0}, 0.9, 48)}}, 0.2);
  const SurfaceMesh made = surfaceOf(remesh(given));
  double flat = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    const Corners corners = cornersOf(made, t);
    if (corners[0].z == corners[1].z && corners[1].z == corners[2].z) flat += areaOf(corners);
  }
  EXPECT_NEAR(flat, 2.0 * (4.0 - 0.81 * std::numbers::pi), 0.02);
}

TEST(Remesh, SamplesTheDeviationOfEachTriangle) {
  RemeshOptions options;
  options.size = 0.3;
  options.tolerance = 0.1;
  const SurfaceMesh given = geodesicSphere(24);
  const SurfaceRemesh result = remesh(given, options);
  const SurfaceMesh made = surfaceOf(result);
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    const auto [a, b, c] = cornersOf(made, t);
    double distance = 0.0;
    for (const Vec3& sample :
         {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0}) {
      distance = std::max(distance, std::fabs(1.0 - glm::length(sample)));
    }
    // The given facets are up to 0.0015 below the sphere.
    EXPECT_NEAR(result.triangleDeviation[t.index()], distance, 0.002);
  }
}

TEST(Remesh, TheResultDoesNotDependOnTheSlices) {
  const SurfaceMesh given = needlePlate(2, 16, 0.1);
  const SurfaceRemesh whole = remesh(given);
  SurfaceRemesher remesher(given.points, given.triangles, {}, {}, {});
  EXPECT_GT(slicesOf(remesher, 64), 100U);
  EXPECT_EQ(remesher.result().points, whole.points);
  EXPECT_EQ(remesher.result().triangles, whole.triangles);
}

TEST(Remesh, KeepsTheAreaOfEachGroup) {
  // The top of the cube is divided into two groups along a diagonal that is not sharp.
  const SurfaceMesh given = gridCube(1);
  std::vector<std::uint32_t> groups(countTriangles(given));
  for (std::uint32_t t = 0; t < groups.size(); ++t) groups[t] = t;
  const SurfaceRemesh result = remesh(given, {}, groups);
  const SurfaceMesh made = surfaceOf(result);
  std::vector<double> areas(groups.size(), 0.0);
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    areas[groups[result.origin[t.index()]]] += areaOf(cornersOf(made, t));
  }
  for (const double area : areas) EXPECT_NEAR(area, 0.5, 1e-12);
}

/// The rounding of a text file tilts a sliver in a flat face by more than the feature angle.
TEST(Remesh, SliversInSmoothFacesHaveNoCreases) {
  const double rounding = 3e-6;
  SurfaceMesh cube;
  for (const Vec3& p :
       {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0),
        Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.0), Vec3(1.0, 1.0, 1.0), Vec3(0.0, 1.0, 1.0),
        Vec3(0.5 + rounding, 0.5 - rounding, 1.0 + 2.0 * rounding)}) {
    cube.points.insert(cube.points.end(), {p.x, p.y, p.z});
  }
  cube.triangles = {0, 2, 1, 0, 3, 2, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7,
                    2, 7, 6, 3, 0, 4, 3, 4, 7, 4, 5, 8, 5, 6, 8, 4, 8, 6, 4, 6, 7};
  const SurfaceRemesh result = remesh(cube);
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_EQ(result.patches, 6U);
  EXPECT_EQ(result.featureLines, 12U);
  EXPECT_GT(result.smallestAngle, 20.0);
}

TEST(Remesh, AbsorbsCapsOnFeatureLines) {
  for (const double height : {4e-6, 1e-5, 3e-5, 1e-4}) {
    const SurfaceRemesh result = remesh(cubeWithCaps(height));
    ASSERT_TRUE(result.diagnostics.empty()) << height;
    EXPECT_EQ(result.featureLines, 12U) << height;
    EXPECT_GT(result.smallestAngle, 20.0) << height;
  }
}

/// A unit cube with two caps on both sides of an edge: the apexes have this height and these feet on the edge. The edge is a
/// sharp one, or the diagonal of the top; there, the apexes may also be above and below the plane.
SurfaceMesh cubeWithTwinCaps(const std::string& where, double height, double foot, double other) {
  const double h = height;
  SurfaceMesh cube = cubeWithCaps(0.0);
  Vec3 apex(foot, h, 1.0);
  Vec3 twin(other, 0.0, 1.0 - h);
  if (where != "sharp edge") {
    const double up = where == "across the face" ? h : 0.0;
    apex = Vec3(foot + 0.5 * h, foot - 0.5 * h, 1.0 + up);
    twin = Vec3(other - 0.5 * h, other + 0.5 * h, 1.0 - up);
    cube.triangles = {0, 2, 1, 0, 3, 2, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7,
                      0, 1, 5, 0, 5, 4, 4, 5, 8, 5, 6, 8, 4, 8, 6, 4, 6, 9, 6, 7, 9, 7, 4, 9};
  }
  for (int k = 0; k < 3; ++k) {
    cube.points[24 + static_cast<std::size_t>(k)] = apex[k];
    cube.points[27 + static_cast<std::size_t>(k)] = twin[k];
  }
  return cube;
}

TEST(Remesh, AbsorbsCapsOnBothSidesOfAnEdge) {
  bool isRotated = false;
  for (const char* where : {"sharp edge", "in the face", "across the face"}) {
    for (const double height : {1e-8, 1e-9, 1e-12, 1e-14}) {
      for (const double other : {0.7, 0.401, 0.400001, 0.4}) {
        SurfaceMesh given = cubeWithTwinCaps(where, height, 0.4, other);
        // Every second cube is rotated.
        if (isRotated) rotateRandomly(given, 1);
        isRotated = !isRotated;
        const SurfaceRemesh result = remesh(given);
        ASSERT_TRUE(result.diagnostics.empty());
        EXPECT_EQ(result.featureLines, 12U) << where << ' ' << height << ' ' << other;
        EXPECT_GT(result.smallestAngle, 20.0) << where << ' ' << height << ' ' << other;
      }
      isRotated = !isRotated;
    }
  }
}

/// A raised plate with a notch between a straight edge and an arc that is tangent to it, on a base.
SurfaceMesh notchedPlate(double radius) {
  Outline outline{{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}};
  for (int i = 0; i <= 24; ++i) {
    const double angle = std::numbers::pi * (i / 48.0 - 0.5);
    outline.push_back(Vec2(1.5, 1.0 + radius) + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  outline.insert(outline.end(), {{1.5 + radius, 3.0}, {0.0, 3.0}});
  return embossed({{-1.0, -1.0}, {4.0, -1.0}, {4.0, 4.0}, {-1.0, 4.0}}, {{outline, {}}}, 1.0, 0.5);
}

TEST(Remesh, MakesFewSharpTrianglesInACusp) {
  // The angle of the longest edge that the tolerance allows falls with the root of the radius.
  for (const auto& [radius, least] :
       {std::pair(0.2, 8.0), std::pair(0.5, 7.0), std::pair(1.0, 4.5)}) {
    for (int seed = 0; seed < 3; ++seed) {
      SurfaceMesh given = notchedPlate(radius);
      if (seed > 0) rotateRandomly(given, seed);
      const SurfaceRemesh result = remesh(given);
      const SurfaceMesh made = surfaceOf(result);
      std::size_t sharp = 0;
      for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
        const auto [a, b, c] = cornersOf(made, t);
        const double cosine = std::max({cosineAt(a, b, c), cosineAt(b, c, a), cosineAt(c, a, b)});
        if (cosine > std::cos(20.0 * std::numbers::pi / 180.0)) ++sharp;
      }
      EXPECT_LE(sharp, 3U) << radius << ' ' << seed;
      EXPECT_GT(result.smallestAngle, least) << radius << ' ' << seed;
    }
  }
}

TEST(Remesh, RemeshingAgainChangesLittle) {
  RemeshOptions options;
  options.size = 0.2;
  // Equilateral triangles of this size would cover the torus.
  const double area = 4.0 * std::numbers::pi * std::numbers::pi * 2.0 * 0.7;
  const double ideal = area / (std::sqrt(3.0) / 4.0 * options.size * options.size);
  SurfaceMesh made = torus(2.0, 0.7, 48, 24);
  // Of a mesh that is already good, the longer edges are divided: more triangles, but no more each time.
  made = surfaceOf(remesh(made, options));
  EXPECT_NEAR(countTriangles(made), ideal, 0.2 * ideal);
  made = surfaceOf(remesh(made, options));
  const double second = countTriangles(made);
  EXPECT_NEAR(second, ideal, 0.45 * ideal);
  for (int round = 0; round < 2; ++round) {
    made = surfaceOf(remesh(made, options));
    EXPECT_NEAR(countTriangles(made), second, 0.05 * second) << round;
  }
}

TEST(Remesh, DoesNotDependOnUnitsAndHardlyOnThePosition) {
  const SurfaceMesh given = needleGear(8, 0.3);
  const double count = countTriangles(surfaceOf(remesh(given)));
  for (const double factor : {1e-6, 1e6}) {
    SurfaceMesh scaled = given;
    scale(scaled, factor);
    EXPECT_NEAR(countTriangles(surfaceOf(remesh(scaled))), count, 0.1 * count) << factor;
  }
  SurfaceMesh moved = given;
  translate(moved, Vec3(1e3));
  EXPECT_NEAR(countTriangles(surfaceOf(remesh(moved))), count, 0.1 * count);
}

TEST(Remesh, RejectsSurfacesThatAreNotABoundary) {
  SurfaceMesh open = gridCube(2);
  open.triangles.resize(open.triangles.size() - 3);
  const SurfaceRemesh result = remesh(open);
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_EQ(result.diagnostics[0].code, DiagnosticCode::kOpenEdge);
  EXPECT_TRUE(result.triangles.empty());
}

TEST(Remesh, RejectsSingleTrianglesThatFaceInwardAndNotesComponentsInsideOut) {
  SurfaceMesh mixed = gridCube(2);
  std::swap(mixed.triangles[4], mixed.triangles[5]);
  const SurfaceRemesh refused = remesh(mixed);
  ASSERT_EQ(refused.diagnostics.size(), 1U);
  EXPECT_EQ(refused.diagnostics[0].code, DiagnosticCode::kFlippedTriangle);
  EXPECT_EQ(refused.diagnostics[0].entities[0].index, 1U);
  EXPECT_TRUE(refused.triangles.empty());

  SurfaceMesh inside = gridCube(2);
  for (std::size_t i = 0; i < inside.triangles.size(); i += 3) {
    std::swap(inside.triangles[i + 1], inside.triangles[i + 2]);
  }
  const SurfaceRemesh oriented = remesh(inside);
  ASSERT_EQ(oriented.diagnostics.size(), 1U);
  EXPECT_EQ(oriented.diagnostics[0].code, DiagnosticCode::kReorientedPatch);
  EXPECT_EQ(oriented.triangles, remesh(gridCube(2)).triangles);
}

/// A cylinder is remeshed equally well whatever its height is, and however finely it was divided.
TEST(Remesh, TrianglesOnCylindersAreWellShaped) {
  const auto expectWellShaped = [](int sides, double height) {
    const SurfaceRemesh result = remesh(coarseBar(sides, height));
    ASSERT_TRUE(result.diagnostics.empty());
    EXPECT_GT(result.meanRadiusRatio, 0.92) << sides << ' ' << height;
    EXPECT_GT(result.smallestAngle, 20.0) << sides << ' ' << height;
  };
  expectWellShaped(60, 3.4);
  expectWellShaped(500, 5.0);
  expectWellShaped(2000, 3.4);
}

/// Stops a remeshing at several states of its progress; returns how many results are neither the given nor the whole surface.
std::size_t stopInBetween(const SurfaceMesh& given, const RemeshOptions& options,
                          const std::vector<double>& states) {
  const SurfaceRemesh whole = remesh(given, options);
  EXPECT_TRUE(whole.diagnostics.empty());
  EXPECT_FALSE(whole.isPartial);
  std::size_t between = 0;
  for (const double progress : states) {
    SurfaceRemesher remesher(given.points, given.triangles, {}, {}, options);
    while (remesher.fraction() < progress) EXPECT_FALSE(remesher.advance(100)) << progress;
    remesher.stop();
    while (!remesher.advance(100)) {
    }
    const SurfaceRemesh& result = remesher.result();
    EXPECT_TRUE(result.isPartial) << progress;
    EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kCavities).empty()) << progress;
    EXPECT_LE(result.deviation, result.tolerance) << progress;
    EXPECT_LE(sampledDistance(surfaceOf(result), given, 20), result.deviation) << progress;
    EXPECT_LE(sampledDistance(given, surfaceOf(result), 20), result.deviation) << progress;
    if (result.triangles != given.triangles && result.triangles != whole.triangles) ++between;
  }
  return between;
}

TEST(Remesh, MeasuresWhatAllRegionsEncloseTogether) {
  const SurfaceRemesh result = remesh(dividedBox({3, 2, 1}, 2), {});
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_NEAR(result.givenVolume, 6.0, 1e-12);
  EXPECT_NEAR(result.volume, 6.0, 1e-12);
}

/// The tolerance follows the smallest region, whether regions are given or found.
TEST(Remesh, HasTheSameToleranceForRegionsThatAreFound) {
  RegionedSurface cubes = twoRegions(0.0);
  SurfaceRemesher stated(cubes.mesh.points, cubes.mesh.triangles, {}, {}, {}, cubes.regions);
  while (!stated.advance(1U << 20U)) {
  }
  const SurfaceRemesh found = remesh(cubes.mesh, {});
  EXPECT_NEAR(found.tolerance, std::sqrt(3.0) / 250.0, 1e-12);
  EXPECT_DOUBLE_EQ(found.tolerance, stated.result().tolerance);
}

TEST(Remesh, ReturnsAValidSurfaceWheneverItIsStopped) {
  RemeshOptions options;
  options.size = 0.4;
  const std::vector<double> states{0.0, 0.12, 0.3, 0.45, 0.6, 0.9};
  EXPECT_GT(stopInBetween(screwThread(1, 8), options, states), 2U);
  // A surface that is coarsened first.
  options.size = 1.0;
  options.tolerance = 0.05;
  EXPECT_GT(stopInBetween(coarseBar(900, 1.0), options, {0.2, 0.6}), 0U);
}

TEST(Remesh, RefusesOptionsOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::tuple<CheckedOption, double RemeshOptions::*, std::vector<double>>> ranges{
      {CheckedOption::kSize, &RemeshOptions::size, {-1.0, 1e31, nan}},
      {CheckedOption::kGrowth, &RemeshOptions::growth, {-0.1, 10.1, nan}},
      {CheckedOption::kMinSize, &RemeshOptions::minSize, {-1.0, 1e31, nan}},
      {CheckedOption::kMaxSize, &RemeshOptions::maxSize, {-1.0, 1e31, nan}},
      {CheckedOption::kTolerance, &RemeshOptions::tolerance, {-1.0, 1e31, nan}},
      {CheckedOption::kFeatureAngle, &RemeshOptions::featureAngle, {0.0, 0.9, 181.0, nan}},
      {CheckedOption::kAnglePerEdge, &RemeshOptions::anglePerEdge, {-1.0, 0.9, 181.0, nan}},
      {CheckedOption::kDropDetails, &RemeshOptions::dropDetails, {-1.0, 1e31, nan}},
      {CheckedOption::kLayers, &RemeshOptions::layers, {101.0, nan}},
      {CheckedOption::kSizeFactor, &RemeshOptions::sizeFactor, {0.0, -1.0, 1e4, nan}},
  };
  for (const auto& [option, field, values] : ranges) {
    for (const double value : values) {
      RemeshOptions options;
      options.*field = value;
      const SurfaceRemesh result = remesh(gridCube(1), options);
      ASSERT_EQ(result.diagnostics.size(), 1U) << static_cast<int>(option) << ' ' << value;
      EXPECT_EQ(result.diagnostics[0].code, DiagnosticCode::kOptionOutOfRange);
      EXPECT_EQ(result.diagnostics[0].values[0], static_cast<double>(option));
      EXPECT_TRUE(result.triangles.empty());
    }
  }
}

}  // namespace
}  // namespace tetrafront::testing
