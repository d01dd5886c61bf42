#include "boundary/boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "support/random.h"
#include "support/shapes.h"
#include "topology/edge_table.h"
#include "topology/half_faces.h"

namespace tetrafront::testing {
namespace {

struct Outcome {
  Boundary result;
  std::vector<Diagnostic> diagnostics;

  [[nodiscard]] std::vector<Diagnostic> of(DiagnosticCode code) const {
    std::vector<Diagnostic> found;
    std::copy_if(diagnostics.begin(), diagnostics.end(), std::back_inserter(found),
                 [code](const Diagnostic& d) { return d.code == code; });
    return found;
  }
  [[nodiscard]] std::set<DiagnosticCode> codes() const {
    std::set<DiagnosticCode> found;
    for (const Diagnostic& d : diagnostics) found.insert(d.code);
    return found;
  }
};

Outcome close(SurfaceMesh& mesh, BoundarySource source = BoundarySource::kGivenSurface,
              InnerShells innerShells = InnerShells::kByOrientation) {
  Outcome outcome;
  outcome.result = closeBoundary(mesh, source, outcome.diagnostics, innerShells);
  const bool hasError =
      std::any_of(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                  [](const Diagnostic& d) { return d.severity == Severity::kError; });
  EXPECT_EQ(outcome.result.isValid, !hasError);
  return outcome;
}

/// Returns the nodes of each triangle in its orientation, the lowest first.
std::vector<std::array<std::uint32_t, 3>> orientationsOf(const SurfaceMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> orientations;
  for (std::size_t h = 0; h < mesh.triangles.size(); h += 3) {
    std::array<std::uint32_t, 3> t{mesh.triangles[h], mesh.triangles[h + 1], mesh.triangles[h + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    orientations.push_back(t);
  }
  return orientations;
}

std::uint32_t regionOf(const SurfaceMesh& mesh, std::size_t triangle) {
  return mesh.triangleRegions.at(2 * triangle);
}

struct Shape {
  const char* name;
  SurfaceMesh mesh;
  std::uint32_t regions;
  std::vector<double> contacts{};  ///< edges and nodes at which it touches itself; empty: none
};

/// Expects that what is told of regions and contacts is true of the shape. Returns the other diagnostics.
std::vector<Diagnostic> withoutTopology(const std::vector<Diagnostic>& diagnostics,
                                        const Shape& shape) {
  std::vector<Diagnostic> others;
  bool isContactTold = false;
  for (const Diagnostic& found : diagnostics) {
    if (found.code == DiagnosticCode::kNestedRegions) {
      EXPECT_EQ(found.values.at(0), shape.regions) << shape.name;
    } else if (found.code == DiagnosticCode::kSurfaceContact) {
      EXPECT_EQ(found.values, shape.contacts) << shape.name;
      EXPECT_EQ(found.severity, Severity::kInformation);
      isContactTold = true;
    } else {
      others.push_back(found);
    }
  }
  EXPECT_EQ(isContactTold, !shape.contacts.empty()) << shape.name;
  return others;
}

std::vector<Shape> validShapes() {
  return {{"sphere", geodesicSphere(6), 1},
          {"latitude sphere", latitudeSphere(9, 14), 1},
          {"cube", gridCube(4, Diagonals::kParallel), 1},
          {"alternating cube", gridCube(4, Diagonals::kAlternating), 1},
          {"union jack cube", gridCube(4, Diagonals::kUnionJack), 1},
          {"random cube", gridCube(4, Diagonals::kRandom, 3), 1},
          {"torus", torus(1.0, 0.3, 24, 12), 1},
          {"cubic cavity", cubeWithCubicCavity(3, 2), 1},
          {"spherical cavity", cubeWithSphericalCavity(3, 3), 1},
          {"prism 30", schoenhardtPrism(30.0), 1},
          {"prism 50", schoenhardtPrism(50.0), 1},
          {"prism 59.99", schoenhardtPrism(59.99), 1},
          {"plate", thinPlate(5, 1e-3), 1},
          {"cubes sharing an edge", cubesSharingEdge(), 2, {1, 0}},
          {"cubes sharing a node", cubesSharingNode(), 2, {0, 1}},
          {"nested spheres", nestedSpheres(5, 3), 3}};
}

TEST(BoundaryTest, ReturnsTheEdgesOfTheTrianglesAsItLeavesThem) {
  SurfaceMesh mesh = geodesicSphere(3);
  Random random(3);
  for (const TriangleId t : IdRange<TriangleId>(mesh.triangles.size() / 3)) {
    if (random.coin()) flipTriangle(mesh, t);
  }
  const Outcome outcome = close(mesh);
  ASSERT_TRUE(outcome.result.edges);
  const EdgeTable expected(mesh.triangles, mesh.points.size() / 3, {});
  ASSERT_EQ(outcome.result.edges->edgeCount(), expected.edgeCount());
  for (const EdgeId edge : IdRange<EdgeId>(expected.edgeCount())) {
    EXPECT_TRUE(
        std::ranges::equal(outcome.result.edges->halfEdgesOf(edge), expected.halfEdgesOf(edge)));
  }
}

TEST(BoundaryTest, LeavesValidOutwardSurfacesUnchanged) {
  for (Shape& shape : validShapes()) {
    const SurfaceMesh before = shape.mesh;
    const Outcome outcome = close(shape.mesh);
    EXPECT_TRUE(withoutTopology(outcome.diagnostics, shape).empty()) << shape.name;
    EXPECT_EQ(outcome.result.regionCount, shape.regions) << shape.name;
    EXPECT_EQ(shape.mesh.triangleRegions.size(), 2 * triangleCount(before)) << shape.name;
    EXPECT_EQ(shape.mesh.triangles, before.triangles) << shape.name;
    EXPECT_EQ(shape.mesh.points, before.points) << shape.name;
  }
}

TEST(BoundaryTest, RestoresRandomlyFlippedTriangles) {
  for (Shape& shape : validShapes()) {
    const auto expected = orientationsOf(shape.mesh);
    flipRandomly(shape.mesh, 11);
    const Outcome outcome =
        close(shape.mesh, BoundarySource::kGivenSurface, InnerShells::kCavities);
    ASSERT_TRUE(outcome.result.isValid) << shape.name;
    EXPECT_EQ(orientationsOf(shape.mesh), expected) << shape.name;
    const std::vector<Diagnostic> told = withoutTopology(outcome.diagnostics, shape);
    EXPECT_FALSE(told.empty()) << shape.name;
    for (const Diagnostic& found : told) {
      EXPECT_EQ(found.code, DiagnosticCode::kReorientedPatch) << shape.name;
    }
  }
}

TEST(BoundaryTest, RefusesComponentsOfMixedOrientationOnRequest) {
  for (Shape& shape : validShapes()) {
    const SurfaceMesh valid = shape.mesh;
    flipRandomly(shape.mesh, 11);
    std::set<std::uint32_t> flipped;
    for (std::uint32_t t = 0; t < triangleCount(valid); ++t) {
      if (shape.mesh.triangles[3 * t + 1] != valid.triangles[3 * t + 1]) flipped.insert(t);
    }
    BoundaryCheck check(shape.mesh, BoundarySource::kGivenSurface, InnerShells::kCavities,
                        MixedOrientation::kRefuse);
    while (!check.advance(1U << 16U)) {
    }
    EXPECT_FALSE(check.result().isValid) << shape.name;
    std::set<std::uint32_t> named;
    for (const Diagnostic& found : check.diagnostics()) {
      if (found.code != DiagnosticCode::kFlippedTriangle) continue;
      EXPECT_EQ(found.severity, Severity::kError);
      EXPECT_EQ(found.values.back(), static_cast<double>(flipped.size())) << shape.name;
      ASSERT_EQ(found.entities.size(), 1U);
      named.insert(found.entities[0].index);
    }
    EXPECT_EQ(named, flipped) << shape.name;
  }
}

TEST(BoundaryTest, AcceptsComponentsThatAreFlippedAsAWhole) {
  for (Shape& shape : validShapes()) {
    const auto expected = orientationsOf(shape.mesh);
    turnInsideOut(shape.mesh);
    BoundaryCheck check(shape.mesh, BoundarySource::kGivenSurface, InnerShells::kCavities,
                        MixedOrientation::kRefuse);
    while (!check.advance(1U << 16U)) {
    }
    EXPECT_TRUE(check.result().isValid) << shape.name;
    EXPECT_EQ(orientationsOf(shape.mesh), expected) << shape.name;
  }
}

TEST(BoundaryTest, OrientsFlippedSurfacesOutward) {
  for (Shape& shape : validShapes()) {
    const auto expected = orientationsOf(shape.mesh);
    const std::size_t triangles = triangleCount(shape.mesh);
    turnInsideOut(shape.mesh);
    const Outcome outcome = close(shape.mesh);
    ASSERT_TRUE(outcome.result.isValid) << shape.name;
    EXPECT_EQ(orientationsOf(shape.mesh), expected) << shape.name;
    double flipped = 0.0;
    for (const Diagnostic& d : withoutTopology(outcome.diagnostics, shape)) {
      EXPECT_EQ(d.severity, Severity::kInformation);
      flipped += d.values.at(0);
      EXPECT_EQ(d.values.at(0), d.values.at(1)) << "all triangles of the component";
    }
    EXPECT_EQ(flipped, static_cast<double>(triangles)) << shape.name;
  }
}

TEST(BoundaryTest, IsInvariantUnderRotationTranslationScalingAndReflection) {
  const std::vector<Shape> shapes = validShapes();
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Shape& shape = shapes[seed % shapes.size()];
    SurfaceMesh mesh = shape.mesh;
    Random random(500 + seed);
    rotateRandomly(mesh, seed);
    if (random.coin()) mirror(mesh);
    if (random.coin()) scale(mesh, random.coin() ? 1e9 : 1e-9);
    if (random.coin()) translate(mesh, Vec3(1e3, -1e3, 5e2));
    shuffle(mesh, seed);
    const auto expected = orientationsOf(mesh);
    flipRandomly(mesh, seed);
    const Outcome outcome = close(mesh, BoundarySource::kGivenSurface, InnerShells::kCavities);
    // If a model of size 1e-9 is moved to 1e3, rounding can make nodes coincide or a thin plate intersect itself.
    // The check must report this and nothing else.
    if (!outcome.result.isValid) {
      EXPECT_TRUE(outcome.codes().contains(DiagnosticCode::kCoincidentNodes) ||
                  outcome.codes().contains(DiagnosticCode::kSelfIntersection) ||
                  outcome.codes().contains(DiagnosticCode::kDegenerateTriangle))
          << shape.name << " seed " << seed;
      continue;
    }
    EXPECT_EQ(orientationsOf(mesh), expected) << shape.name << " seed " << seed;
    EXPECT_EQ(outcome.result.regionCount, shape.regions) << shape.name << " seed " << seed;
  }
}

TEST(BoundaryTest, CavityBelongsToTheRegionAroundIt) {
  SurfaceMesh mesh = cubeWithCubicCavity(2, 1);
  const std::size_t outer = triangleCount(gridCube(2));
  const Outcome outcome = close(mesh);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(regionOf(mesh, 0), 0U);
  EXPECT_EQ(regionOf(mesh, outer), 0U);
  EXPECT_NEAR(enclosedVolume(mesh), 1.0 - 0.125, 1e-14);
  EXPECT_EQ(mesh.trianglePatch.at(0), 0U);
  EXPECT_EQ(mesh.trianglePatch.at(outer), 1U);
}

TEST(BoundaryTest, NestedShellsBoundRegionsAndCavitiesInTurn) {
  constexpr int kDepth = 5;
  SurfaceMesh mesh = nestedSpheres(kDepth, 2);
  const std::size_t each = triangleCount(mesh) / kDepth;
  flipRandomly(mesh, 12);
  const Outcome outcome = close(mesh, BoundarySource::kGivenSurface, InnerShells::kCavities);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(outcome.result.regionCount, 3U);
  const std::array<std::uint32_t, kDepth> regions{0, 0, 1, 1, 2};
  for (std::size_t level = 0; level < kDepth; ++level) {
    EXPECT_EQ(regionOf(mesh, level * each), regions[level]) << "level " << level;
  }
}

/// Returns the regions of the two half-faces of each triangle, as an unordered pair.
std::multiset<std::pair<std::uint32_t, std::uint32_t>> halfFacesOf(const SurfaceMesh& mesh) {
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    sides.insert(std::minmax(mesh.triangleRegions[2 * t], mesh.triangleRegions[2 * t + 1]));
  }
  return sides;
}

TEST(BoundaryInterfacesTest, EveryEnclosedVolumeIsARegion) {
  for (const std::array<int, 3>& counts :
       {std::array{2, 1, 1}, std::array{2, 2, 1}, std::array{2, 2, 2}, std::array{3, 3, 3}}) {
    const std::size_t cubes = static_cast<std::size_t>(counts[0] * counts[1] * counts[2]);
    SurfaceMesh mesh = dividedBox(counts, 2);
    const SurfaceMesh before = mesh;
    const Outcome outcome = close(mesh);
    ASSERT_TRUE(outcome.result.isValid);
    EXPECT_EQ(mesh.triangles, before.triangles) << "oriented outward already, and interfaces stay";
    EXPECT_EQ(outcome.result.regionCount, cubes);
    ASSERT_EQ(outcome.diagnostics.size(), 1U);
    EXPECT_EQ(outcome.diagnostics[0].code, DiagnosticCode::kNestedRegions);
    EXPECT_EQ(outcome.diagnostics[0].values, (std::vector{static_cast<double>(cubes), 0.0}));
    const std::vector<double> volumes = regionVolumes(mesh);
    ASSERT_EQ(volumes.size(), cubes);
    for (const double volume : volumes) EXPECT_NEAR(volume, 1.0, 1e-12);
    const auto sides = halfFacesOf(mesh);
    for (std::uint32_t region = 0; region < cubes; ++region) {
      EXPECT_EQ(sides.count({region, region}), 0U);
    }
  }
}

TEST(BoundaryInterfacesTest, FindsRegionsInAnyOrientationAndNumbering) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SurfaceMesh mesh = dividedBox({2, 2, 2}, 2);
    rotateRandomly(mesh, seed);
    shuffle(mesh, seed);
    flipRandomly(mesh, seed);
    const Outcome outcome = close(mesh);
    ASSERT_TRUE(outcome.result.isValid) << seed;
    EXPECT_EQ(outcome.result.regionCount, 8U) << seed;
    for (const double volume : regionVolumes(mesh)) EXPECT_NEAR(volume, 1.0, 1e-12) << seed;
    const auto sides = halfFacesOf(mesh);
    std::size_t outer = 0;
    for (std::uint32_t region = 0; region < 8; ++region)
      outer += sides.count({region, SurfaceMesh::kNoRegion});
    EXPECT_EQ(outer, 6U * 4U * 8U) << seed;
    for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
      EXPECT_NE(mesh.triangleRegions[2 * t], SurfaceMesh::kNoRegion) << "back is inside";
    }
  }
}

