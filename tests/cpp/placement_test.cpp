// Nodes near a trimmed model are placed on its faces, edges and vertices.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/model_numbers.h"
#include "model/parametric.h"
#include "support/meshed_models.h"
#include "support/random.h"
#include "support/slices.h"
#include "support/trimmed_models.h"
#include "tetrafront/node_placement.h"

namespace tetrafront::testing {
namespace {

constexpr double kSize = 0.25;
constexpr double kReach = 0.1;

Vec3 positionAt(const std::vector<double>& points, std::size_t node) {
  return {points[3 * node], points[3 * node + 1], points[3 * node + 2]};
}

NodePlacement placed(const TrimmedSolid& solid, const SurfaceMesh& mesh, std::uint32_t budget,
                     double modelSize = 0.2) {
  NodePlacer placer(mesh.points, mesh.triangles, mesh.trianglePatch, numbersOf(solid.model),
                    modelTriangles(solid.model, modelSize), kReach);
  while (!placer.advance(budget)) {
  }
  return placer.result();
}

TEST(NodePlacement, MovesNodesOntoFacesAndEdges) {
  Random random(7);
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    SurfaceMesh mesh = meshOfModel(solid.model, kSize);
    for (double& coordinate : mesh.points) coordinate += random.between(-0.02, 0.02);
    const NodePlacement found = placed(solid, mesh, 1U << 30U);
    EXPECT_TRUE(found.unplaced.empty());
    EXPECT_EQ(found.placed, mesh.points.size() / 3);
    EXPECT_LE(found.largestMove, 0.04);
    EXPECT_GT(found.largestMove, 0.01);
    double distance = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      distance = std::max(distance, solid.distances[mesh.trianglePatch[i / 3]](
                                        positionAt(found.points, mesh.triangles[i])));
    }
    EXPECT_LT(distance, 1e-9);
  }
}

/// The model's triangles and straight pieces of edges are farther from its faces than half an edge of the mesh.
TEST(NodePlacement, FindsTheFacesBehindCoarseTriangles) {
  const TrimmedSolid solid = trimmedCylinder(1.0, 0.2);
  const SurfaceMesh mesh = meshOfModel(solid.model, 0.03);
  const ModelTriangles coarse = modelTriangles(solid.model, 1.0);
  NodePlacer placer(mesh.points, mesh.triangles, mesh.trianglePatch, numbersOf(solid.model), coarse,
                    0.2);
  while (!placer.advance(1U << 30U)) {
  }
  EXPECT_TRUE(placer.result().unplaced.empty());
}

/// A cone's surface goes on beyond its apex, where the mean of the normals is similar to none of them if the cone is sharp.
TEST(NodePlacement, StaysOnOneSideOfAnApex) {
  for (const double height : {1.5, 3.0}) {
    const TrimmedSolid solid = trimmedCone(1.0, 0.0, height);
    SurfaceMesh mesh = meshOfModel(solid.model, kSize);
    std::size_t apex = 0;
    for (std::size_t node = 0; node < mesh.points.size() / 3; ++node)
      if (mesh.points[3 * node + 2] > mesh.points[3 * apex + 2]) apex = node;
    mesh.points[3 * apex] += 0.02;
    mesh.points[3 * apex + 2] += 0.05;
    for (const double modelSize : {0.1, 0.2}) {
      SCOPED_TRACE(::testing::Message() << "height " << height << ", triangles of " << modelSize);
      const NodePlacement found = placed(solid, mesh, 1U << 30U, modelSize);
      EXPECT_TRUE(found.unplaced.empty());
      EXPECT_LT(solid.distances[0](positionAt(found.points, apex)), 1e-9);
    }
  }
}

