/// @file Remeshing of given surfaces: properties of the result, and properties after every single
/// operation.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/mesh_access.h"
#include "base/task.h"
#include "boundary/boundary.h"
#include "boundary/surface_access.h"
#include "geom/intersect.h"
#include "geom/measure.h"
#include "quality/metrics.h"
#include "remesh/envelope.h"
#include "remesh/guarded_surface.h"
#include "remesh/reference_surface.h"
#include "remesh/surface_editor.h"
#include "support/hard_shapes.h"
#include "support/part_shapes.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/surface_measures.h"
#include "tetrafront/remesh.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 3>;

/// Cosine of the angle at `a` in the triangle a b c.
double cosineAt(const Vec3& a, const Vec3& b, const Vec3& c) {
  return glm::dot(glm::normalize(b - a), glm::normalize(c - a));
}

SurfaceRemesh remesh(const SurfaceMesh& mesh, const RemeshOptions& options = {},
                     const std::vector<std::uint32_t>& groups = {},
                     std::uint32_t budget = 1U << 20U) {
  SurfaceRemesher remesher(mesh.points, mesh.triangles, groups, {}, options);
  while (!remesher.advance(budget)) {
  }
  return remesher.result();
}

SurfaceMesh surfaceOf(const SurfaceRemesh& result) {
  SurfaceMesh mesh;
  mesh.points = result.points;
  mesh.triangles = result.triangles;
  return mesh;
}

SurfaceMesh surfaceOf(const SurfaceComplex& complex) {
  SurfaceMesh mesh;
  for (const NodeId node : IdRange<NodeId>(complex.nodeCount())) {
    const Vec3& p = complex.pointOf(node);
    mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  }
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    if (!complex.isAlive(t)) continue;
    for (const NodeId node : complex.nodesOf(t)) mesh.triangles.push_back(node.value);
  }
  return mesh;
}

double diagonalOf(const SurfaceMesh& mesh) {
  const Bounds bounds = boundsOf(mesh);
  return glm::length(bounds.high - bounds.low);
}

/// Returns the largest distance from samples of one surface to another: a lower bound of the
/// distance.
double sampledDistance(const SurfaceMesh& from, const SurfaceMesh& to, std::size_t samples) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::uint32_t> anyTriangle(0, countTriangles(from) - 1);
  std::uniform_real_distribution<double> anyPart(0.0, 1.0);
  double largest = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto [a, b, c] = cornersOf(from, TriangleId(anyTriangle(random)));
    const double root = std::sqrt(anyPart(random));
    const double part = anyPart(random);
    largest = std::max(
        largest, distanceTo(to, a * (1.0 - root) + b * (root * (1.0 - part)) + c * (root * part)));
  }
  return largest;
}

std::vector<Diagnostic> errorsOf(SurfaceMesh mesh, InnerShells innerShells) {
  std::vector<Diagnostic> found;
  closeBoundary(mesh, BoundarySource::kGivenSurface, found, innerShells);
  std::erase_if(found, [](const Diagnostic& d) { return d.severity != Severity::kError; });
  return found;
}

struct Body {
  std::string name;
  std::function<SurfaceMesh()> make;
  InnerShells innerShells = InnerShells::kCavities;
};

std::ostream& operator<<(std::ostream& out, const Body& body) { return out << body.name; }

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

/// Half the goal of 0.5 %: nodes on a curved surface would leave all triangles on one side of it.
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
    EXPECT_NEAR(enclosedVolume(made) / enclosedVolume(given), 1.0, 2.5e-3) << body;
    EXPECT_LE(result.deviation, result.tolerance) << body;
    EXPECT_TRUE(errorsOf(made, InnerShells::kCavities).empty()) << body;
  }
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

