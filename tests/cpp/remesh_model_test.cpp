// Surfaces that approximate the faces of a model are remeshed on these faces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

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
                       std::uint32_t budget = 1U << 30U, const RemeshOptions& options = {}) {
  SurfaceRemesher remesher(given.points, given.triangles, given.trianglePatch, {}, options, {},
                           numbers);
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

/// Returns the model, moved.
TrimmedModel movedBy(TrimmedModel model, const Vec3& by) {
  const auto move = [&](SpaceCurve& curve) {
    curve.frame.origin += by;
    for (Vec3& pole : curve.spline.poles) pole += by;
  };
  for (Vec3& vertex : model.vertices) vertex += by;
  for (SpaceCurve& curve : model.curves) move(curve);
  for (FaceSurface& surface : model.surfaces) {
    surface.frame.origin += by;
    for (Vec3& pole : surface.spline.poles) pole += by;
    move(surface.profile);
  }
  return model;
}

TEST(RemeshModel, HasItsNodesOnFacesFarFromTheOrigin) {
  const Vec3 far(0x1p13, -0x1p14, 0.0);
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    const TrimmedModel model = movedBy(solid.model, far);
    const SurfaceMesh given = finely(model);
    SurfaceRemesh result = remeshed(given, numbersOf(model));
    EXPECT_TRUE(result.onFaces);
    EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kByOrientation).empty());
    for (std::size_t i = 0; i < result.points.size(); ++i)
      result.points[i] -= far[static_cast<int>(i % 3)];
    EXPECT_LT(farthestNode(solid, given, result), 1e-9);
    EXPECT_GT(result.smallestAngle, 20.0);
  }
}

/// On a torus, single triangles are larger than their sizes.
TEST(RemeshModel, HasEveryTriangleWithinAGivenTolerance) {
  for (const TrimmedSolid& solid : {trimmedTorus(1.0, 0.4), trimmedSphere(1.0)}) {
    const SurfaceMesh given = finely(solid.model);
    for (const double tolerance : {0.02, 0.01, 0.007}) {
      RemeshOptions options;
      options.tolerance = tolerance;
      const SurfaceRemesh result = remeshed(given, numbersOf(solid.model), 1U << 30U, options);
      ASSERT_TRUE(result.onFaces);
      EXPECT_LE(result.deviation, tolerance);
      const SurfaceMesh made = surfaceOf(result);
      double farthest = 0.0;
      for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
        const std::uint32_t face = given.trianglePatch[result.origin[t.index()]];
        farthest = std::max(farthest, solid.distances[face](centroidOf(cornersOf(made, t))));
      }
      EXPECT_LT(farthest, tolerance);
      EXPECT_GT(farthest, 0.3 * tolerance);
    }
  }
}

/// The cosine of a right angle, rounded, makes coordinates that are nearly zero; the engine accepts none below 1e-75.
TEST(RemeshModel, HasZerosForCoordinatesThatAreTooSmall) {
  TrimmedSolid solid = trimmedPlate(4.0, 0.5, 1.0);
  for (Vec3& vertex : solid.model.vertices)
    for (int k = 0; k < 3; ++k)
      if (vertex[k] == 0.0) vertex[k] = 1e-90;
  const SurfaceMesh given = finely(trimmedPlate(4.0, 0.5, 1.0).model);
  const SurfaceRemesh result = remeshed(given, numbersOf(solid.model));
  EXPECT_TRUE(result.onFaces);
  EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kByOrientation).empty());
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

/// Returns the model without the last edge of a loop of a face, which cannot be triangulated then.
TrimmedModel withOpenLoop(TrimmedModel model, std::size_t face) {
  model.faces[face].loops[0].pop_back();
  return model;
}

