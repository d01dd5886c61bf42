// Whole surfaces: patches share the nodes of their lines, and the mesh and the order of its nodes do not depend on the
// slices.

#include "surface/surface_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>

#include "base/fingerprint.h"
#include "model/check_model.h"
#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/shapes.h"
#include "support/surface_measures.h"

namespace tetrafront::testing {
namespace {

std::uint64_t fingerprintOf(const SurfaceMesh& mesh) {
  Fingerprint fingerprint;
  fingerprint.add(mesh.points);
  fingerprint.add(mesh.triangles);
  fingerprint.add(mesh.trianglePatch);
  fingerprint.add(mesh.sides);
  return fingerprint.value();
}

/// A region bounded by two discs and a tube with a seam.
Model cylinder() {
  Model model = seamedTube(1.0, 2.0);
  model.patches.push_back({PatchType::kPlanar, {{{0, false}}}});
  model.patches.push_back({PatchType::kPlanar, {{{1, false}}}});
  return model;
}

TEST(SurfaceMesher, BoxIsWatertight) {
  const Model model = boxModel({0, 0, 0}, {1, 2, 3});
  for (const double size : {5.0, 0.7, 0.1}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMesh mesh = meshOf(model, field);
    const SurfaceMeasures found = measure(mesh, field);
    EXPECT_EQ(found.borderEdges, 0U);
    EXPECT_EQ(found.nonManifoldEdges, 0U);
    EXPECT_EQ(found.eulerCharacteristic(), 2);
    EXPECT_NEAR(found.area, 22.0, 1e-11);
    EXPECT_EQ(mesh.trianglePatch.size(), found.triangles);
  }
}

TEST(SurfaceMesher, CylinderWithASeamAndTwoDiscsIsWatertight) {
  const Model model = cylinder();
  ASSERT_TRUE(diagnoseModel(model).empty());
  for (const double size : {3.0, 0.8, 0.2}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMeasures found = measure(meshOf(model, field), field);
    EXPECT_EQ(found.borderEdges, 0U) << size;
    EXPECT_EQ(found.nonManifoldEdges, 0U) << size;
    EXPECT_EQ(found.eulerCharacteristic(), 2) << size;
  }
}

TEST(SurfaceMesher, CurvedBoxesOfCoonsPatchesAreWatertight) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Model model = randomBentBox(seed, 0.2);
    ASSERT_TRUE(diagnoseModel(model).empty()) << seed;
    const SizeField field = SizeField::uniform(seed % 3 == 0 ? 2.0 : 0.15);
    const SurfaceMeasures found = measure(meshOf(model, field), field);
    SCOPED_TRACE(seed);
    EXPECT_EQ(found.borderEdges, 0U);
    EXPECT_EQ(found.nonManifoldEdges, 0U);
    EXPECT_EQ(found.eulerCharacteristic(), 2);
  }
}

/// A ring between two tubes of two Coons patches each. The inner circle is rotated, so that with few sides it intersects
/// the outer one: both planar patches need halved sides on the lines that they share with the Coons patches.
Model ringOfTubes() {
  ModelBuilder builder;
  const double diagonal = std::sqrt(0.5);
  std::array<std::array<Loop, 2>, 2> circles;  // [bottom or top][outer or inner]
  for (std::size_t level = 0; level < 2; ++level) {
    const Vec3 centre(0.0, 0.0, static_cast<double>(level));
    circles[level] = {
        builder.circle(centre, 1.0, 2),
        builder.circle(centre, 0.9, 2, {diagonal, diagonal, 0.0}, {-diagonal, diagonal, 0.0})};
    builder.patch(PatchType::kPlanar, {circles[level][0], circles[level][1]});
  }
  const auto startOf = [&](const OrientedLine& line) {
    return builder.model.points[builder.model.lines[line.line].points.front()];
  };
  for (std::size_t tube = 0; tube < 2; ++tube) {
    std::array<OrientedLine, 2> rises;
    for (std::size_t i = 0; i < 2; ++i)
      rises[i] = builder.straight(startOf(circles[0][tube][i]), startOf(circles[1][tube][i]));
    for (std::size_t i = 0; i < 2; ++i) {
      builder.patch(PatchType::kCoons, {{circles[0][tube][i],
                                         rises[1 - i],
                                         {circles[1][tube][i].line, true},
                                         {rises[i].line, true}}});
    }
  }
  return std::move(builder.model);
}