/// Components inside regions: one without interfaces bounds a cavity, one with interfaces bounds regions.
TEST(BoundaryInterfacesTest, ComponentsInsideRegions) {
  SurfaceMesh mesh = dividedBox({2, 1, 1}, 1);
  SurfaceMesh cavity = gridCube(1);
  scale(cavity, 0.5);
  translate(cavity, Vec3(0.25));
  append(mesh, cavity);
  SurfaceMesh divided = dividedBox({2, 1, 1}, 1);
  scale(divided, 0.25);
  translate(divided, Vec3(1.25, 0.25, 0.25));
  append(mesh, divided);
  const Outcome outcome = close(mesh, BoundarySource::kGivenSurface, InnerShells::kCavities);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(outcome.result.regionCount, 4U);
  std::vector<double> volumes = regionVolumes(mesh);
  std::ranges::sort(volumes);
  ASSERT_EQ(volumes.size(), 4U);
  EXPECT_NEAR(volumes[0], 0.015625, 1e-12);
  EXPECT_NEAR(volumes[1], 0.015625, 1e-12);
  EXPECT_NEAR(volumes[2], 1.0 - 0.125, 1e-12);
  EXPECT_NEAR(volumes[3], 1.0 - 2 * 0.015625, 1e-12);
}

TEST(BoundaryInterfacesTest, AnInterfaceWithAHoleHasOpenEdges) {
  SurfaceMesh mesh = dividedBox({2, 1, 1}, 3);
  // Remove the two triangles of the middle square of the interface.
  std::vector<std::uint32_t> kept;
  for (std::size_t h = 0; h < mesh.triangles.size(); h += 3) {
    bool isMiddle = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = pointOf(mesh, mesh.triangles[h + k]);
      isMiddle = isMiddle && p.x == 1.0 && glm::length(p - Vec3(1.0, 0.5, 0.5)) < 0.3;
    }
    if (isMiddle) continue;
    kept.insert(kept.end(), &mesh.triangles[h], &mesh.triangles[h] + 3);
  }
  EXPECT_EQ(mesh.triangles.size() - kept.size(), 6U);
  mesh.triangles = kept;
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kOpenEdge});
  EXPECT_EQ(outcome.diagnostics.size(), 4U);
}