TEST(Remesh, ReachesTheTargetSize) {
  RemeshOptions options;
  options.size = 0.1;
  const SurfaceMesh made = surfaceOf(remesh(gridCube(1), options));
  std::size_t inBand = 0;
  const EdgeUse edges = countEdges(made);
  for (const auto& [edge, count] : edges) {
    const double length = glm::length(pointOf(made, edge.second) - pointOf(made, edge.first));
    if (length >= 0.06 && length <= 0.15) ++inBand;
  }
  EXPECT_GE(static_cast<double>(inBand), 0.97 * static_cast<double>(edges.size()));
}

TEST(Remesh, SourcesMakeTrianglesSmallerNearThem) {
  BackgroundGrid grid;
  SizeSource source;
  source.points[0] = Vec3(0.0);
  source.size = 0.02;
  grid.sources.push_back(source);
  RemeshOptions options;
  options.size = 0.3;
  const SurfaceMesh cube = gridCube(1);
  SurfaceRemesher remesher(cube.points, cube.triangles, {}, grid, options);
  while (!remesher.advance(1U << 20U)) {
  }
  const SurfaceMesh made = surfaceOf(remesher.result());
  double nearArea = 0.0;
  double nearCount = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    const Corners corners = cornersOf(made, t);
    if (glm::length(centroidOf(corners)) > 0.05) continue;
    nearArea += areaOf(corners);
    nearCount += 1.0;
  }
  ASSERT_GT(nearCount, 0.0);
  // An equilateral triangle of size h has the area 0.433 h^2; sizes grow by 0.3 x distance.
  EXPECT_LT(nearArea / nearCount, 0.433 * 0.04 * 0.04);
}

/// Number of triangles of a cube remeshed with a source at a corner.
std::size_t countWithSource(double sizeAtCorner) {
  BackgroundGrid grid;
  if (sizeAtCorner > 0.0) {
    SizeSource source;
    source.points[0] = Vec3(0.0);
    source.size = sizeAtCorner;
    grid.sources.push_back(source);
  }
  const SurfaceMesh cube = gridCube(1);
  SurfaceRemesher remesher(cube.points, cube.triangles, {}, grid, {});
  while (!remesher.advance(1U << 20U)) {
  }
  return remesher.result().triangles.size() / 3;
}

TEST(Remesh, SourcesCapAutomaticSizesAndReplaceNone) {
  const std::size_t automatic = countWithSource(0.0);
  EXPECT_EQ(countWithSource(1.0), automatic);
  EXPECT_GT(countWithSource(0.01), automatic);
}

/// A tetrahedron around the bodies with one target size everywhere.
BackgroundGrid constantGrid(BackgroundNode node) {
  BackgroundGrid grid;
  for (const Vec3& position : {Vec3(-30.0, -30.0, -30.0), Vec3(90.0, -30.0, -30.0),
                               Vec3(-30.0, 90.0, -30.0), Vec3(-30.0, -30.0, 90.0)}) {
    node.position = position;
    grid.nodes.push_back(node);
  }
  grid.tetrahedra = {{0, 1, 2, 3}};
  return grid;
}

struct MetricFigures {
  double share = 0.0;      ///< of the edges with a length of 0.6 to 1.5
  double meanRatio = 0.0;  ///< mean radius ratio
};

/// Measures triangles in the space in which the target element is regular with edge 1.
MetricFigures measureInMetric(const SurfaceMesh& mesh, const BackgroundNode& target) {
  const Vec3 along = glm::normalize(target.direction);
  const auto toUnit = [&](const Vec3& p) {
    return (p - along * (glm::dot(p, along) * (1.0 - 1.0 / target.stretching))) / target.size;
  };
  MetricFigures figures;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(mesh))) {
    const auto [a, b, c] = cornersOf(mesh, t);
    const Corners corners{toUnit(a), toUnit(b), toUnit(c)};
    figures.meanRatio += triangleRadiusRatio(corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double length = glm::length(corners[(k + 1) % 3] - corners[k]);
      if (length >= 0.6 && length <= 1.5) figures.share += 1.0 / 3.0;
    }
  }
  figures.share /= countTriangles(mesh);
  figures.meanRatio /= countTriangles(mesh);
  return figures;
}

