// Curved patches of every type: the front closes, even if the surface is singular at a corner, and every node lies on
// the patch.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geom/predicates.h"
#include "model/check_model.h"
#include "model/patch_surface.h"
#include "support/meshed_surface.h"
#include "support/models.h"
#include "support/shapes.h"
#include "support/surface_measures.h"
#include "tetrafront/preview.h"

namespace tetrafront::testing {
namespace {

SurfaceMeasures measuresOf(const Model& model, double size) {
  const SizeField field = SizeField::uniform(size);
  const SurfaceMesh mesh = meshOf(model, field);
  const SurfaceMeasures found = measure(mesh, field);
  EXPECT_EQ(found.eulerCharacteristic(), 1);
  EXPECT_EQ(found.borderEdges, mesh.sideLine.size());
  EXPECT_EQ(found.nonManifoldEdges, 0U);
  return found;
}

// ---- on the patch --------------------------------------------------------------------------------

/// Distance of a position from a surface, by Gauss-Newton steps from the nearest point of a coarse lattice of the
/// domain.
double distanceTo(const UnitSurface& surface, const Vec3& position) {
  constexpr int kCells = 12;
  Vec2 unit(0.0);
  double least = 1e300;
  for (int j = 0; j <= kCells; ++j) {
    for (int i = 0; i <= kCells; ++i) {
      const Vec2 at = clampedToUnit(surface.shape(), Vec2(i, j) / static_cast<double>(kCells));
      const double distance = glm::length(surface.evaluate(at).position - position);
      if (distance >= least) continue;
      least = distance;
      unit = at;
    }
  }
  for (int step = 0; step < 60; ++step) {
    const SurfacePoint here = surface.evaluate(unit);
    const Vec3 gap = position - here.position;
    least = std::min(least, glm::length(gap));
    const double xx = glm::dot(here.alongXi, here.alongXi);
    const double xy = glm::dot(here.alongXi, here.alongEta);
    const double yy = glm::dot(here.alongEta, here.alongEta);
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0)) break;
    const Vec2 side(glm::dot(here.alongXi, gap), glm::dot(here.alongEta, gap));
    unit += Vec2(yy * side.x - xy * side.y, xx * side.y - xy * side.x) / determinant;
    unit = clampedToUnit(surface.shape(), unit);
  }
  return least;
}

TEST(SurfaceCurvedPatches, EveryNodeIsOnThePatch) {
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Model model = randomCurvedModel(type, seed, 0.2);
      const SurfaceMesh mesh = meshOf(model, SizeField::uniform(0.15));
      const ResolvedModel resolved(model);
      const UnitSurface surface(type, curvesOf(resolved, model.patches.front().loops.front()));
      double size = 0.0;
      for (const Vec3& point : model.points)
        size = std::max(size, glm::length(point - model.points.front()));
      for (std::uint32_t node = 0; node < nodeCount(mesh); ++node)
        EXPECT_LT(distanceTo(surface, pointOf(mesh, node)), 1e-12 * size)
            << "type " << static_cast<int>(type) << " seed " << seed << " node " << node;
    }
  }
}

/// The smallest angle between two successive lines of the patch, in degrees.
double smallestCorner(const Model& model) {
  const ResolvedModel resolved(model);
  const std::vector<OrientedCurve> lines = curvesOf(resolved, model.patches.front().loops.front());
  double smallest = 180.0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Vec3 in = glm::normalize(-lines[i].sample(1.0).derivative);
    const Vec3 out = glm::normalize(lines[(i + 1) % lines.size()].sample(0.0).derivative);
    smallest = std::min(smallest, std::acos(glm::dot(in, out)) * 180.0 / std::numbers::pi);
  }
  return smallest;
}

TEST(SurfaceCurvedPatches, RandomPatchesCloseWithGoodTriangles) {
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
      SCOPED_TRACE("type " + std::to_string(static_cast<int>(type)) + " seed " +
                   std::to_string(seed));
      const Model model = randomCurvedModel(type, seed, 0.04 * static_cast<double>(seed % 5));
      const SurfaceMeasures found = measuresOf(model, 0.06);
      EXPECT_GT(found.minAngle, std::min(20.0, 0.85 * smallestCorner(model)));
      EXPECT_GT(found.meanRadiusRatio, 0.93);
      EXPECT_NEAR(found.meanEdgeRatio, 1.0, 0.1);
    }
  }
}

TEST(SurfaceCurvedPatches, TrianglesFaceThePatch) {
  // In a plane, a flipped triangle would overlap others.
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Model model = randomCurvedModel(type, seed, 0.3);
      for (Vec3& point : model.points) point.z = 0.0;
      if (!diagnoseModel(model).empty()) continue;
      const SurfaceMesh mesh = meshOf(model, SizeField::uniform(seed % 2 == 0 ? 0.3 : 0.1));
      std::size_t left = 0;
      for (std::size_t t = 0; t < triangleCount(mesh); ++t) {
        const Vec3 a = pointOf(mesh, mesh.triangles[3 * t]);
        const Vec3 b = pointOf(mesh, mesh.triangles[3 * t + 1]);
        left += orient2d(a, b, pointOf(mesh, mesh.triangles[3 * t + 2])) > 0 ? 1 : 0;
      }
      EXPECT_TRUE(left == 0 || left == triangleCount(mesh))
          << "type " << static_cast<int>(type) << " seed " << seed << ": " << left << " of "
          << triangleCount(mesh);
    }
  }
}

// ---- singular corners ----------------------------------------------------------------------------

/// A quarter of the unit circle about the origin from u to v, as a spline.
std::uint32_t quarter(ModelBuilder& builder, const Vec3& u, const Vec3& v) {
  constexpr int kPieces = 8;
  std::vector<Vec3> positions{u};
  for (int i = 1; i < kPieces; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kPieces;
    positions.push_back(std::cos(angle) * u + std::sin(angle) * v);
  }
  positions.push_back(v);
  return builder.line(LineType::kSpline, positions);
}