/// A ring with a single cut is still one region, on both sides of the cut.
TEST(BoundaryInterfacesTest, ReportsADanglingSheet) {
  constexpr int kMinor = 6;
  SurfaceMesh inside = torus(1.0, 0.3, 12, kMinor);
  // A meridian: the nodes of largest x with y = 0.
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i < nodeCount(inside); ++i) {
    const Vec3 p = pointOf(inside, i);
    if (p.x > 0.0 && std::fabs(p.y) < 1e-12) rim.push_back(i);
  }
  ASSERT_EQ(rim.size(), static_cast<std::size_t>(kMinor));
  std::ranges::sort(rim, {}, [&](std::uint32_t i) {
    return std::atan2(pointOf(inside, i).z, pointOf(inside, i).x - 1.0);
  });
  for (std::size_t k = 1; k + 1 < rim.size(); ++k)
    inside.triangles.insert(inside.triangles.end(), {rim[0], rim[k], rim[k + 1]});
  const Outcome outcome = close(inside);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kDanglingSheet});
  EXPECT_EQ(outcome.diagnostics.size(), static_cast<std::size_t>(kMinor - 2));
  EXPECT_EQ(outcome.diagnostics[0].entities.at(0).index, 2U * 12U * kMinor);
}

/// Nested boxes: for each, whether it faces outward and the region expected behind its triangles, inside the box.
struct NestedBoxes {
  const char* name;
  std::vector<bool> facesOutward;  ///< from the outermost box to the innermost
  std::vector<double> volumes;     ///< of the regions, in ascending order
};

