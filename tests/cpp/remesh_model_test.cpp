// Surfaces that approximate the faces of a model are remeshed on these faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/remeshed.h"
#include "support/trimmed_models.h"
#include "surface/trimmed_mesher.h"
#include "tetrafront/remesh.h"
#include "topology/mesh_access.h"
#include "topology/surface_access.h"

namespace tetrafront::testing {
namespace {

/// The model in fine triangles, as a CAD kernel makes them.
SurfaceMesh finely(const TrimmedModel& model) {
  const SizeField field = SizeField::uniform(0.1);
  TrimmedMesher mesher(model, field);
  while (mesher.advance(1U << 30U) == MeshStatus::kRunning) {
  }
  EXPECT_TRUE(mesher.diagnostics().empty());
  return mesher.takeMesh();
}

SurfaceRemesh remeshed(const SurfaceMesh& given, const std::vector<double>& numbers,
                       std::uint32_t budget = 1U << 30U) {
  SurfaceRemesher remesher(given.points, given.triangles, given.trianglePatch, {}, {}, {}, numbers);
  while (!remesher.advance(budget)) {
  }
  return remesher.result();
}

/// Returns the largest distance of a node from the face of the given triangle that its triangle comes from.
double farthestNode(const TrimmedSolid& solid, const SurfaceMesh& given,
                    const SurfaceRemesh& result) {
  const SurfaceMesh made = surfaceOf(result);
  double farthest = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    const std::uint32_t face = given.trianglePatch[result.origin[t.index()]];
    for (const Vec3& corner : cornersOf(made, t))
      farthest = std::max(farthest, solid.distances[face](corner));
  }
  return farthest;
}

TEST(RemeshModel, HasItsNodesOnTheFaces) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    const SurfaceMesh given = finely(solid.model);
    const SurfaceRemesh result = remeshed(given, numbersOf(solid.model));
    ASSERT_TRUE(result.diagnostics.empty());
    EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kByOrientation).empty());
    EXPECT_LT(farthestNode(solid, given, result), 1e-9);
    EXPECT_LE(result.deviation, 2.0 * result.tolerance);
    EXPECT_GT(result.smallestAngle, 20.0);
    EXPECT_NEAR(result.volume, solid.volume, 0.05 * solid.volume);
  }
}

TEST(RemeshModel, DoesNotDependOnSlices) {
  const TrimmedSolid solid = trimmedPlate(4.0, 0.5, 1.0);
  const SurfaceMesh given = finely(solid.model);
  const SurfaceRemesh whole = remeshed(given, numbersOf(solid.model));
  const SurfaceRemesh sliced = remeshed(given, numbersOf(solid.model), 16);
  EXPECT_EQ(whole.points, sliced.points);
  EXPECT_EQ(whole.triangles, sliced.triangles);
  EXPECT_EQ(whole.origin, sliced.origin);
}

TEST(RemeshModel, KeepsTheLinesOfPatchesThatDivideAFace) {
  const TrimmedSolid solid = trimmedSphere(1.0);
  SurfaceMesh given = finely(solid.model);
  // The triangles whose centroid is above a plane are a patch of their own.
  double area = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(given))) {
    const std::array<Vec3, 3> corners = cornersOf(given, t);
    if (centroidOf(corners).z <= 0.3) continue;
    given.trianglePatch[t.index()] = 1;
    area += areaOf(corners);
  }
  const SurfaceRemesh result = remeshed(given, numbersOf(solid.model));
  const SurfaceMesh made = surfaceOf(result);
  double madeArea = 0.0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    if (given.trianglePatch[result.origin[t.index()]] == 1) madeArea += areaOf(cornersOf(made, t));
  }
  EXPECT_NEAR(madeArea, area, 0.05 * area);
}

TEST(RemeshModel, OfAnotherShapeIsNotUsed) {
  const SurfaceMesh given = finely(trimmedCylinder(1.0, 2.0).model);
  const SurfaceRemesh alone = remeshed(given, {});
  std::vector<double> damaged = numbersOf(trimmedCylinder(1.0, 2.0).model);
  damaged.resize(damaged.size() / 2);
  for (const std::vector<double>& numbers :
       {numbersOf(trimmedCylinder(1.2, 2.0).model), numbersOf(trimmedSphere(1.0).model), damaged}) {
    const SurfaceRemesh result = remeshed(given, numbers);
    EXPECT_EQ(result.points, alone.points);
    EXPECT_EQ(result.triangles, alone.triangles);
  }
}

TEST(RemeshModel, NamesTheFaceThatCannotBeTriangulated) {
  const TrimmedSolid solid = trimmedCylinder(1.0, 1.0);
  const SurfaceMesh given = finely(solid.model);
  TrimmedModel damaged = solid.model;
  std::vector<Coedge>& loop = damaged.faces[0].loops[0];
  ASSERT_GT(loop.size(), 2U);
  loop.pop_back();
  const SurfaceRemesh result = remeshed(given, numbersOf(damaged));
  ASSERT_TRUE(result.diagnostics.empty());
  EXPECT_FALSE(result.onFaces);
  EXPECT_EQ(result.failedFaces, (std::vector<std::uint32_t>{0}));
  EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kByOrientation).empty());
  EXPECT_TRUE(remeshed(given, numbersOf(solid.model)).failedFaces.empty());
}

}  // namespace
}  // namespace tetrafront::testing
