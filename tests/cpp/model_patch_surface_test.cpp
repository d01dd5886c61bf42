// Patches as surfaces over their plane, Löhner & Parikh 1988, appendix.

#include "model/patch_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

constexpr double kBend = 0.3;

CoonsSurface coonsOf(const ResolvedModel& model) {
  return CoonsSurface(curvesOf(model, model.model().patches.front().loops.front()));
}

TEST(ModelStretchedPlane, InverseUndoesTheMapping) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    const StretchedPlane plane(random.between(0.01, 10), random.between(0.01, 10),
                               random.between(0.01, 10), random.inBox(), random.inBox());
    const Vec2 unit(random.unit(), random.unit());
    const Vec2 back = plane.toUnit(plane.toPlane(unit));
    EXPECT_LT(glm::length(back - unit), 1e-11);
  }
}

TEST(ModelStretchedPlane, KeepsTheThreeLengthsAndTheAngle) {
  const Vec3 alongAB(2, 0, 0);
  const Vec3 alongAD(1, std::sqrt(3.0), 0);  // 60 degrees
  const StretchedPlane plane(3.0, 2.0, 1.5, alongAB, alongAD);
  const Vec2 b = plane.toPlane({1, 0});
  const Vec2 c = plane.toPlane({1, 1});
  const Vec2 d = plane.toPlane({0, 1});
  EXPECT_NEAR(glm::length(b), 3.0, 1e-14);
  EXPECT_NEAR(glm::length(d), 2.0, 1e-14);
  EXPECT_NEAR(glm::length(c - d), 1.5, 1e-14);
  EXPECT_NEAR(glm::dot(b, d) / 6.0, 0.5, 1e-14);
  EXPECT_EQ(c.y, d.y);
}

TEST(ModelStretchedPlane, ClampsTheAngleOfADegenerateCorner) {
  for (const Vec3& alongAD : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 0)}) {
    const StretchedPlane plane(1.0, 1.0, 1.0, Vec3(1, 0, 0), alongAD);
    EXPECT_GE(plane.toPlane({0, 1}).y, 0.342);  // sin 20 degrees
  }
}

TEST(ModelStretchedPlane, DerivativesAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  const StretchedPlane plane(3.0, 2.0, 1.5, {2, 0, 0}, {1, 1, 0});
  const Vec2 unit(0.3, 0.6);
  const Vec2 at = plane.toPlane(unit);
  const StretchedPlane::Derivatives found = plane.derivatives(unit);
  const Vec2 byXi =
      (plane.toUnit(at + Vec2(kStep, 0)) - plane.toUnit(at - Vec2(kStep, 0))) / (2 * kStep);
  const Vec2 byEta =
      (plane.toUnit(at + Vec2(0, kStep)) - plane.toUnit(at - Vec2(0, kStep))) / (2 * kStep);
  EXPECT_NEAR(found.xiByXi, byXi.x, 1e-8);
  EXPECT_NEAR(found.xiByEta, byEta.x, 1e-8);
  EXPECT_NEAR(found.etaByEta, byEta.y, 1e-8);
  EXPECT_NEAR(byXi.y, 0.0, 1e-8);
}

TEST(ModelCoons, ReproducesItsFourLines) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Model model = randomCoonsModel(seed, kBend);
    const ResolvedModel resolved(model);
    const CoonsSurface surface = coonsOf(resolved);
    const Loop& loop = model.patches.front().loops.front();
    for (double t = 0.0; t <= 1.0; t += 0.0625) {
      const std::array<Vec2, 4> unit{Vec2(t, 0), Vec2(1, t), Vec2(1 - t, 1), Vec2(0, 1 - t)};
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 onLine = resolved.curve(loop[i]).position(t);
        EXPECT_LT(glm::length(surface.evaluate(unit[i]).position - onLine), 1e-13 * 4.0)
            << "seed " << seed << " line " << i << " t " << t;
      }
    }
  }
}

TEST(ModelCoons, TangentsAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Model model = randomCoonsModel(seed, kBend);
    const ResolvedModel resolved(model);
    const PatchSurface surface(resolved, model.patches.front());
    const Vec2 at = surface.mapped()->stretchedPlane().toPlane({0.37, 0.61});
    const SurfacePoint here = surface.evaluate(at);
    const auto difference = [&](const Vec2& step) {
      return (surface.evaluate(at + step).position - surface.evaluate(at - step).position) /
             (2 * kStep);
    };
    EXPECT_LT(glm::length(here.alongXi - difference({kStep, 0})), 1e-7);
    EXPECT_LT(glm::length(here.alongEta - difference({0, kStep})), 1e-7);
  }
}