/// Boxes from 0 to 8, 1 to 7 and so on, divided so that the volumes are 512, 216, 64 and 8.
SurfaceMesh nestedBoxesOf(const std::vector<bool>& facesOutward) {
  SurfaceMesh mesh;
  for (std::size_t i = 0; i < facesOutward.size(); ++i) {
    const auto inset = static_cast<double>(i);
    SurfaceMesh box = gridBox(Vec3(inset), Vec3(8.0 - inset), {2, 2, 2});
    if (!facesOutward[i]) {
      for (std::size_t h = 0; h < box.triangles.size(); h += 3)
        std::swap(box.triangles[h + 1], box.triangles[h + 2]);
    }
    append(mesh, box);
  }
  return mesh;
}

TEST(BoundaryTest, NestedShellsThatFaceTheSameWayAreBodies) {
  const std::vector<NestedBoxes> cases{
      {"inclusion", {true, true}, {216, 512 - 216}},
      {"void", {true, false}, {512 - 216}},
      {"inclusion in an inclusion", {true, true, true}, {64, 216 - 64, 512 - 216}},
      {"void in an inclusion", {true, true, false}, {216 - 64, 512 - 216}},
      {"body in a void", {true, false, true}, {64, 512 - 216}},
      {"void in a body in a void", {true, false, true, false}, {64 - 8, 512 - 216}},
      {"inclusion in a body in a void", {true, false, true, true}, {8, 64 - 8, 512 - 216}},
      {"all inverted: inclusion", {false, false}, {216, 512 - 216}},
      {"all inverted: void", {false, true}, {512 - 216}},
      {"all inverted: void in an inclusion", {false, false, true}, {216 - 64, 512 - 216}},
      {"a void has nothing to be empty in", {true, false, false}, {64, 512 - 216}},
  };
  for (const NestedBoxes& nested : cases) {
    SurfaceMesh mesh = nestedBoxesOf(nested.facesOutward);
    const Outcome outcome = close(mesh);
    ASSERT_TRUE(outcome.result.isValid) << nested.name;
    std::vector<double> volumes = regionVolumes(mesh);
    std::ranges::sort(volumes);
    std::vector<double> expected = nested.volumes;
    std::ranges::sort(expected);
    ASSERT_EQ(volumes.size(), expected.size()) << nested.name;
    for (std::size_t i = 0; i < volumes.size(); ++i)
      EXPECT_NEAR(volumes[i], expected[i], 1e-9) << nested.name;
    // What was oriented has the same regions.
    EXPECT_EQ(close(mesh).result.regionCount, expected.size()) << nested.name;
  }
}

/// One flipped triangle of many does not make a body a cavity; shells of random orientation bound cavities, as they always did.
TEST(BoundaryTest, AFewFlippedTrianglesDoNotDecide) {
  SurfaceMesh mesh = nestedBoxesOf({true, true});
  std::swap(mesh.triangles.end()[-1], mesh.triangles.end()[-2]);
  SurfaceMesh random = nestedBoxesOf({true, true});
  flipRandomly(random, 4);
  EXPECT_EQ(close(mesh).result.regionCount, 2U);
  EXPECT_EQ(close(random).result.regionCount, 1U);
}

TEST(BoundaryTest, TheOrientationOfDrawnPatchesMeansNothing) {
  SurfaceMesh mesh = nestedBoxesOf({true, true});
  mesh.trianglePatch.assign(triangleCount(mesh), 0);
  EXPECT_EQ(close(mesh, BoundarySource::kDrawnPatches).result.regionCount, 1U);
}

/// A cavity belongs to the smallest region around it, in any order of the triangles.
TEST(BoundaryTest, TwoCavitiesAndARegionInsideOneOfThem) {
  const auto box = [](double from, double to) { return gridBox(Vec3(from), Vec3(to), {1, 1, 1}); };
  SurfaceMesh mesh = box(0.6, 0.8);  // a region in the next cavity
  append(mesh, box(0.5, 0.9));       // a cavity
  append(mesh, box(0.1, 0.2));       // another cavity
  append(mesh, box(0.0, 1.0));       // the outer boundary
  append(mesh, box(2.0, 3.0));       // a separate region
  const Outcome outcome = close(mesh, BoundarySource::kGivenSurface, InnerShells::kCavities);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(outcome.result.regionCount, 3U);
  const std::array<std::uint32_t, 5> regions{0, 1, 1, 1, 2};
  for (std::size_t shell = 0; shell < regions.size(); ++shell) {
    EXPECT_EQ(regionOf(mesh, 12 * shell), regions[shell]) << "shell " << shell;
  }
  EXPECT_NEAR(enclosedVolume(mesh), 0.008 + (1.0 - 0.064 - 0.001) + 1.0, 1e-12);
}

TEST(BoundaryTest, CubesThatShareAnEdgeAreTwoRegions) {
  SurfaceMesh mesh = cubesSharingEdge();
  flipRandomly(mesh, 13);
  const Outcome outcome = close(mesh);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(outcome.result.regionCount, 2U);
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    EXPECT_EQ(regionOf(mesh, t), t < 12 ? 0U : 1U) << "triangle " << t;
  }
  EXPECT_NEAR(enclosedVolume(mesh), 2.0, 1e-14);
}

/// Two notches of a cube that share an edge leave one region with a non-manifold edge.
TEST(BoundaryTest, ARegionWithANonManifoldEdgeIsOneRegion) {
  // Two diagonally opposite cubes on a slab of 2 x 2 cubes, which connects them.
  SurfaceMesh mesh;
  std::vector<std::array<int, 3>> cells{{0, 0, 1}, {1, 1, 1}, {0, 0, 0},
                                        {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const auto isSolid = [&](std::array<int, 3> c) {
    return std::find(cells.begin(), cells.end(), c) != cells.end();
  };
  std::vector<std::array<int, 3>> nodes;
  const auto node = [&](std::array<int, 3> position) {
    const auto at = std::find(nodes.begin(), nodes.end(), position);
    const auto index = static_cast<std::uint32_t>(at - nodes.begin());
    if (at == nodes.end()) {
      nodes.push_back(position);
      for (const int c : position) mesh.points.push_back(c);
    }
    return index;
  };
  for (const auto& cell : cells) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> other = cell;
        other[axis] += 2 * side - 1;
        if (isSolid(other)) continue;
        std::array<std::uint32_t, 4> quad{};
        constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t q = 0; q < 4; ++q) {
          std::array<int, 3> corner = cell;
          corner[axis] += side;
          corner[(axis + 1) % 3] += kCorners[q][0];
          corner[(axis + 2) % 3] += kCorners[q][1];
          quad[q] = node(corner);
        }
        mesh.triangles.insert(mesh.triangles.end(),
                              {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
      }
    }
  }
  const Outcome outcome = close(mesh);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(outcome.result.regionCount, 1U);
  EXPECT_NEAR(enclosedVolume(mesh), 6.0, 1e-14);
}

