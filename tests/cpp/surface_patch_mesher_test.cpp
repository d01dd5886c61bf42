// Single patches: the front closes for every shape, and the triangles are good, of the target size, and on the patch.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geom/predicates.h"
#include "model/patch_surface.h"
#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/shapes.h"
#include "support/surface_measures.h"

namespace tetrafront::testing {
namespace {

/// The properties of every valid patch.
void expectValid(const SurfaceMeasures& found, long eulerCharacteristic, std::size_t sides) {
  EXPECT_EQ(found.eulerCharacteristic(), eulerCharacteristic);
  EXPECT_EQ(found.borderEdges, sides);
  EXPECT_EQ(found.nonManifoldEdges, 0U);
}

TEST(SurfacePatchMesher, SquareIsCoveredByGoodTriangles) {
  const Model model = polygonModel({squareCorners({0, 0, 0}, 1.0)});
  for (const double size : {0.2, 0.1, 0.03, 0.01}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMesh mesh = meshOf(model, field);
    const SurfaceMeasures found = measure(mesh, field);
    expectValid(found, 1, mesh.sideLine.size());
    EXPECT_NEAR(found.area, 1.0, 1e-12);
    EXPECT_GT(found.minAngle, 30.0) << size;
    EXPECT_GT(found.meanRadiusRatio, 0.93) << size;
    EXPECT_NEAR(found.meanEdgeRatio, 1.0, size < 0.2 ? 0.05 : 0.2) << size;
  }
}

TEST(SurfacePatchMesher, RandomPolygonsWithHolesCloseWithTheirExactArea) {
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    double area = 0.0;
    const Model model = randomPolygonModel(seed, area);
    const SizeField field = SizeField::uniform(seed % 2 == 0 ? 0.07 : 0.3);
    const SurfaceMesh mesh = meshOf(model, field);
    const SurfaceMeasures found = measure(mesh, field);
    SCOPED_TRACE(seed);
    expectValid(found, 2 - static_cast<long>(model.patches.front().loops.size()),
                mesh.sideLine.size());
    EXPECT_NEAR(found.area, area, 1e-12 * area);
    if (seed % 2 != 0) continue;
    EXPECT_GT(found.minAngle, 20.0);
    EXPECT_GT(found.meanRadiusRatio, 0.93);
    EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.1);
  }
}

TEST(SurfacePatchMesher, RandomCoonsPatchesClose) {
  for (std::uint64_t seed = 0; seed < 45; ++seed) {
    const Model model = randomCoonsModel(seed, 0.05 * static_cast<double>(seed % 5));
    const SizeField field = SizeField::uniform(seed % 3 == 0 ? 0.25 : 0.06);
    const SurfaceMesh mesh = meshOf(model, field);
    const SurfaceMeasures found = measure(mesh, field);
    SCOPED_TRACE(seed);
    expectValid(found, 1, mesh.sideLine.size());
    if (seed % 3 == 0) continue;
    EXPECT_GT(found.minAngle, 15.0);
    EXPECT_GT(found.meanRadiusRatio, 0.93);
    EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.1);
  }
}

TEST(SurfacePatchMesher, InnerNodesLieOnThePatch) {
  // A hyperbolic paraboloid: the bilinear patch over a twisted quadrilateral is z = x y.
  ModelBuilder builder;
  builder.patch(PatchType::kCoons, {builder.polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}})});
  const SurfaceMesh mesh = meshOf(builder.model, SizeField::uniform(0.05));
  for (std::uint32_t node = 0; node < nodeCount(mesh); ++node) {
    const Vec3 position = pointOf(mesh, node);
    EXPECT_NEAR(position.z, position.x * position.y, 1e-13);
  }
}