TEST(SurfaceMesher, HalvingSidesOfSharedLinesDoesNotDependOnTheOrderOfPatches) {
  Model model = ringOfTubes();
  ASSERT_TRUE(diagnoseModel(model).empty());
  const SizeField field = SizeField::uniform(3.0);
  const SurfaceMesh mesh = meshOf(model, field);
  const SurfaceMeasures found = measure(mesh, field);
  EXPECT_EQ(found.borderEdges, 0U);
  EXPECT_EQ(found.nonManifoldEdges, 0U);
  EXPECT_EQ(found.eulerCharacteristic(), 0);
  EXPECT_GT(mesh.sideLine.size(), 8U * 2U + 4U) << "nothing had to be halved";
  std::ranges::reverse(model.patches);
  EXPECT_EQ(meshOf(model, field).sides, mesh.sides);
}

TEST(SurfaceMesher, ClosedAndParallelLinesHaveEnoughSidesAtACoarseSize) {
  // Two discs, one above the other: a circle of one line needs three sides; a circle of two lines needs two sides each.
  for (const int arcs : {1, 2}) {
    ModelBuilder builder;
    const Loop bottom = builder.circle({0, 0, 0}, 1.0, arcs);
    const Loop top = builder.circle({0, 0, 0.5}, 1.0, arcs);
    builder.patch(PatchType::kPlanar, {bottom});
    builder.patch(PatchType::kPlanar, {top});
    const SurfaceMesh mesh = meshOf(builder.model, SizeField::uniform(100.0));
    for (std::uint32_t line = 0; line < builder.model.lines.size(); ++line)
      EXPECT_EQ(std::ranges::count(mesh.sideLine, line), arcs == 1 ? 3 : 2) << line;
    EXPECT_EQ(measure(mesh, SizeField::uniform(100.0)).borderEdges, mesh.sideLine.size());
  }
}

TEST(SurfaceMesher, NodesComeInThePromisedOrder) {
  Model model = boxModel({0, 0, 0}, {1, 1, 1});
  // An unused point and an unused line have no nodes.
  model.points.insert(model.points.begin(), Vec3(9, 9, 9));
  for (Line& line : model.lines)
    for (std::uint32_t& point : line.points) ++point;
  model.points.emplace_back(8, 8, 8);
  model.lines.push_back({LineType::kStraight, {0, 9}});
  const SurfaceMesh mesh = meshOf(model, SizeField::uniform(0.3));
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    EXPECT_EQ(pointOf(mesh, corner), model.points[corner + 1]);
  // The inner nodes of the lines follow: all other nodes of sides.
  const std::uint32_t lastOnLines = *std::ranges::max_element(mesh.sides);
  EXPECT_EQ(mesh.sides.size(), 2 * mesh.sideLine.size());
  EXPECT_EQ(lastOnLines + 1, 8 + mesh.sideLine.size() - 12);
  EXPECT_TRUE(std::ranges::is_sorted(mesh.sideLine));
  EXPECT_TRUE(std::ranges::is_sorted(mesh.trianglePatch));
  for (std::uint32_t node = 0; node < nodeCount(mesh); ++node)
    EXPECT_LT(pointOf(mesh, node).x, 1.5);
}