// ---- each diagnostic ---------------------------------------------------------------------------

TEST(BoundaryDiagnosticsTest, EmptySurface) {
  SurfaceMesh mesh;
  EXPECT_EQ(close(mesh).codes(), std::set{DiagnosticCode::kEmptyModel});
}

TEST(BoundaryDiagnosticsTest, CoordinatesOutOfRange) {
  for (const double invalid : {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity(), 1e200, 1e-200}) {
    SurfaceMesh mesh = geodesicSphere(2);
    mesh.points[3 * 7 + 1] = invalid;
    const Outcome outcome = close(mesh);
    EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kNotFinite});
    EXPECT_EQ(outcome.diagnostics.at(0).entities.at(0).kind, EntityKind::kSurfaceNode);
    EXPECT_EQ(outcome.diagnostics.at(0).entities.at(0).index, 7U);
  }
  // If no coordinate is in range, the extent is unknown and not reported.
  SurfaceMesh huge = geodesicSphere(2);
  scale(huge, 1e150);
  for (const Diagnostic& found : close(huge).diagnostics)
    EXPECT_GT(std::fabs(found.values.at(0)), 1e30);
  SurfaceMesh tiny = geodesicSphere(2);
  scale(tiny, 1e-60);
  EXPECT_EQ(close(tiny).codes(), std::set{DiagnosticCode::kNotFinite});
}

TEST(BoundaryDiagnosticsTest, IndexOutOfRange) {
  SurfaceMesh mesh = geodesicSphere(2);
  mesh.triangles[3 * 5 + 2] = 4000;
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kIndexOutOfRange});
  EXPECT_EQ(outcome.diagnostics.at(0).entities.at(0).index, 5U);
  EXPECT_EQ(outcome.diagnostics.at(0).values.at(0), 4000.0);
}

TEST(BoundaryDiagnosticsTest, IncompleteNodesAndTriangles) {
  for (const std::size_t missing : {1U, 2U}) {
    SurfaceMesh mesh = geodesicSphere(2);
    const std::size_t triangles = triangleCount(mesh);
    mesh.triangles.resize(mesh.triangles.size() - missing);
    const Outcome cutTriangle = close(mesh);
    ASSERT_EQ(cutTriangle.codes(), std::set{DiagnosticCode::kIndexOutOfRange});
    EXPECT_EQ(cutTriangle.diagnostics[0].entities.at(0).kind, EntityKind::kTriangle);
    EXPECT_EQ(cutTriangle.diagnostics[0].entities.at(0).index, triangles - 1);

    mesh = geodesicSphere(2);
    const std::size_t nodes = nodeCount(mesh);
    mesh.points.resize(mesh.points.size() - missing);
    const Outcome cutPoint = close(mesh);
    ASSERT_EQ(cutPoint.codes(), std::set{DiagnosticCode::kIndexOutOfRange});
    EXPECT_EQ(cutPoint.diagnostics[0].entities.at(0).kind, EntityKind::kSurfaceNode);
    EXPECT_EQ(cutPoint.diagnostics[0].entities.at(0).index, nodes - 1);
  }
}

TEST(BoundaryDiagnosticsTest, CountsAndLocatesOpenEdges) {
  SurfaceMesh mesh = geodesicSphere(4);
  const std::array<std::uint32_t, 3> lost{mesh.triangles[30], mesh.triangles[31],
                                          mesh.triangles[32]};
  const Vec3 centre =
      (pointOf(mesh, lost[0]) + pointOf(mesh, lost[1]) + pointOf(mesh, lost[2])) / 3.0;
  mesh.triangles.erase(mesh.triangles.begin() + 30, mesh.triangles.begin() + 33);
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kOpenEdge});
  ASSERT_EQ(outcome.diagnostics.size(), 3U);
  for (const Diagnostic& d : outcome.diagnostics) {
    EXPECT_EQ(d.values.back(), 3.0);
    EXPECT_EQ(d.entities.at(0).kind, EntityKind::kTriangle);
    EXPECT_LT(glm::length(d.position - centre), 0.3);
  }
}

TEST(BoundaryDiagnosticsTest, ThirdTriangleOnAnEdge) {
  SurfaceMesh mesh = geodesicSphere(2);
  mesh.points.insert(mesh.points.end(), {3.0, 3.0, 3.0});
  const auto extra = static_cast<std::uint32_t>(nodeCount(mesh) - 1);
  mesh.triangles.insert(mesh.triangles.end(), {mesh.triangles[0], mesh.triangles[1], extra});
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kOpenEdge});
  EXPECT_EQ(outcome.diagnostics.size(), 2U) << "the open edges of the third triangle";
}

TEST(BoundaryDiagnosticsTest, DegenerateTriangles) {
  SurfaceMesh mesh = gridCube(2);
  const std::uint32_t a = mesh.triangles[0];
  const std::uint32_t b = mesh.triangles[1];
  mesh.triangles.insert(mesh.triangles.end(), {a, b, b});
  Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kDegenerateTriangle});
  EXPECT_EQ(outcome.diagnostics.at(0).entities.at(0).index, triangleCount(mesh) - 1);

  // Three collinear nodes: a T-junction closed by a degenerate triangle.
  SurfaceMesh line = tetrahedronSurface(
      {Vec3(0.0), Vec3(2.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)});
  line.points.insert(line.points.end(), {1.0, 0.0, 0.0});
  // Only one of the two triangles at the edge 0 1 is split.
  for (std::size_t h = 0; h < line.triangles.size(); h += 3) {
    std::array<std::uint32_t, 3> t{line.triangles[h], line.triangles[h + 1], line.triangles[h + 2]};
    std::rotate(t.begin(), std::find(t.begin(), t.end(), 0U), t.end());
    if (t[0] != 0 || t[1] != 1) continue;
    line.triangles.erase(line.triangles.begin() + static_cast<std::ptrdiff_t>(h),
                         line.triangles.begin() + static_cast<std::ptrdiff_t>(h) + 3);
    line.triangles.insert(line.triangles.end(), {0, 4, t[2], 4, 1, t[2], 0, 1, 4});
    break;
  }
  outcome = close(line);
  EXPECT_EQ(outcome.of(DiagnosticCode::kDegenerateTriangle).size(), 1U);
  EXPECT_TRUE(outcome.of(DiagnosticCode::kOpenEdge).empty())
      << "the degenerate triangle closes the gap";
}