TEST(SurfacePatchMesher, DiscWithAHoleConvergesToItsArea) {
  ModelBuilder builder;
  builder.patch(PatchType::kPlanar, {builder.circle({0, 0, 0}, 1.0, 4),
                                     builder.polygon(squareCorners({-0.1, 0.1, 0}, 0.4))});
  // The splines are not exactly a circle: compare with the area that they enclose.
  const ResolvedModel resolved(builder.model);
  double exact = -0.16;
  const std::vector<Vec3> samples =
      sampleLoop(resolved, builder.model.patches.front().loops.front(), 5000);
  for (std::size_t i = 0; i < samples.size(); ++i)
    exact += 0.5 * glm::cross(samples[i], samples[(i + 1) % samples.size()]).z;
  EXPECT_NEAR(exact, std::numbers::pi - 0.16, 0.05);
  double previousError = 1.0;
  for (const double size : {0.2, 0.1, 0.05, 0.025}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMeasures found = measure(meshOf(builder.model, field), field);
    const double error = std::fabs(found.area - exact);
    EXPECT_EQ(found.eulerCharacteristic(), 0);
    EXPECT_GT(found.minAngle, 25.0);
    // The error is of second order: half the size gives about a quarter of it.
    EXPECT_LT(error, 0.4 * previousError) << size;
    previousError = error;
  }
}

TEST(SurfacePatchMesher, GradedFieldIsFollowedOverTwoDecades) {
  const Model model = polygonModel({squareCorners({0, 0, 0}, 1.0)});
  const SizeField field = SizeField::fromGrid(GridLocator(
      boxGrid({-1, -1, -1}, {2, 2, 1}, [](const Vec3& p) { return p.x < 0 ? 0.001 : 0.2; })));
  const SurfaceMesh mesh = meshOf(model, field);
  const SurfaceMeasures found = measure(mesh, field);
  expectValid(found, 1, mesh.sideLine.size());
  EXPECT_GT(found.minAngle, 25.0);
  EXPECT_GT(found.meanRadiusRatio, 0.93);
  EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.1);
}

TEST(SurfacePatchMesher, SizesHoldInSpaceIfThePlaneDiffersFromThePatch) {
  // Lines AB and DC have very different lengths, with a deep valley in between: the stretched plane is far from
  // isometric, and the metric must compensate for it.
  ModelBuilder builder;
  const Vec3 a(0, 0, 0);
  const Vec3 b(4, 0, 0);
  const Vec3 c(2.2, 3, 1);
  const Vec3 d(1.8, 3, 1);
  const std::uint32_t ab = builder.line(LineType::kParabolic, {a, {2, -0.5, -2}, b});
  builder.patch(
      PatchType::kCoons,
      {{{ab, false}, builder.straight(b, c), builder.straight(c, d), builder.straight(d, a)}});
  const SizeField field = SizeField::uniform(0.1);
  const SurfaceMeasures found = measure(meshOf(builder.model, field), field);
  EXPECT_GT(found.minAngle, 20.0);
  EXPECT_GT(found.meanRadiusRatio, 0.93);
  EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.05);
}

TEST(SurfacePatchMesher, CoonsDiscWithFourSmoothCornersCloses) {
  // Four arcs of one circle: the tangents at each corner are opposite, so the mapping is singular there.
  ModelBuilder builder;
  builder.patch(PatchType::kCoons, {builder.circle({0, 0, 0}, 1.0, 4)});
  for (const double size : {0.3, 0.1, 0.03}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMesh mesh = meshOf(builder.model, field);
    const SurfaceMeasures found = measure(mesh, field);
    expectValid(found, 1, mesh.sideLine.size());
    EXPECT_GT(found.minAngle, 20.0) << size;
    EXPECT_GT(found.meanRadiusRatio, 0.9) << size;
  }
}

TEST(SurfacePatchMesher, TubeWithASeamIsWatertightAlongIt) {
  const Model model = seamedTube(1.0, 3.0);
  for (const double size : {2.0, 1.0, 0.5, 0.1}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMesh mesh = meshOf(model, field);
    const SurfaceMeasures found = measure(mesh, field);
    std::size_t circleSides = 0;
    for (const std::uint32_t line : mesh.sideLine) circleSides += line < 2 ? 1 : 0;
    SCOPED_TRACE(size);
    expectValid(found, 0, circleSides);
  }
}

TEST(SurfacePatchMesher, CoarseSidesOfABentLineAreHalvedUntilLoopsAreSimple) {
  // A hole in the sag of a parabola: with a single side of the line, the hole would lie outside the patch.
  ModelBuilder builder;
  const std::uint32_t sag = builder.line(LineType::kParabolic, {{0, 1, 0}, {1, 0.1, 0}, {2, 1, 0}});
  builder.patch(PatchType::kPlanar, {{{sag, false},
                                      builder.straight({2, 1, 0}, {2, 2, 0}),
                                      builder.straight({2, 2, 0}, {0, 2, 0}),
                                      builder.straight({0, 2, 0}, {0, 1, 0})},
                                     builder.polygon({{0.9, 0.6, 0}, {1.1, 0.6, 0}, {1, 0.8, 0}})});
  const SizeField field = SizeField::uniform(3.0);
  const SurfaceMesh mesh = meshOf(builder.model, field);
  std::size_t sagSides = 0;
  for (const std::uint32_t line : mesh.sideLine) sagSides += line == sag ? 1 : 0;
  EXPECT_GE(sagSides, 2U);
  expectValid(measure(mesh, field), 0, mesh.sideLine.size());
}

