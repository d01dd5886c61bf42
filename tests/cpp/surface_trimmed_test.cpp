// Trimmed faces: every kind of surface is meshed on itself, watertight, and its area and volume converge to the exact
// values at second order.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/fingerprint.h"
#include "support/surface_measures.h"
#include "support/trimmed_models.h"
#include "surface/trimmed_mesher.h"

namespace tetrafront::testing {
namespace {

SurfaceMesh trimmedMeshOf(const TrimmedModel& model, double size,
                          std::uint32_t budget = 1U << 30U) {
  const SizeField field = SizeField::uniform(size);
  TrimmedMesher mesher(model, field);
  while (mesher.advance(budget) == MeshStatus::kRunning) {
  }
  EXPECT_TRUE(mesher.diagnostics().empty());
  return mesher.takeMesh();
}

Vec3 nodeOf(const SurfaceMesh& mesh, std::size_t node) {
  return {mesh.points[3 * node], mesh.points[3 * node + 1], mesh.points[3 * node + 2]};
}

/// Divergence theorem: positive if the triangles face outward.
double volumeInside(const SurfaceMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    const Vec3 a = nodeOf(mesh, mesh.triangles[t]);
    const Vec3 b = nodeOf(mesh, mesh.triangles[t + 1]);
    const Vec3 c = nodeOf(mesh, mesh.triangles[t + 2]);
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

/// Largest distance of a node from the surfaces of the faces it belongs to.
double distanceFromSurfaces(const TrimmedSolid& solid, const SurfaceMesh& mesh) {
  double largest = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    largest = std::max(largest,
                       solid.distances[mesh.trianglePatch[i / 3]](nodeOf(mesh, mesh.triangles[i])));
  return largest;
}

TEST(TrimmedSurface, EverySolidIsWatertightOnItsSurfaces) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    for (const double size : {1.0, 0.3, 0.1}) {
      SCOPED_TRACE(solid.name + " " + std::to_string(size));
      const SurfaceMesh mesh = trimmedMeshOf(solid.model, size);
      const SurfaceMeasures found = measure(mesh, SizeField::uniform(size));
      EXPECT_EQ(found.borderEdges, 0U);
      EXPECT_EQ(found.nonManifoldEdges, 0U);
      EXPECT_EQ(found.eulerCharacteristic(), solid.eulerCharacteristic);
      EXPECT_LT(distanceFromSurfaces(solid, mesh), 1e-9);
      EXPECT_GT(volumeInside(mesh), 0.0);
      if (size == 0.1) {
        EXPECT_GT(found.minAngle, 25.0);
        EXPECT_GT(found.meanRadiusRatio, 0.93);
        EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.1);
      }
    }
  }
}

TEST(TrimmedSurface, AreaAndVolumeConvergeAtSecondOrder) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    const SurfaceMesh coarse = trimmedMeshOf(solid.model, 0.2);
    const SurfaceMesh fine = trimmedMeshOf(solid.model, 0.05);
    const auto areaOf = [](const SurfaceMesh& mesh) {
      return measure(mesh, SizeField::uniform(1.0)).area;
    };
    // A quarter of the size: second order divides errors by 16; the exponent must be at least 1.75.
    const double factor = std::pow(4.0, 1.75);
    SCOPED_TRACE(solid.name);
    EXPECT_LT(std::fabs(areaOf(fine) - solid.area),
              std::fabs(areaOf(coarse) - solid.area) / factor + 1e-11);
    EXPECT_LT(std::fabs(volumeInside(fine) - solid.volume),
              std::fabs(volumeInside(coarse) - solid.volume) / factor + 1e-11);
    EXPECT_NEAR(volumeInside(fine), solid.volume, 4e-3 * solid.volume);
  }
}

TEST(TrimmedSurface, NeedlesAreFilledOnceOrGivenUp) {
  int filled = 0;
  for (const double radius : {0.02, 0.05, 0.0724, 0.1, 0.2, 0.4}) {
    const TrimmedSolid cone = trimmedCone(radius, 0.0, 1.4);
    for (const double size : {0.1, 0.02, 0.01, 0.007}) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::to_string(size));
      const SizeField field = SizeField::uniform(size);
      TrimmedMesher mesher(cone.model, field);
      // A front that has run over its own triangles never ends.
      for (int slice = 0; mesher.advance(1000) == MeshStatus::kRunning && slice < 10000; ++slice) {
      }
      ASSERT_NE(mesher.advance(1), MeshStatus::kRunning);
      if (!mesher.diagnostics().empty()) continue;
      const SurfaceMeasures found = measure(mesher.takeMesh(), field);
      EXPECT_EQ(found.borderEdges, 0U);
      // Triangles lie inside a cone: a larger area is covered twice, a much smaller one not at all.
      EXPECT_LT(found.area, cone.area);
      EXPECT_GT(found.area, 0.97 * cone.area);
      ++filled;
    }
  }
  EXPECT_GE(filled, 8);
}

/// A square with a round hole that is tangent to it at a vertex of both.
TrimmedModel squareWithTangentHole(double width, double radius) {
  TrimmedModel model;
  model.vertices = {{0.0, 0.0, 0.0},
                    {width, 0.0, 0.0},
                    {width, width, 0.0},
                    {0.0, width, 0.0},
                    {0.0, 0.5 * width, 0.0}};
  model.surfaces.emplace_back();
  std::vector<Coedge> outer;
  for (std::uint32_t v = 0; v < 5; ++v) {
    const std::uint32_t next = (v + 1) % 5;
    const Vec3 along = model.vertices[next] - model.vertices[v];
    SpaceCurve line;
    line.frame = {model.vertices[v], glm::normalize(along), {}, {}};
    model.curves.push_back(line);
    model.edges.push_back({v, 0.0, glm::length(along), v, next, 0.0});
    outer.push_back({v, false, {}});
  }
  SpaceCurve circle;
  circle.kind = CurveKind::kCircle;
  circle.frame.origin = {radius, 0.5 * width, 0.0};
  circle.frame.x = {-1.0, 0.0, 0.0};
  circle.frame.y = {0.0, -1.0, 0.0};
  circle.radius = radius;
  model.curves.push_back(circle);
  constexpr double kTurn = 6.283185307179586;
  model.edges.push_back({5U, 0.0, kTurn, 4, 4, 0.0});
  model.faces.push_back({0, false, {outer, {{5, true, {}}}}});
  return model;
}

TEST(TrimmedSurface, LoopsMayTouchAtAVertex) {
  const TrimmedModel model = squareWithTangentHole(4.0, 1.0);
  for (const double size : {0.5, 0.2, 0.05}) {
    SCOPED_TRACE(size);
    const SurfaceMesh mesh = trimmedMeshOf(model, size);
    const SurfaceMeasures found = measure(mesh, SizeField::uniform(size));
    EXPECT_EQ(found.nonManifoldEdges, 0U);
    EXPECT_EQ(found.borderEdges, mesh.sides.size() / 2);
    // One hole, of which the vertex is a part of the outer loop too.
    EXPECT_EQ(found.eulerCharacteristic(), 0);
    EXPECT_NEAR(found.area, 16.0 - 3.141592653589793, 0.6 * size * size);
    EXPECT_GT(found.minAngle, 1.0);
  }
}

}  // namespace
}  // namespace tetrafront::testing