TEST(BoundaryDiagnosticsTest, DuplicateTriangles) {
  SurfaceMesh mesh = geodesicSphere(2);
  mesh.triangles.insert(mesh.triangles.end(),
                        {mesh.triangles[4], mesh.triangles[3], mesh.triangles[5]});
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kDuplicateTriangle});
  EXPECT_EQ(outcome.diagnostics.at(0).entities.at(0).index, 1U);
  EXPECT_EQ(outcome.diagnostics.at(0).entities.at(1).index, triangleCount(mesh) - 1);
}

TEST(BoundaryDiagnosticsTest, CoincidentNodes) {
  SurfaceMesh mesh = gridCube(1);
  SurfaceMesh other = gridCube(1);
  translate(other, Vec3(1.0, 1.0, 1.0));
  append(mesh, other);
  const Outcome outcome = close(mesh);
  const std::vector<Diagnostic> found = outcome.of(DiagnosticCode::kCoincidentNodes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].position, Vec3(1.0));
  EXPECT_EQ(found[0].entities.size(), 2U);
}

TEST(BoundaryDiagnosticsTest, ListsTheFirstThousandSelfIntersectionsAndCountsAll) {
  SurfaceMesh mesh;
  for (int i = 0; i < 5; ++i) {
    SurfaceMesh other = geodesicSphere(14);
    translate(other, Vec3(1e-3, 2e-3, 3e-3) * static_cast<double>(i));
    append(mesh, other);
  }
  const Outcome outcome = close(mesh);
  const std::vector<Diagnostic> found = outcome.of(DiagnosticCode::kSelfIntersection);
  EXPECT_EQ(found.size(), 1000U);
  ASSERT_FALSE(found.empty());
  EXPECT_GT(found[0].values.back(), 1000.0);
}

TEST(BoundaryDiagnosticsTest, CrossingSpheres) {
  SurfaceMesh mesh = geodesicSphere(5);
  SurfaceMesh other = geodesicSphere(5);
  translate(other, Vec3(1.3, 0.1, 0.2));
  append(mesh, other);
  const Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kSelfIntersection});
  ASSERT_GT(outcome.diagnostics.size(), 20U);
  EXPECT_EQ(outcome.diagnostics[0].values.back(), static_cast<double>(outcome.diagnostics.size()))
      << "lists all of them";
  for (const Diagnostic& d : outcome.diagnostics) {
    EXPECT_NEAR(d.position.x, 0.65, 0.2);
    EXPECT_LT(d.entities.at(0).index, 500U);
    EXPECT_GE(d.entities.at(1).index, 500U);
  }
}

TEST(BoundaryDiagnosticsTest, TouchingIsSelfIntersection) {
  // A corner of the tetrahedron lies inside a face of the cube.
  SurfaceMesh mesh = gridCube(1);
  append(mesh, tetrahedronSurface({Vec3(0.6, 0.3, 1.0), Vec3(0.2, 0.2, 2.0), Vec3(0.8, 0.2, 2.0),
                                   Vec3(0.5, 0.8, 2.0)}));
  EXPECT_EQ(close(mesh).codes(), std::set{DiagnosticCode::kSelfIntersection});
  // Raised by one unit in the last place, the tetrahedron is a separate region.
  for (std::size_t i = 3 * 8 + 2; i < mesh.points.size(); i += 3) {
    mesh.points[i] = std::nextafter(mesh.points[i], 3.0);
  }
  const Outcome apart = close(mesh);
  EXPECT_TRUE(apart.result.isValid);
  EXPECT_EQ(apart.result.regionCount, 2U);
}

TEST(BoundaryDiagnosticsTest, CoplanarOverlap) {
  SurfaceMesh mesh = gridCube(1);
  append(mesh, gridBox(Vec3(0.2, 0.3, 1.0), Vec3(0.7, 0.8, 1.5), {1, 1, 1}));
  EXPECT_EQ(close(mesh).codes(), std::set{DiagnosticCode::kSelfIntersection});
}

TEST(BoundaryDiagnosticsTest, FoldedNeighbours) {
  // A node of a flat cube face pulled over its neighbours in the plane of the face.
  SurfaceMesh mesh = gridCube(3);
  std::uint32_t node = 0;
  while (glm::length(pointOf(mesh, node) - Vec3(1.0 / 3.0, 1.0 / 3.0, 1.0)) > 1e-12) ++node;
  mesh.points[3 * std::size_t{node}] = 0.9;
  EXPECT_EQ(close(mesh).codes(), std::set{DiagnosticCode::kSelfIntersection});
}

/// A closed one-sided surface always intersects itself.
TEST(BoundaryDiagnosticsTest, OneSidedSurface) {
  // The projective plane on six nodes: every edge has two triangles.
  SurfaceMesh mesh;
  Random random(3);
  for (int i = 0; i < 6; ++i) {
    const Vec3 p = random.inBox();
    mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  }
  mesh.triangles = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1,
                    1, 2, 4, 2, 3, 5, 3, 4, 1, 4, 5, 2, 5, 1, 3};
  EXPECT_EQ(close(mesh).codes(), std::set{DiagnosticCode::kSelfIntersection});
  // All its half-faces belong to one shell.
  const EdgeTable edges(mesh.triangles, 6, {});
  EXPECT_EQ(edges.edgeCount(), 15U);
  const std::vector<ShellId> shells = linkHalfFaces(mesh, edges);
  EXPECT_EQ(std::set(shells.begin(), shells.end()), std::set{ShellId(0U)});
}

/// A slanted fibre, much thinner than long: its volume is small, but above the rounding error.
TEST(BoundaryTest, ThinRegionsHaveAVolume) {
  constexpr double kWidth = 1e-7;
  SurfaceMesh mesh = gridBox(Vec3(0.0), Vec3(kWidth, kWidth, 1.0), {1, 1, 2000});
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    mesh.points[i] += 0.3 * mesh.points[i + 2];
    mesh.points[i + 1] += 0.7 * mesh.points[i + 2];
  }
  const Outcome outcome = close(mesh);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_NEAR(outcome.result.shells.at(0).volume, kWidth * kWidth, 1e-6 * kWidth * kWidth);
}