TEST(ModelCoons, FollowsAffineMaps) {
  const auto transform = [](const Vec3& p) {
    return Vec3(2 * p.x - p.y + 1, 0.5 * p.y + p.z - 3, p.x + 4 * p.z);
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    // Parabolas only: a spline's chord-length knots do not survive an affine map, nor need they.
    Model model = randomCoonsModel(seed, kBend);
    for (Line& line : model.lines) {
      if (line.type != LineType::kCubicSpline) continue;
      line.points = {line.points[0], line.points[1], line.points.back()};
      line.type = LineType::kParabolic;
    }
    Model image = model;
    for (Vec3& point : image.points) point = transform(point);
    const ResolvedModel resolved(model);
    const ResolvedModel resolvedImage(image);
    const Vec2 unit(0.3, 0.8);
    const Vec3 expected = transform(coonsOf(resolved).evaluate(unit).position);
    EXPECT_LT(glm::length(coonsOf(resolvedImage).evaluate(unit).position - expected), 1e-12);
  }
}

TEST(ModelCoons, OfAParallelogramIsTheParallelogram) {
  ModelBuilder builder;
  const Vec3 a(1, 2, 3);
  const Vec3 u(2, 0, 1);
  const Vec3 v(0, 1, 1);
  builder.patch(PatchType::kCoons, {builder.polygon({a, a + u, a + u + v, a + v})});
  const ResolvedModel resolved(builder.model);
  const SurfacePoint point = coonsOf(resolved).evaluate({0.25, 0.5});
  EXPECT_LT(glm::length(point.position - (a + 0.25 * u + 0.5 * v)), 1e-14);
  EXPECT_LT(glm::length(point.alongXi - u), 1e-14);
  EXPECT_LT(glm::length(point.alongEta - v), 1e-14);
}

TEST(ModelPlanar, FrameIsOrthonormalAndProjectionInverts) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    double area = 0.0;
    const Model model = randomPolygonModel(seed, area);
    const ResolvedModel resolved(model);
    const PatchSurface surface(resolved, model.patches.front());
    const SurfacePoint point = surface.evaluate({0.3, -0.2});
    EXPECT_NEAR(glm::length(point.alongXi), 1.0, 1e-14);
    EXPECT_NEAR(glm::length(point.alongEta), 1.0, 1e-14);
    EXPECT_NEAR(glm::dot(point.alongXi, point.alongEta), 0.0, 1e-14);
    for (const Vec3& corner : model.points) {
      const Vec2 plane = surface.planar()->project(corner);
      EXPECT_LT(glm::length(surface.evaluate(plane).position - corner), 1e-13);
    }
  }
}

TEST(ModelPlanar, LoopPlaneHasTheLoopsAreaAndTurning) {
  const Model model = polygonModel({squareCorners({0, 0, 2}, 3.0)});
  const ResolvedModel resolved(model);
  const Loop& loop = model.patches.front().loops.front();
  EXPECT_LT(glm::length(loopPlane(resolved, loop).areaVector - Vec3(0, 0, 9)), 1e-14);
  Loop backward;
  for (auto line = loop.rbegin(); line != loop.rend(); ++line)
    backward.push_back({line->line, !line->reversed});
  EXPECT_LT(glm::length(loopPlane(resolved, backward).areaVector - Vec3(0, 0, -9)), 1e-14);
}

TEST(ModelResolved, DrawingALineBackwardChangesNoBit) {
  Model model = randomCoonsModel(5, kBend);
  Model turned = model;
  for (Line& line : turned.lines) std::ranges::reverse(line.points);
  for (OrientedLine& line : turned.patches.front().loops.front()) line.reversed = !line.reversed;
  const ResolvedModel first(model);
  const ResolvedModel second(turned);
  for (std::size_t i = 0; i < 4; ++i) {
    const OrientedLine& before = model.patches.front().loops.front()[i];
    const OrientedLine& after = turned.patches.front().loops.front()[i];
    for (double t = 0.0; t <= 1.0; t += 0.1)
      EXPECT_EQ(first.curve(before).position(t), second.curve(after).position(t));
    EXPECT_EQ(first.startPoint(before), second.startPoint(after));
    EXPECT_EQ(first.endPoint(before), second.endPoint(after));
  }
}

}  // namespace
}  // namespace tetrafront::testing