/// The tolerance caps long edges across a bend, but neither edges along the bend nor short edges across it.
TEST(RemeshStretched, TrianglesFollowTheMetric) {
  const std::vector<std::pair<Body, double>> bodies{
      {{"box", [] { return gridBox(Vec3(0.0), Vec3(2.0, 1.0, 1.0), {1, 1, 1}); }}, 0.05},
      {{"cylinder", [] { return coarseBar(64, 2.0); }}, 0.05},
      {{"tube", [] { return coarseTube(64, 0.5, 2.0); }}, 0.05},
      {{"sphere", [] { return geodesicSphere(12); }}, 0.05},
      {{"cylinder with a narrow tolerance", [] { return coarseBar(64, 2.0); }}, 2e-3},
      {{"tube with a narrow tolerance", [] { return coarseTube(64, 0.5, 2.0); }}, 2e-3},
  };
  for (const auto& [body, tolerance] : bodies) {
    const SurfaceMesh given = body.make();
    for (const double stretching : {4.0, 10.0}) {
      for (const Vec3& direction :
           {Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 0.6, 0.4)}) {
        if (tolerance < 0.01 && direction.x > 0.0) continue;
        if (stretching < 10.0 && direction.y == 0.0) continue;
        const BackgroundNode target{Vec3(0.0), 0.08, stretching, direction};
        RemeshOptions options;
        options.tolerance = tolerance;
        SurfaceRemesher remesher(given.points, given.triangles, {}, constantGrid(target), options);
        while (!remesher.advance(1U << 20U)) {
        }
        const SurfaceRemesh& result = remesher.result();
        ASSERT_TRUE(result.diagnostics.empty());
        const MetricFigures figures = measureInMetric(surfaceOf(result), target);
        EXPECT_GE(figures.share, 0.95) << body << ' ' << stretching << ' ' << direction.x;
        EXPECT_GE(figures.meanRatio, 0.85) << body << ' ' << stretching << ' ' << direction.x;
        EXPECT_LE(result.deviation, result.tolerance);
      }
    }
  }
}

/// The expected number of triangles is that of the stretched ones, not of small ones without stretching.
TEST(RemeshStretched, TheLimitOfTrianglesCountsStretchedOnes) {
  const SurfaceMesh given = gridBox(Vec3(0.0), Vec3(2.0, 1.0, 1.0), {1, 1, 1});
  const BackgroundNode target{Vec3(0.0), 0.08, 10.0, Vec3(1.0, 0.6, 0.4)};
  const auto made = [&](std::uint32_t maxTriangles) {
    RemeshOptions options;
    options.tolerance = 0.05;
    options.maxTriangles = maxTriangles;
    SurfaceRemesher remesher(given.points, given.triangles, {}, constantGrid(target), options);
    while (!remesher.advance(1U << 20U)) {
    }
    return remesher.result();
  };
  const std::size_t count = made(1'000'000).triangles.size() / 3;
  EXPECT_TRUE(
      made(static_cast<std::uint32_t>(1.6 * static_cast<double>(count))).diagnostics.empty());
  EXPECT_FALSE(
      made(static_cast<std::uint32_t>(0.4 * static_cast<double>(count))).diagnostics.empty());
}