/// Four nodes that are coplanar up to one unit in the last place: the volume is a rounding error.
TEST(BoundaryDiagnosticsTest, ZeroVolume) {
  const Vec3 b(1.0, 0.5, 0.25);
  const Vec3 c(0.25, 1.0, 0.5);
  Vec3 d = 0.25 * (b + c);
  d.z = std::nextafter(d.z, 1.0);
  SurfaceMesh mesh = tetrahedronSurface({Vec3(0.0), b, c, d});
  Outcome outcome = close(mesh);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kZeroVolume});
  EXPECT_EQ(outcome.diagnostics.size(), 1U) << "one per component";
  d.z += 1e-12;
  mesh = tetrahedronSurface({Vec3(0.0), b, c, d});
  EXPECT_TRUE(close(mesh).result.isValid);
}

/// Flips the outside of two boxes with a common interface. The interface counts neither as flipped
/// nor as one of all triangles.
TEST(BoundaryInterfacesTest, InterfacesDoNotCountAsTrianglesOfTheirComponent) {
  SurfaceMesh mesh = dividedBox({2, 1, 1}, 1);
  ASSERT_TRUE(close(mesh).result.isValid);
  std::uint32_t outer = 0;
  for (std::uint32_t t = 0; t < triangleCount(mesh); ++t) {
    if (mesh.isInterface(t)) continue;
    flipTriangle(mesh, TriangleId(t));
    ++outer;
  }
  EXPECT_EQ(outer, 20U);
  SurfaceMesh flipped = mesh;
  flipped.triangleRegions.clear();
  flipped.trianglePatch.clear();
  BoundaryCheck check(flipped, BoundarySource::kGivenSurface, InnerShells::kCavities,
                      MixedOrientation::kRefuse);
  finish(check);
  EXPECT_TRUE(check.result().isValid) << "flipped as a whole";
  for (const Diagnostic& found : check.diagnostics()) {
    if (found.code != DiagnosticCode::kReorientedPatch) continue;
    EXPECT_EQ(found.values, (std::vector<double>{20.0, 20.0}));
  }
}

TEST(BoundaryDiagnosticsTest, FlipsNothingIfThereAreErrors) {
  SurfaceMesh mesh = geodesicSphere(3);
  mesh.triangles.resize(mesh.triangles.size() - 3);
  flipRandomly(mesh, 4);
  const std::vector<std::uint32_t> before = mesh.triangles;
  EXPECT_FALSE(close(mesh).result.isValid);
  EXPECT_EQ(mesh.triangles, before);
}

// ---- drawn models: diagnostics name lines and patches ---------------------------------------------------

/// The unit cube as six patches of n x n squares, numbered -x +x -y +y -z +z, and its twelve
/// lines, each with its sides.
SurfaceMesh drawnCube(int n) {
  SurfaceMesh mesh = gridCube(n);
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    mesh.trianglePatch.push_back(static_cast<std::uint32_t>(
        t / (2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n))));
  }
  // A side lies on a line if two coordinates are 0 or 1 at both ends.
  std::set<std::array<std::uint32_t, 3>> sides;
  for (std::size_t h = 0; h < mesh.triangles.size(); ++h) {
    const std::uint32_t a = mesh.triangles[h];
    const std::uint32_t b = mesh.triangles[h - h % 3 + (h + 1) % 3];
    const Vec3 p = pointOf(mesh, a);
    const Vec3 q = pointOf(mesh, b);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      const auto u = static_cast<int>((axis + 1) % 3);
      const auto v = static_cast<int>((axis + 2) % 3);
      const auto isEnd = [](double x) { return x == 0.0 || x == 1.0; };
      if (p[u] != q[u] || p[v] != q[v] || !isEnd(p[u]) || !isEnd(p[v])) continue;
      const std::uint32_t line = 4 * axis + (p[u] > 0.5 ? 1 : 0) + (p[v] > 0.5 ? 2 : 0);
      sides.insert({std::min(a, b), std::max(a, b), line});
    }
  }
  for (const auto& [a, b, line] : sides) {
    mesh.sides.insert(mesh.sides.end(), {a, b});
    mesh.sideLine.push_back(line);
  }
  return mesh;
}

TEST(DrawnBoundaryTest, FlipsAndNamesReversedPatches) {
  SurfaceMesh mesh = drawnCube(3);
  const auto expected = orientationsOf(mesh);
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    if (mesh.trianglePatch[t] == 1 || mesh.trianglePatch[t] == 4) flipTriangle(mesh, TriangleId(t));
  }
  const std::vector<std::uint32_t> patches = mesh.trianglePatch;
  const Outcome outcome = close(mesh, BoundarySource::kDrawnPatches);
  ASSERT_TRUE(outcome.result.isValid);
  EXPECT_EQ(orientationsOf(mesh), expected);
  EXPECT_EQ(mesh.trianglePatch, patches);
  ASSERT_EQ(outcome.diagnostics.size(), 1U) << "one for all patches";
  EXPECT_EQ(outcome.diagnostics[0].code, DiagnosticCode::kReorientedPatch);
  ASSERT_EQ(outcome.diagnostics[0].entities.size(), 2U);
  for (const auto& [at, patch] : {std::pair{0U, 1U}, {1U, 4U}}) {
    EXPECT_EQ(outcome.diagnostics[0].entities[at].kind, EntityKind::kPatch);
    EXPECT_EQ(outcome.diagnostics[0].entities[at].index, patch);
  }
}

/// Returns the triangles that a diagnostic names after its lines and patches, and expects that they belong to these
/// patches and are distinct.
std::vector<std::uint32_t> trianglesOf(const Diagnostic& diagnostic, const SurfaceMesh& mesh) {
  std::set<std::uint32_t> patches;
  std::vector<std::uint32_t> triangles;
  for (const Entity& entity : diagnostic.entities) {
    if (entity.kind == EntityKind::kPatch) patches.insert(entity.index);
    if (entity.kind == EntityKind::kTriangle) triangles.push_back(entity.index);
  }
  for (const std::uint32_t triangle : triangles) {
    EXPECT_TRUE(patches.contains(mesh.trianglePatch.at(triangle)));
  }
  EXPECT_EQ(std::set(triangles.begin(), triangles.end()).size(), triangles.size());
  return triangles;
}