/// Expects all faces but one on their surfaces: their nodes away from it on them, and its own within the tolerance. Returns how many
/// nodes of triangles are away from it.
std::size_t expectOthersOnFaces(const TrimmedSolid& solid, const SurfaceMesh& given,
                                std::uint32_t face, const SurfaceRemesh& result) {
  EXPECT_TRUE(result.diagnostics.empty());
  EXPECT_TRUE(result.onFaces);
  EXPECT_TRUE(errorsOf(surfaceOf(result), InnerShells::kByOrientation).empty());
  EXPECT_LE(result.deviation, 2.0 * result.tolerance);
  EXPECT_GT(result.smallestAngle, 15.0);
  EXPECT_NEAR(result.volume, solid.volume, 0.05 * solid.volume);
  EXPECT_LT(farthestNode(solid, given, result), 1.1 * result.tolerance);
  const SurfaceMesh made = surfaceOf(result);
  // Triangles without a node of the face, or of a triangle beside it.
  std::vector<std::uint8_t> isNear(countNodes(made), 0);
  for (int depth = 0; depth < 5; ++depth) {
    const std::vector<std::uint8_t> before = isNear;
    for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
      const NodeTriple nodes = nodesOf(made, t);
      const bool isOfFace = given.trianglePatch[result.origin[t.index()]] == face;
      if (isOfFace || std::ranges::any_of(nodes, [&](NodeId n) { return before[n.index()] != 0; }))
        for (const NodeId node : nodes) isNear[node.index()] = 1;
    }
  }
  std::size_t onSurface = 0;
  for (const TriangleId t : IdRange<TriangleId>(countTriangles(made))) {
    for (const NodeId node : nodesOf(made, t)) {
      if (isNear[node.index()] != 0) continue;
      const std::uint32_t own = given.trianglePatch[result.origin[t.index()]];
      EXPECT_LT(solid.distances[own](pointOf(made, node)), 1e-9);
      ++onSurface;
    }
  }
  return onSurface;
}

TEST(RemeshModel, KeepsTheOtherFacesOnTheirSurfacesIfOneCannotBeTriangulated) {
  std::size_t onSurface = 0;
  for (const TrimmedSolid& solid :
       {trimmedCylinder(1.0, 3.0), trimmedPlate(3.0, 0.5, 1.0),
        trimmedBox(Vec3(0.0), Vec3(3.0, 2.0, 1.0)), extrudedProfile(2.0), revolvedProfile()}) {
    const SurfaceMesh given = finely(solid.model);
    for (std::uint32_t face = 0; face < solid.model.faces.size(); ++face) {
      SCOPED_TRACE(solid.name + " face " + std::to_string(face));
      // The opposite faces of a box are alike.
      if (solid.name == "box" && face % 2 == 1) continue;
      // A model with an empty loop is not read.
      if (solid.model.faces[face].loops[0].size() == 1) continue;
      const SurfaceRemesh result = remeshed(given, numbersOf(withOpenLoop(solid.model, face)));
      EXPECT_EQ(result.failedFaces, (std::vector<std::uint32_t>{face}));
      onSurface += expectOthersOnFaces(solid, given, face, result);
    }
    EXPECT_TRUE(remeshed(given, numbersOf(solid.model)).failedFaces.empty());
  }
  EXPECT_GT(onSurface, 0U);
}

TEST(RemeshModel, KeepsTheGivenTrianglesOfFacesThatTheModelDoesNotHave) {
  const TrimmedSolid solid = trimmedPlate(4.0, 0.5, 1.0);
  const SurfaceMesh given = finely(solid.model);
  std::size_t onSurface = 0;
  for (std::uint32_t face = 0; face < solid.model.faces.size(); ++face) {
    SCOPED_TRACE("face " + std::to_string(face));
    TrimmedModel model = solid.model;
    model.faces.erase(model.faces.begin() + face);
    const SurfaceRemesh result = remeshed(given, numbersOf(model));
    EXPECT_TRUE(result.failedFaces.empty());
    onSurface += expectOthersOnFaces(solid, given, face, result);
  }
  EXPECT_GT(onSurface, 0U);
}

}  // namespace
}  // namespace tetrafront::testing