TEST(SurfaceMesher, NodesOfAPatchInACoordinatePlaneAreExactlyInIt) {
  // 0.1 and 0.3 are no finite binary fractions, and neither are the weights of a spline.
  const Vec3 u(0, 1, 0);
  const Vec3 v(0, 0, 1);
  ModelBuilder builder;
  builder.patch(PatchType::kPlanar, {builder.circle({0.1, 0, 0}, 1.0, 3, u, v)});
  builder.patch(PatchType::kPlanar, {builder.polygon(squareCorners({0.2, 0.7, 0.3}, 0.9))});
  builder.patch(PatchType::kCoons, {builder.circle({0.3, 5, 5}, 1.0, 4, u, v)});
  const SurfaceMesh mesh = meshOf(builder.model, SizeField::uniform(0.13));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 node = pointOf(mesh, mesh.triangles[i]);
    const std::uint32_t patch = mesh.trianglePatch[i / 3];
    EXPECT_EQ(patch == 1 ? node.z : node.x, patch == 0 ? 0.1 : 0.3);
  }
}

TEST(SurfaceMesher, TrianglesOfAPatchHaveTheSameOrientation) {
  const SurfaceMesh mesh = meshOf(cylinder(), SizeField::uniform(0.3));
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> directed;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t next = mesh.triangles[i % 3 == 2 ? i - 2 : i + 1];
    directed[{mesh.triangles[i], next}].push_back(mesh.trianglePatch[i / 3]);
  }
  for (auto& [edge, patches] : directed) {
    std::ranges::sort(patches);
    EXPECT_EQ(std::ranges::adjacent_find(patches), patches.end())
        << edge.first << ' ' << edge.second;
  }
}

TEST(SurfaceMesher, SliceSizeDoesNotChangeTheMesh) {
  const Model model = cylinder();
  const SizeField field = SizeField::uniform(0.15);
  const std::uint64_t whole = fingerprintOf(meshOf(model, field, 100'000'000));
  EXPECT_EQ(fingerprintOf(meshOf(model, field, 1)), whole);
  EXPECT_EQ(fingerprintOf(meshOf(model, field, 97)), whole);
}

TEST(SurfaceMesher, DirectionInWhichLinesAreDrawnDoesNotChangeTheMesh) {
  const Model model = cylinder();
  Model turned = model;
  for (std::size_t line = 0; line < turned.lines.size(); ++line) {
    // A closed line has no lower end point: its curve has the direction in which it is drawn.
    if (turned.lines[line].points.front() == turned.lines[line].points.back()) continue;
    std::ranges::reverse(turned.lines[line].points);
    for (Patch& patch : turned.patches)
      for (Loop& loop : patch.loops)
        for (OrientedLine& walked : loop)
          if (walked.line == line) walked.reversed = !walked.reversed;
  }
  const SizeField field = SizeField::uniform(0.2);
  EXPECT_EQ(fingerprintOf(meshOf(turned, field)), fingerprintOf(meshOf(model, field)));
}