TEST(NodePlacement, BendsEdgesOntoTheFacesBesideThem) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    const SurfaceMesh mesh = meshOfModel(solid.model, kSize);
    const NodePlacement found = placed(solid, mesh, 1U << 30U);
    ASSERT_EQ(found.middles.size(), 3 * found.curvedEdges.size() / 2);
    double distance = 0.0;
    std::size_t sides = 0;
    for (std::size_t corner = 0; corner < mesh.triangles.size(); ++corner) {
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      const auto [low, high] = std::minmax(mesh.triangles[corner], mesh.triangles[next]);
      Vec3 middle = 0.5 * (positionAt(found.points, low) + positionAt(found.points, high));
      for (std::size_t edge = 0; edge < found.curvedEdges.size() / 2; ++edge) {
        if (found.curvedEdges[2 * edge] != low || found.curvedEdges[2 * edge + 1] != high) continue;
        middle = positionAt(found.middles, edge);
        ++sides;
      }
      distance = std::max(distance, solid.distances[mesh.trianglePatch[corner / 3]](middle));
    }
    EXPECT_LT(distance, 1e-9);
    // Each curved edge has two triangles.
    EXPECT_EQ(sides, found.curvedEdges.size());
    EXPECT_EQ(sides > 0, solid.name != "box");
  }
}

TEST(NodePlacement, DoesNotDependOnSlices) {
  const TrimmedSolid solid = trimmedCylinder(1.0, 2.0);
  const SurfaceMesh mesh = meshOfModel(solid.model, kSize);
  const NodePlacement whole = placed(solid, mesh, 1U << 30U);
  const NodePlacement sliced = placed(solid, mesh, 3);
  EXPECT_EQ(whole.points, sliced.points);
  EXPECT_EQ(whole.curvedEdges, sliced.curvedEdges);
  EXPECT_EQ(whole.middles, sliced.middles);
}

TEST(NodePlacement, LeavesNodesFarFromTheModel) {
  const TrimmedSolid solid = trimmedSphere(1.0);
  SurfaceMesh mesh = meshOfModel(solid.model, kSize);
  for (double& coordinate : mesh.points) coordinate *= 1.5;
  const NodePlacement found = placed(solid, mesh, 1U << 30U);
  EXPECT_EQ(found.placed, 0U);
  EXPECT_EQ(found.unplaced.size(), mesh.points.size() / 3);
  EXPECT_EQ(found.points, mesh.points);
}

TEST(ModelNumbers, AreReadAsTheyWereWritten) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    const std::vector<double> numbers = numbersOf(solid.model);
    const std::optional<ReadModel> read = readModel(numbers);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(numbersOf(read->model), numbers);
    EXPECT_EQ(std::ranges::count(read->isSurfaceValid, 1), std::ssize(solid.model.surfaces));
    EXPECT_EQ(std::ranges::count(read->isEdgeValid, 1), std::ssize(solid.model.edges));
  }
}

TEST(ModelNumbers, DamagedNumbersAttractNoNode) {
  const TrimmedSolid solid = nurbsCylinder(1.0, 2.0);
  const SurfaceMesh mesh = meshOfModel(solid.model, 2.0 * kSize);
  const ModelTriangles triangles = modelTriangles(solid.model, 0.4);
  const std::vector<double> numbers = numbersOf(solid.model);
  // Whatever is wrong with a number, all positions stay finite.
  for (std::size_t i = 0; i < numbers.size(); i += 7) {
    for (const double wrong : {-1.0, 0.0, 1e300, std::nan("")}) {
      std::vector<double> damaged = numbers;
      damaged[i] = wrong;
      NodePlacer placer(mesh.points, mesh.triangles, mesh.trianglePatch, damaged, triangles,
                        kReach);
      while (!placer.advance(1U << 30U)) {
      }
      EXPECT_TRUE(std::ranges::all_of(placer.result().points,
                                      [](double value) { return std::isfinite(value); }));
    }
  }
  EXPECT_FALSE(readModel(std::span(numbers).first(numbers.size() - 1)).has_value());
}

}  // namespace
}  // namespace tetrafront::testing