TEST(Remesh, LayersAndAnglePerEdgeAlsoCountWithASize) {
  RemeshOptions options;
  options.size = 0.5;
  const SurfaceMesh plate = thinPlate(4, 0.1);
  const std::size_t count = remesh(plate, options).triangles.size();
  options.layers = 1.0;
  EXPECT_GT(remesh(plate, options).triangles.size(), 2 * count);
  options.layers = -1.0;
  options.tolerance = 0.1;
  const SurfaceMesh sphere = geodesicSphere(24);
  const std::size_t coarse = remesh(sphere, options).triangles.size();
  options.anglePerEdge = 10.0;
  EXPECT_GT(remesh(sphere, options).triangles.size(), 2 * coarse);
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

/// A unit cube whose top and front have nodes this far from their common edge.
SurfaceMesh cubeWithCaps(double height) {
  SurfaceMesh cube;
  for (const Vec3& p :
       {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0),
        Vec3(0.0, 0.0, 1.0), Vec3(1.0, 0.0, 1.0), Vec3(1.0, 1.0, 1.0), Vec3(0.0, 1.0, 1.0),
        Vec3(0.4, height, 1.0), Vec3(0.7, 0.0, 1.0 - height)}) {
    cube.points.insert(cube.points.end(), {p.x, p.y, p.z});
  }
  cube.triangles = {0, 2, 1, 0, 3, 2, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7,
                    0, 1, 9, 1, 5, 9, 5, 4, 9, 4, 0, 9, 4, 5, 8, 5, 6, 8, 6, 7, 8, 7, 4, 8};
  return cube;
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
  for (const char* where : {"sharp edge", "in the face", "across the face"}) {
    for (const double height : {1e-8, 1e-9, 1e-12, 1e-14}) {
      for (const double other : {0.7, 0.401, 0.400001, 0.4}) {
        for (const std::uint64_t seed : {0U, 1U}) {
          SurfaceMesh given = cubeWithTwinCaps(where, height, 0.4, other);
          if (seed > 0) rotateRandomly(given, seed);
          const SurfaceRemesh result = remesh(given);
          ASSERT_TRUE(result.diagnostics.empty());
          EXPECT_EQ(result.featureLines, 12U) << where << ' ' << height << ' ' << other;
          EXPECT_GT(result.smallestAngle, 20.0) << where << ' ' << height << ' ' << other;
        }
      }
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
  const SurfaceMesh once = surfaceOf(remesh(torus(2.0, 0.7, 48, 24), options));
  const SurfaceMesh twice = surfaceOf(remesh(once, options));
  EXPECT_NEAR(countTriangles(twice), countTriangles(once), 0.2 * countTriangles(once));
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

TEST(Remesh, ReturnsAValidSurfaceWheneverItIsStopped) {
  const SurfaceMesh given = screwThread(1, 8);
  RemeshOptions options;
  options.size = 0.4;
  const SurfaceRemesh whole = remesh(given, options);
  ASSERT_TRUE(whole.diagnostics.empty());
  EXPECT_FALSE(whole.isPartial);
  int allSlices = 0;
  for (SurfaceRemesher remesher(given.points, given.triangles, {}, {}, options);
       !remesher.advance(100);)
    ++allSlices;
  std::size_t between = 0;
  for (const double part : {0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.9}) {
    const int slices = static_cast<int>(part * allSlices);
    SurfaceRemesher remesher(given.points, given.triangles, {}, {}, options);
    for (int i = 0; i < slices; ++i) remesher.advance(100);
    remesher.stop();
    while (!remesher.advance(100)) {
    }
    const SurfaceRemesh& result = remesher.result();
    EXPECT_TRUE(result.isPartial) << slices;
    EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kCavities).empty()) << slices;
    EXPECT_LE(sampledDistance(surfaceOf(result), given, 20), result.deviation) << slices;
    EXPECT_LE(sampledDistance(given, surfaceOf(result), 20), result.deviation) << slices;
    if (result.triangles != given.triangles && result.triangles != whole.triangles) ++between;
  }
  EXPECT_GT(between, 2U);
}

TEST(RemeshDetails, AreKeptUnlessAsked) {
  const SurfaceRemesh result = remesh(blockWithStep(0.004));
  EXPECT_TRUE(result.mergedDetails.empty());
  EXPECT_NEAR(std::fabs(enclosedVolume(surfaceOf(result))), 8.0 + 0.004 * 4.0, 1e-9);
}

TEST(RemeshDetails, HaveSmallTrianglesUnlessASmallestSizeIsGiven) {
  const SurfaceMesh given = blockWithStep(0.004);
  const SurfaceRemesh automatic = remesh(given);
  EXPECT_GT(automatic.smallestAngle, 20.0);
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
    options.minSize = diagonalOf(given) / 60.0;
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
      options.minSize = diagonalOf(bodies[i]) / 20.0;
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

TEST(Remesh, RefusesSizesThatAskForTooManyTriangles) {
  RemeshOptions options;
  options.size = 1e-9;
  const SurfaceRemesh result = remesh(gridCube(1), options);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(result.diagnostics[0].code, DiagnosticCode::kTooManyElements);
  EXPECT_EQ(result.diagnostics[0].entities.at(0).kind, EntityKind::kTriangle);
  // Estimates are reported up to 1e15.
  EXPECT_NEAR(result.diagnostics[0].values[0], 1e15, 1.0);

  // The given triangles are never too many, and the estimate is near the real number.
  options.size = 0.1;
  const std::size_t count = remesh(gridCube(1), options).triangles.size() / 3;
  options.maxTriangles = static_cast<std::uint32_t>(1.2 * static_cast<double>(count));
  EXPECT_TRUE(remesh(gridCube(1), options).diagnostics.empty());
  options.maxTriangles = static_cast<std::uint32_t>(0.8 * static_cast<double>(count));
  EXPECT_FALSE(remesh(gridCube(1), options).diagnostics.empty());
  EXPECT_TRUE(remesh(gridCube(20), options).diagnostics.empty());
}

// ---- every single operation ---------------------------------------------------------------------

/// A surface with an editor, for tests that make random operations.
class EditedSurface {
 public:
  EditedSurface(const SurfaceMesh& mesh, double tolerance, double size)
      : mesh_(mesh), reference_(mesh_, {}, FeatureRules{}), sizes_(SizeField::uniform(size)) {
    Job<> job([this](Work& work) { return reference_.prepare(work); });
    job.finish();
    SurfaceLimits limits;
    limits.tolerance = tolerance;
    surface_.emplace(reference_, limits, size);
    editor_.emplace(*surface_, sizes_);
  }

  [[nodiscard]] const SurfaceComplex& complex() const { return surface_->complex(); }
  [[nodiscard]] const ReferenceSurface& reference() const { return reference_; }
  [[nodiscard]] SurfaceEditor& editor() { return *editor_; }

 private:
  SurfaceMesh mesh_;
  ReferenceSurface reference_;
  RemeshSizes sizes_;
  std::optional<GuardedSurface> surface_;
  std::optional<SurfaceEditor> editor_;
};

/// Returns true if two triangles of the surface intersect: tests all pairs.
bool anyIntersect(const SurfaceMesh& mesh) {
  for (std::uint32_t t = 0; t < countTriangles(mesh); ++t) {
    for (std::uint32_t u = 0; u < t; ++u) {
      if (intersectImproperly(numberedTriangle(mesh, TriangleId(t)),
                              numberedTriangle(mesh, TriangleId(u))))
        return true;
    }
  }
  return false;
}

/// Returns true if the triangles at a feature edge enclose at least half the angle with this cosine.
bool isSharp(const SurfaceComplex& complex, HalfEdgeId halfEdge, double creaseCosine) {
  const auto [from, to, apex] = complex.nodesOf(halfEdge);
  std::vector<HalfEdgeId> edge;
  complex.collectEdge(from, to, edge);
  if (edge.size() != 2) return true;
  std::array<Vec3, 2> normals{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [a, b, c] = complex.cornersOf(triangleOf(edge[i]));
    normals[i] = glm::normalize(glm::cross(b - a, c - a));
  }
  const double angle = std::acos(std::clamp(glm::dot(normals[0], normals[1]), -1.0, 1.0));
  return angle >= 0.5 * std::acos(creaseCosine) - 1e-9;
}

TEST(RemeshAbsorb, PutsTheApexOnTheLine) {
  const SurfaceMesh given = cubeWithCaps(1e-5);
  EditedSurface edited(given, 1e-3, 0.2);
  const SurfaceComplex& complex = edited.complex();
  const NodeId apex(8U);
  EXPECT_EQ(complex.kindOf(apex), NodeKind::kSmooth);
  EXPECT_FALSE(edited.editor().absorb(NodeId(5U), NodeId(6U)));
  ASSERT_TRUE(edited.editor().absorb(NodeId(4U), NodeId(5U)));
  EXPECT_EQ(complex.kindOf(apex), NodeKind::kLine);
  EXPECT_FALSE(complex.areJoined(NodeId(4U), NodeId(5U)));
  const SurfaceComplex::LineNeighbours line = complex.lineNeighbours(apex);
  ASSERT_TRUE(line.areComplete());
  EXPECT_EQ(std::min(line.before, line.after), NodeId(4U));
  EXPECT_EQ(std::max(line.before, line.after), NodeId(5U));
  const SurfaceMesh now = surfaceOf(complex);
  EXPECT_TRUE(errorsOf(now, InnerShells::kCavities).empty());
  EXPECT_NEAR(enclosedVolume(now), 1.0, 1e-5);
}

class RemeshOperations : public ::testing::TestWithParam<Body> {};

TEST_P(RemeshOperations, EachKeepsTheSurfaceValid) {
  const SurfaceMesh given = GetParam().make();
  const double tolerance = 0.01 * diagonalOf(given);
  EditedSurface edited(given, tolerance, 0.1 * diagonalOf(given));
  const SurfaceComplex& complex = edited.complex();
  std::mt19937_64 random(3);
  const auto below = [&](std::size_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  const CollapseRule anyCollapse{100.0, 0.0, false};
  int made = 0;
  for (int i = 0; i < 300; ++i) {
    const TriangleId t(below(complex.triangleSlots()));
    if (!complex.isAlive(t)) continue;
    const std::uint32_t k = below(3);
    const NodeId a = complex.nodesOf(t)[k];
    const NodeId b = complex.nodesOf(t)[(k + 1) % 3];
    bool isMade = false;
    switch (below(6)) {
      case 0:
        isMade = edited.editor().split(a, b, 0.3 + 0.1 * below(5));
        break;
      case 1:
        isMade = edited.editor().collapse(a, b, anyCollapse);
        break;
      case 2:
        isMade = edited.editor().flip(a, b);
        break;
      case 3:
        isMade = edited.editor().smooth(a);
        break;
      case 4:
        isMade = edited.editor().absorb(a, b);
        break;
      default:
        isMade = edited.editor().improve(a);
    }
    if (!isMade) continue;
    ++made;
    const SurfaceMesh now = surfaceOf(complex);
    ASSERT_FALSE(anyIntersect(now)) << "operation " << i;
    for (const auto& [edge, count] : countEdges(now)) ASSERT_EQ(count % 2, 0U) << "operation " << i;
  }
  EXPECT_GT(made, 30);
  const SurfaceMesh now = surfaceOf(complex);
  EXPECT_TRUE(errorsOf(now, InnerShells::kCavities).empty());
  EXPECT_LE(sampledDistance(now, given, 300), tolerance);
  // Given nodes are within the tolerance of the surface, and corners have not moved.
  for (const NodeId node : IdRange<NodeId>(countNodes(given))) {
    const Vec3 point = pointOf(given, node);
    EXPECT_LE(distanceTo(now, point), tolerance * (1.0 + 1e-9));
    if (edited.reference().isCorner(node)) {
      EXPECT_TRUE(complex.isUsed(node) && complex.pointOf(node) == point);
    }
  }
  // The points of every stretch of a feature line are within the tolerance of its edge.
  double length = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(complex.triangleSlots())) {
    for (std::uint32_t k = 0; complex.isAlive(t) && k < 3; ++k) {
      const HalfEdgeId halfEdge = halfEdgeOf(t, k);
      const StretchId id = complex.stretchOf(halfEdge);
      if (id.isNone()) continue;
      const Stretch& stretch = complex.stretch(id);
      const auto [from, to, apex] = complex.nodesOf(halfEdge);
      const NodeId begin = stretch.from;
      const NodeId end = begin == from ? to : from;
      const FeatureLine& line = edited.reference().line(stretch.line);
      EXPECT_LE(line.squaredDeviation(stretch.begin, stretch.end, complex.pointOf(begin),
                                      complex.pointOf(end)),
                tolerance * tolerance * (1.0 + 1e-9));
      length += stretch.end - stretch.begin;
      EXPECT_TRUE(isSharp(complex, halfEdge, line.creaseCosine));
    }
  }
  // The stretches cover all lines: each counts once per triangle at its edge.
  double expected = 0.0;
  for (const FeatureLine& line : edited.reference().lines()) {
    expected += line.length() * static_cast<double>(line.patches.size());
  }
  EXPECT_NEAR(length, expected, 1e-9 * expected);
}

INSTANTIATE_TEST_SUITE_P(Remesh, RemeshOperations,
                         ::testing::Values(Body{"cube", [] { return gridCube(2); }},
                                           Body{"sphere", [] { return geodesicSphere(4); }},
                                           Body{"tube", [] { return coarseTube(16, 0.6, 2.0); }},
                                           Body{"needle_plate",
                                                [] { return needlePlate(1, 12, 0.1); }},
                                           Body{"blade", [] { return twistedBlade(6, 3, 0.02); }},
                                           Body{"barrel",
                                                [] {
                                                  return solidOfRevolution(
                                                      {{0.8, 0.0}, {1.0, 0.5}, {0.8, 1.0}}, 24, 1);
                                                }},
                                           Body{"shared_edge", [] { return cubesSharingEdge(); }},
                                           Body{"thin_plate", [] { return thinPlate(4, 0.02); }}),
                         [](const auto& tested) { return tested.param.name; });

// ---- the envelope -------------------------------------------------------------------------------

TEST(RemeshEnvelope, AcceptsOnlyTrianglesThatAreNearEverywhere) {
  // A cylinder of 24 facets. Random triangles near it: if one is accepted, every point of it is near.
  const SurfaceMesh given = coarseTube(24, 0.6, 2.0);
  ReferenceSurface reference(given, {}, FeatureRules{});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  const double tolerance = 0.02;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const TriangleId t(static_cast<std::uint32_t>(random() % countTriangles(given)));
    const SmoothPatchId patch = reference.patchOf(t);
    if (reference.patch(patch).isPlanar) continue;
    const Vec3 centre = centroidOf(cornersOf(given, t));
    Corners corners{};
    for (Vec3& corner : corners) {
      const Vec3 offset(0.3 * any(random), 0.3 * any(random), 0.3 * any(random));
      corner = reference.nearest(centre + offset, patch, 10.0, t).position;
    }
    const NearestPoint below = reference.nearest(centroidOf(corners), patch, tolerance, t);
    if (!proveWithin(reference, corners, patch, tolerance, below).isProven) {
      ++refused;
      continue;
    }
    ++accepted;
    for (int n = 0; n < 50; ++n) {
      double u = 0.5 + 0.5 * any(random);
      double v = 0.5 + 0.5 * any(random);
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3 p = corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v;
      EXPECT_LE(distanceTo(given, p), tolerance * (1.0 + 1e-9));
    }
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

}  // namespace
}  // namespace tetrafront::testing