TEST(DrawnBoundaryTest, OpenEdgesAreReportedOncePerLine) {
  SurfaceMesh mesh = drawnCube(3);
  const std::ptrdiff_t perPatch = 3 * 18;
  mesh.triangles.erase(mesh.triangles.begin() + 5 * perPatch, mesh.triangles.end());
  mesh.trianglePatch.resize(5 * 18);
  const Outcome outcome = close(mesh, BoundarySource::kDrawnPatches);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kOpenEdge});
  ASSERT_EQ(outcome.diagnostics.size(), 4U) << "the four lines around the missing patch";
  std::set<std::uint32_t> lines;
  for (const Diagnostic& d : outcome.diagnostics) {
    ASSERT_EQ(d.entities.size(), 5U);
    EXPECT_EQ(d.entities[0].kind, EntityKind::kLine);
    EXPECT_EQ(d.entities[1].kind, EntityKind::kPatch);
    EXPECT_EQ(trianglesOf(d, mesh).size(), 3U) << "one for each side of the line";
    lines.insert(d.entities[0].index);
    EXPECT_EQ(d.values.back(), 3.0) << "sides of the line";
    EXPECT_EQ(d.position.z, 1.0);
  }
  EXPECT_EQ(lines.size(), 4U);
}

/// A row of squares in one patch, with a line along its lower edge.
SurfaceMesh drawnStrip(std::uint32_t squares) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i <= squares; ++i) {
    mesh.points.insert(mesh.points.end(), {1.0 * i, 0.0, 0.0, 1.0 * i, 1.0, 0.0});
  }
  for (std::uint32_t i = 0; i < squares; ++i) {
    const std::uint32_t a = 2 * i;
    mesh.triangles.insert(mesh.triangles.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
    mesh.trianglePatch.insert(mesh.trianglePatch.end(), {0, 0});
    mesh.sides.insert(mesh.sides.end(), {a, a + 2});
    mesh.sideLine.push_back(0);
  }
  return mesh;
}

TEST(DrawnBoundaryTest, NamesAtMostTwoHundredTrianglesButCountsAll) {
  for (const std::uint32_t squares : {199U, 200U, 201U}) {
    SurfaceMesh mesh = drawnStrip(squares);
    const Outcome outcome = close(mesh, BoundarySource::kDrawnPatches);
    ASSERT_EQ(outcome.diagnostics.size(), 2U) << "edges without a line, and edges on the line";
    const Diagnostic& alongLine = outcome.diagnostics[1];
    EXPECT_EQ(alongLine.entities.at(0).kind, EntityKind::kLine);
    EXPECT_EQ(trianglesOf(alongLine, mesh).size(), std::min(squares, 200U));
    EXPECT_EQ(alongLine.values.back(), squares);
  }
}

TEST(DrawnBoundaryTest, IntersectingPatchesAreReportedOncePerPair) {
  SurfaceMesh mesh = drawnCube(4);
  // A second, smaller cube with the patches 6 to 11 crosses the top of the first.
  SurfaceMesh second = drawnCube(4);
  scale(second, 0.5);
  translate(second, Vec3(0.21, 0.22, 0.7));
  append(mesh, second);
  for (const std::uint32_t patch : second.trianglePatch) mesh.trianglePatch.push_back(patch + 6);
  const Outcome outcome = close(mesh, BoundarySource::kDrawnPatches);
  EXPECT_EQ(outcome.codes(), std::set{DiagnosticCode::kSelfIntersection});
  ASSERT_EQ(outcome.diagnostics.size(), 4U)
      << "the upper patch and the four around the second cube";
  for (const Diagnostic& d : outcome.diagnostics) {
    ASSERT_GT(d.entities.size(), 3U);
    EXPECT_EQ(d.entities[0].kind, EntityKind::kPatch);
    EXPECT_EQ(d.entities[0].index, 5U);
    EXPECT_EQ(d.entities[1].kind, EntityKind::kPatch);
    EXPECT_GE(d.entities[1].index, 6U);
    EXPECT_GT(trianglesOf(d, mesh).size(), 2U);
    EXPECT_GT(d.values.back(), 1.0);
  }
}

TEST(BoundaryTest, FindsTheSameFarFromTheOrigin) {
  // The coordinates have 30 more bits than single precision keeps of them: its boxes would all overlap.
  const Vec3 shift(0x1p40, -0x1p41, 0x1p40);
  SurfaceMesh near = gridCube(6);
  SurfaceMesh other = gridCube(6);
  translate(other, Vec3(0.5));
  const std::uint32_t nodes = countNodes(near);
  near.points.insert(near.points.end(), other.points.begin(), other.points.end());
  for (const std::uint32_t node : other.triangles) near.triangles.push_back(nodes + node);
  for (double& x : near.points) x = std::ldexp(std::round(std::ldexp(x, 8)), -8);
  SurfaceMesh far = near;
  translate(far, shift);
  const std::vector<double> given = far.points;
  const std::vector<Diagnostic> expected = close(near).of(DiagnosticCode::kSelfIntersection);
  const std::vector<Diagnostic> found = close(far).of(DiagnosticCode::kSelfIntersection);
  EXPECT_EQ(far.points, given);
  ASSERT_GT(expected.size(), 10U);
  ASSERT_EQ(found.size(), expected.size());
  // The order of the pairs may follow other boxes.
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Diagnostic& d : expected) pairs.emplace(d.entities[0].index, d.entities[1].index);
  for (const Diagnostic& d : found) {
    EXPECT_TRUE(pairs.contains({d.entities[0].index, d.entities[1].index}));
    ASSERT_TRUE(d.hasPosition);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(d.position[k], shift[k] - 0.1);
      EXPECT_LE(d.position[k], shift[k] + 1.6);
    }
  }
}

TEST(BoundaryTest, DoesNotDependOnTheSlices) {
  SurfaceMesh whole = cubeWithSphericalCavity(6, 5);
  flipRandomly(whole, 21);
  SurfaceMesh sliced = whole;
  const Outcome outcome = close(whole);
  BoundaryCheck check(sliced, BoundarySource::kGivenSurface);
  int slices = 1;
  double fraction = 0.0;
  while (!check.advance(7)) {
    ++slices;
    EXPECT_GE(check.fraction(), fraction);
    fraction = check.fraction();
  }
  EXPECT_GT(slices, 100);
  EXPECT_EQ(sliced.triangles, whole.triangles);
  EXPECT_EQ(sliced.triangleRegions, whole.triangleRegions);
  EXPECT_EQ(check.diagnostics().size(), outcome.diagnostics.size());
}

}  // namespace
}  // namespace tetrafront::testing