TEST(SurfaceCurvedPatches, OctantBetweenThreeQuarterCirclesIsCoveredEvenly) {
  const Vec3 x(1, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  ModelBuilder builder;
  builder.patch(PatchType::kBarnhillGregoryNielson, {{{quarter(builder, x, y), false},
                                                      {quarter(builder, y, z), false},
                                                      {quarter(builder, z, x), false}}});
  // Eq. (14) at xi = eta = 1/3 by hand, with cos 30 degrees = c: flatter than the sphere.
  const double c = std::sqrt(0.75);
  const double least = glm::length(Vec3(2 * c - (2 * c + 1.0) / 3 - 1 / 3.0, 0.5, 0.5));
  for (const double size : {0.3, 0.1, 0.04}) {
    const SurfaceMeasures found = measuresOf(builder.model, size);
    EXPECT_GT(found.minAngle, 20.0) << size;
    EXPECT_GT(found.meanRadiusRatio, 0.93) << size;
    const SurfaceMesh mesh = meshOf(builder.model, SizeField::uniform(size));
    for (std::uint32_t node = 0; node < nodeCount(mesh); ++node) {
      EXPECT_GT(glm::length(pointOf(mesh, node)), least - 0.005);
      EXPECT_LT(glm::length(pointOf(mesh, node)), 1.001);
    }
  }
}

TEST(SurfaceCurvedPatches, TriangleWithASmoothCornerCloses) {
  // A half disc: its arc consists of two lines with a smooth corner at the top, where the angle is 180 degrees. Any of
  // the three lines is F2 once.
  ModelBuilder builder;
  const Vec3 x(1, 0, 0);
  const Vec3 z(0, 0, 1);
  const Loop loop{
      {quarter(builder, x, z), false}, {quarter(builder, z, -x), false}, builder.straight(-x, x)};
  for (std::size_t first = 0; first < 3; ++first) {
    Model model = builder.model;
    model.patches.push_back({PatchType::kBarnhillGregoryNielson,
                             {{loop[first], loop[(first + 1) % 3], loop[(first + 2) % 3]}}});
    for (const double size : {0.3, 0.1, 0.03}) {
      const SurfaceMeasures found = measuresOf(model, size);
      EXPECT_NEAR(found.area, 0.5 * std::numbers::pi, size * size + 2e-3) << first << " " << size;
      EXPECT_GT(found.meanRadiusRatio, 0.9) << first << " " << size;
    }
  }
}

/// Two parabolas that leave the origin in the same direction and bend to (1, low) and (1, high), as edges of a triangle
/// or of a quadrilateral.
Model cusp(PatchType type, double low, double high) {
  ModelBuilder builder;
  const Vec3 tip(0, 0, 0);
  const Vec3 below(1, low, 0);
  const Vec3 above(1, high, 0);
  const Vec3 end(1.3, 0.5 * (low + high), 0.1);
  const std::uint32_t first =
      builder.line(LineType::kParabolic, {tip, {0.5, 0.25 * low, 0}, below});
  const std::uint32_t last =
      builder.line(LineType::kParabolic, {tip, {0.5, 0.25 * high, 0}, above});
  if (type == PatchType::kCoons)
    builder.patch(type, {{{first, false},
                          builder.straight(below, end),
                          builder.straight(end, above),
                          {last, true}}});
  else
    builder.patch(type, {{{first, false}, builder.straight(below, above), {last, true}}});
  return builder.model;
}

TEST(SurfaceCurvedPatches, CuspsClose) {
  for (const PatchType type : {PatchType::kBarnhillGregoryNielson, PatchType::kCoons}) {
    for (const double size : {0.3, 0.1, 0.02}) {
      const SurfaceMeasures found = measuresOf(cusp(type, -0.4, 0.4), size);
      // At a distance of `size` from its end, the tip is 0.8 size^2 wide.
      EXPECT_GT(found.minAngle, 20.0 * size) << size;
      EXPECT_GT(found.meanRadiusRatio, size < 0.05 ? 0.9 : 0.5) << size;
    }
  }
}

TEST(SurfaceCurvedPatches, CuspOfLinesThatBendInOneDirectionFoldsAndIsReported) {
  // At its tip the triangle is (xi + eta, 0.2 xi^2 + 2 xi eta + 0.8 eta^2) to second order.
  const std::vector<Diagnostic> found =
      diagnoseModel(cusp(PatchType::kBarnhillGregoryNielson, 0.2, 0.8));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().code, DiagnosticCode::kDegeneratePatch);
  EXPECT_TRUE(found.front().hasPosition);
}

// ---- before meshing ------------------------------------------------------------------------------

TEST(SurfaceCurvedPatches, PreviewCoversThePatchAndNothingElse) {
  for (const PatchType type : kCurvedTypes) {
    const Model model = randomCurvedModel(type, 7, 0.1);
    const ModelPreview preview = previewModel(model, {});
    const std::size_t triangles = preview.patchTriangles.size() / 3;
    EXPECT_EQ(triangles, unitShapeOf(type) == UnitShape::kTriangle ? 256U : 512U);
    SurfaceMesh mesh;
    mesh.points = preview.patchPoints;
    mesh.triangles = preview.patchTriangles;
    const SurfaceMeasures found = measure(mesh, SizeField::uniform(1.0));
    EXPECT_EQ(found.eulerCharacteristic(), 1);
    EXPECT_NEAR(found.area, measuresOf(model, 0.05).area, 2e-3 * found.area);
  }
}

}  // namespace
}  // namespace tetrafront::testing