TEST(SurfaceMesher, SlicesAreShort) {
  const Model model = polygonModel({squareCorners({0, 0, 0}, 1.0)});
  const SizeField field = SizeField::uniform(0.005);
  SurfaceMesher mesher(model, field);
  double longest = 0.0;
  for (MeshStatus status = MeshStatus::kRunning; status == MeshStatus::kRunning;) {
    // Processor time: other programs do not count.
    const std::clock_t begin = std::clock();
    status = mesher.advance(500);
    longest = std::max(longest, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  EXPECT_GT(mesher.mesh().triangles.size() / 3, 90'000U);
  // A slice takes milliseconds; the limit allows for sanitizers.
  EXPECT_LT(longest, 0.5);
}

TEST(SurfaceMesher, FractionAndPhaseOnlyAdvance) {
  const Model model = boxModel({0, 0, 0}, {1, 1, 1});
  const SizeField field = SizeField::uniform(0.05);
  SurfaceMesher mesher(model, field);
  double fraction = 0.0;
  Phase phase = mesher.phase();
  EXPECT_EQ(phase, Phase::kSides);
  while (mesher.advance(300) == MeshStatus::kRunning) {
    EXPECT_GE(mesher.fraction(), fraction);
    EXPECT_GE(mesher.phase(), phase);
    fraction = mesher.fraction();
    phase = mesher.phase();
  }
  EXPECT_EQ(mesher.fraction(), 1.0);
  EXPECT_EQ(mesher.phase(), Phase::kSurface);
}

TEST(SurfaceMesher, ReportsEveryLineOutsideTheGrid) {
  const Model model = boxModel({0, 0, 0}, {1, 1, 1});
  const SizeField field = SizeField::fromGrid(
      GridLocator(boxGrid({-0.5, -0.5, -0.5}, {1.5, 1.5, 0.5}, [](const Vec3&) { return 0.2; })));
  SurfaceMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(100);
  EXPECT_EQ(status, MeshStatus::kInvalidInput);
  // The four lines around the top, and the four that end there.
  EXPECT_EQ(mesher.diagnostics().size(), 8U);
  for (const Diagnostic& diagnostic : mesher.diagnostics()) {
    EXPECT_EQ(diagnostic.code, DiagnosticCode::kOutsideBackgroundGrid);
    ASSERT_EQ(diagnostic.entities.size(), 1U);
    EXPECT_EQ(diagnostic.entities.front().kind, EntityKind::kLine);
    EXPECT_TRUE(diagnostic.hasPosition);
    EXPECT_GT(diagnostic.position.z, 0.5);
  }
}

TEST(SurfaceMesher, ReportsAPatchThatLeavesTheGridBetweenItsLines) {
  // The lines are inside; the paraboloid between them is not.
  ModelBuilder builder;
  const std::uint32_t front = builder.line(LineType::kParabolic, {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}});
  const std::uint32_t right = builder.line(LineType::kParabolic, {{2, 0, 0}, {2, 1, 1}, {2, 2, 0}});
  const std::uint32_t back = builder.line(LineType::kParabolic, {{2, 2, 0}, {1, 2, 1}, {0, 2, 0}});
  const std::uint32_t left = builder.line(LineType::kParabolic, {{0, 2, 0}, {0, 1, 1}, {0, 0, 0}});
  builder.patch(PatchType::kCoons,
                {{{front, false}, {right, false}, {back, false}, {left, false}}});
  const SizeField field = SizeField::fromGrid(
      GridLocator(boxGrid({-1, -1, -1}, {3, 3, 1.5}, [](const Vec3&) { return 0.2; })));
  SurfaceMesher mesher(builder.model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(100);
  EXPECT_EQ(status, MeshStatus::kInvalidInput);
  ASSERT_EQ(mesher.diagnostics().size(), 1U);
  EXPECT_EQ(mesher.diagnostics().front().code, DiagnosticCode::kOutsideBackgroundGrid);
  EXPECT_EQ(mesher.diagnostics().front().entities.front().kind, EntityKind::kPatch);
}

TEST(SurfaceMesher, RejectsAnAbsurdSizeAtOnce) {
  const Model model = boxModel({0, 0, 0}, {1, 1, 1});
  const SizeField field = SizeField::uniform(1e-8);
  SurfaceMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(100);
  EXPECT_EQ(status, MeshStatus::kInvalidInput);
  EXPECT_EQ(mesher.diagnostics().front().code, DiagnosticCode::kTooManyElements);
}

TEST(SurfaceMesher, ReportsLinesThatTouchBetweenSamples) {
  // The edge of the hole lies exactly on the outer edge, which the tolerance of the samples hides.
  const Model model =
      polygonModel({squareCorners({0, 0, 0}, 1.0), {{0.25, 0, 0}, {0.75, 0, 0}, {0.5, 0.5, 0}}});
  const SizeField field = SizeField::uniform(0.3);
  SurfaceMesher mesher(model, field);
  MeshStatus status = MeshStatus::kRunning;
  while (status == MeshStatus::kRunning) status = mesher.advance(100);
  EXPECT_EQ(status, MeshStatus::kInvalidInput);
  ASSERT_FALSE(mesher.diagnostics().empty());
  EXPECT_EQ(mesher.diagnostics().front().code, DiagnosticCode::kLoopsIntersect);
  EXPECT_EQ(mesher.diagnostics().front().entities.front().kind, EntityKind::kPatch);
}

}  // namespace
}  // namespace tetrafront::testing
