// Curves and surfaces of trimmed models: derivatives agree with differences, splines with the shapes they stand for, and
// the closest position is the one that a surface position was moved away from along the normal.

#include "model/parametric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/edge_curve.h"
#include "model/face_loops.h"
#include "support/trimmed_models.h"

namespace tetrafront::testing {
namespace {

constexpr double kDifferenceStep = 1e-4;

void expectNear(const Vec3& found, const Vec3& expected, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], expected[axis], tolerance);
}

TEST(Parametric, DerivativesOfSurfacesAgreeWithDifferences) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    for (const TrimmedFace& face : solid.model.faces) {
      const FaceSurface& surface = solid.model.surfaces[face.surface];
      const ParameterBox box = FaceLoops(solid.model, face).box();
      for (const Vec2& part : {Vec2(0.21, 0.34), Vec2(0.68, 0.83), Vec2(0.47, 0.11)}) {
        const Vec2 at = box.low + part * (box.high - box.low);
        const SurfaceJet jet = evaluate(surface, at);
        const auto offset = [&](double du, double dv) {
          return evaluate(surface, at + Vec2(du, dv));
        };
        const double half = 0.5 / kDifferenceStep;
        const SurfaceJet right = offset(kDifferenceStep, 0.0);
        const SurfaceJet left = offset(-kDifferenceStep, 0.0);
        const SurfaceJet up = offset(0.0, kDifferenceStep);
        const SurfaceJet down = offset(0.0, -kDifferenceStep);
        expectNear(jet.u, half * (right.position - left.position), 1e-6);
        expectNear(jet.v, half * (up.position - down.position), 1e-6);
        expectNear(jet.uu, half * (right.u - left.u), 1e-5);
        expectNear(jet.uv, half * (up.u - down.u), 1e-5);
        expectNear(jet.uv, half * (right.v - left.v), 1e-5);
        expectNear(jet.vv, half * (up.v - down.v), 1e-5);
      }
    }
  }
}

TEST(Parametric, DerivativesOfCurvesAgreeWithDifferences) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    for (const TrimmedEdge& edge : solid.model.edges) {
      if (!edge.curve) continue;
      const SpaceCurve& curve = solid.model.curves[*edge.curve];
      const double t = edge.first + 0.37 * (edge.last - edge.first);
      const CurveJet<Vec3> after = evaluate(curve, t + kDifferenceStep);
      const CurveJet<Vec3> before = evaluate(curve, t - kDifferenceStep);
      const CurveJet<Vec3> here = evaluate(curve, t);
      expectNear(here.first, (0.5 / kDifferenceStep) * (after.position - before.position), 1e-6);
      expectNear(here.second, (0.5 / kDifferenceStep) * (after.first - before.first), 1e-5);
    }
  }
}

TEST(Parametric, EdgesHaveTheLengthAndTurningOfTheirShapes) {
  const TrimmedSolid cylinder = nurbsCylinder(2.0, 3.0);
  const EdgeCurve circle(cylinder.model, cylinder.model.edges[0]);
  EXPECT_NEAR(circle.length(0.0, 1.0), 4.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(circle.length(0.25, 0.5), std::numbers::pi, 1e-9);
  EXPECT_NEAR(circle.turning(), 2.0 * std::numbers::pi, 1e-9);
  const EdgeCurve seam(cylinder.model, cylinder.model.edges[2]);
  EXPECT_NEAR(seam.length(0.0, 1.0), 3.0, 1e-12);
  EXPECT_EQ(seam.turning(), 0.0);
}

TEST(Parametric, ClosestPositionIsTheFootOfTheNormal) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    for (const TrimmedFace& face : solid.model.faces) {
      const FaceSurface& surface = solid.model.surfaces[face.surface];
      const ParameterBox box = FaceLoops(solid.model, face).box();
      for (const Vec2& part : {Vec2(0.21, 0.34), Vec2(0.68, 0.83)}) {
        const SurfaceJet jet = evaluate(surface, box.low + part * (box.high - box.low));
        const Vec3 normal = glm::normalize(glm::cross(jet.u, jet.v));
        for (const double away : {-0.01, 0.0, 0.02}) {
          const Vec2 found = closestParameters(surface, box, jet.position + away * normal);
          expectNear(evaluate(surface, found).position, jet.position, 1e-9);
        }
      }
    }
  }
}

TEST(Parametric, MissingCurvesInThePlaneAreFoundByProjection) {
  for (const TrimmedSolid& solid : trimmedSolids()) {
    SCOPED_TRACE(solid.name);
    TrimmedModel model = solid.model;
    for (TrimmedFace& face : model.faces)
      if (model.surfaces[face.surface].kind == SurfaceKind::kPlane)
        for (std::vector<Coedge>& loop : face.loops)
          for (Coedge& coedge : loop) coedge.inPlane.reset();
    for (const TrimmedFace& face : model.faces) {
      const FaceLoops loops(model, face);
      ASSERT_TRUE(loops.isUsable());
      for (std::size_t loop = 0; loop < loops.loops().size(); ++loop) {
        for (std::size_t index = 0; index < loops.loops()[loop].size(); ++index) {
          const EdgeCurve curve(model, model.edges[loops.loops()[loop][index]->edge]);
          for (const double t : {0.0, 0.3, 0.77, 1.0}) {
            const Vec3 position = curve.position(t);
            const Vec2 uv = loops.parametersAt(loop, index, t, position);
            expectNear(evaluate(model.surfaces[face.surface], uv).position, position, 1e-9);
          }
        }
      }
    }
  }
}

TEST(Parametric, PolesAreFoundAndOpenLoopsRefused) {
  const TrimmedSolid sphere = trimmedSphere(1.0);
  const FaceLoops loops(sphere.model, sphere.model.faces[0]);
  EXPECT_TRUE(loops.poles().vLow && loops.poles().vHigh);
  EXPECT_FALSE(loops.poles().uLow || loops.poles().uHigh);
  const TrimmedSolid cone = trimmedCone(1.0, 0.0, 1.0);
  const FaceLoops side(cone.model, cone.model.faces[0]);
  EXPECT_TRUE(side.poles().vHigh);
  EXPECT_FALSE(side.poles().vLow);
  // A side whose loop lacks its seam runs round without closing in the plane.
  TrimmedSolid cylinder = trimmedCylinder(1.0, 1.0);
  std::vector<Coedge>& loop = cylinder.model.faces[0].loops[0];
  loop.erase(loop.begin() + 3);
  const FaceLoops open(cylinder.model, cylinder.model.faces[0]);
  EXPECT_TRUE(open.open().has_value());
  EXPECT_FALSE(open.isUsable());
}

}  // namespace
}  // namespace tetrafront::testing