TEST(SurfacePatchMesher, SidesGrowFromALineThatIsMuchShorter) {
  for (const double size : {0.3, 0.1}) {
    for (const double times : {3.0, 10.0, 100.0, 1000.0}) {
      SCOPED_TRACE("size " + std::to_string(size) + " over " + std::to_string(times));
      const double s = size / times;
      // A square with a chamfer; one with a step in an edge; one with two close points on an edge.
      for (const Model& model :
           {polygonModel({{{0, 0, 0}, {1, 0, 0}, {1, 1 - s, 0}, {1 - s, 1, 0}, {0, 1, 0}}}),
            polygonModel(
                {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.4, 1, 0}, {0.4, 1 + s, 0}, {0, 1 + s, 0}}}),
            polygonModel(
                {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5 + s, 1, 0}, {0.5, 1, 0}, {0, 1, 0}}})}) {
        const SizeField field = SizeField::uniform(size);
        EXPECT_GT(measure(meshOf(model, field), field).minAngle, 25.0);
      }
    }
  }
}

TEST(SurfacePatchMesher, LinesThatAreAllShortNeedNoSmallerSides) {
  // Every edge is a tenth of the size: no side is next to a longer one.
  const Model model = polygonModel({squareCorners({0, 0, 0}, 1.0)});
  EXPECT_EQ(triangleCount(meshOf(model, SizeField::uniform(10.0))), 2U);
}

TEST(SurfacePatchMesher, NodesOfOneStraightLineNeverFormATriangle) {
  // A tilted triangle: the nodes of a line are collinear only up to rounding.
  const Model model = polygonModel({{{0.1, 0.2, 0.3}, {1.3, 0.7, 0.2}, {0.4, 1.1, 0.9}}});
  const SurfaceMesh mesh = meshOf(model, SizeField::uniform(0.02));
  std::vector<std::vector<std::uint32_t>> linesOf(nodeCount(mesh));
  for (std::size_t side = 0; side < mesh.sideLine.size(); ++side)
    for (const std::size_t end : {2 * side, 2 * side + 1})
      linesOf[mesh.sides[end]].push_back(mesh.sideLine[side]);
  for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
    for (std::uint32_t line = 0; line < 3; ++line) {
      int on = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& lines = linesOf[mesh.triangles[3 * t + k]];
        on += std::ranges::find(lines, line) != lines.end() ? 1 : 0;
      }
      EXPECT_LT(on, 3) << "triangle " << t;
    }
  }
}

TEST(SurfacePatchMesher, CollinearLinesFormNoDegenerateTriangles) {
  // One edge of a tilted square is drawn as three lines, and edges of the holes are collinear with others.
  const Vec3 u(0.6, 0.64, 0.48);
  const Vec3 v(-0.8, 0.48, 0.36);
  const auto at = [&](double x, double y) { return x * u + y * v; };
  const Model model =
      polygonModel({{at(0, 0), at(0.1, 0), at(0.35, 0), at(1, 0), at(1, 1), at(0, 1)},
                    {at(0.2, 0.4), at(0.4, 0.4), at(0.4, 0.6), at(0.2, 0.6)},
                    {at(0.6, 0.4), at(0.8, 0.4), at(0.8, 0.6), at(0.6, 0.6)}});
  for (const double size : {2.0, 0.3, 0.05}) {
    const SizeField field = SizeField::uniform(size);
    const SurfaceMeasures found = measure(meshOf(model, field), field);
    EXPECT_EQ(found.eulerCharacteristic(), -1);
    EXPECT_NEAR(found.area, 0.92, 1e-12);
    EXPECT_GT(found.minAngle, size > 0.1 ? 5.0 : 20.0) << size;
  }
}

}  // namespace
}  // namespace tetrafront::testing
