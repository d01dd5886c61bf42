// Patches as surfaces over their plane, Löhner & Parikh 1988, appendix.

#include "model/patch_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/models.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

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

TEST(ModelStretchedPlane, OfATriangleKeepsItsThreeLengths) {
  Random random(12);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 d(random.between(-1, 2), random.between(0.9, 3));
    const double sideAB = random.between(0.5, 1.5);
    const Vec2 b(sideAB, 0);
    const StretchedPlane plane =
        StretchedPlane::ofTriangle(sideAB, glm::length(d), glm::length(d - b));
    EXPECT_LT(glm::length(plane.toPlane({1, 0}) - b), 1e-13);
    EXPECT_LT(glm::length(plane.toPlane({0, 1}) - d), 1e-13);
    // Affine: the centre of the lines' midpoints is the centre of the corners.
    EXPECT_LT(glm::length(plane.toPlane({1 / 3.0, 1 / 3.0}) - (b + d) / 3.0), 1e-13);
    const Vec2 unit(random.unit(), random.unit());
    EXPECT_LT(glm::length(plane.toUnit(plane.toPlane(unit)) - unit), 1e-13);
  }
}

TEST(ModelStretchedPlane, ATriangleThatViolatesTheInequalityStillHasAPlane) {
  // Lines that bulge so much that the third is longer than the other two together, or so short that
  // the first two coincide.
  for (const double sideBD : {2.5, 1e-3}) {
    const StretchedPlane plane = StretchedPlane::ofTriangle(1.0, 1.0, sideBD);
    EXPECT_GE(plane.toPlane({0, 1}).y, 0.342);  // sin 20 degrees
    EXPECT_NEAR(glm::length(plane.toPlane({0, 1})), 1.0, 1e-14);
  }
}

TEST(ModelMapped, TangentsAreTheLimitOfDifferences) {
  constexpr double kStep = 1e-6;
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Model model = randomCurvedModel(type, seed, kTypicalBend);
      const ResolvedModel resolved(model);
      const PatchSurface surface(resolved, model.patches.front());
      const Vec2 at = surface.mapped()->stretchedPlane().toPlane({0.37, 0.41});
      const SurfacePoint here = surface.evaluate(at);
      const auto difference = [&](const Vec2& step) {
        return (surface.evaluate(at + step).position - surface.evaluate(at - step).position) /
               (2 * kStep);
      };
      EXPECT_LT(glm::length(here.alongXi - difference({kStep, 0})), 1e-7);
      EXPECT_LT(glm::length(here.alongEta - difference({0, kStep})), 1e-7);
    }
  }
}

TEST(ModelMapped, LinesLieOnTheBorderOfThePlane) {
  for (const PatchType type : kCurvedTypes) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Model model = randomCurvedModel(type, seed, kTypicalBend);
      const ResolvedModel resolved(model);
      const PatchSurface surface(resolved, model.patches.front());
      const Loop& loop = model.patches.front().loops.front();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        EXPECT_TRUE(surface.straightInPlane(0, i));
        for (const double t : {0.0, 0.3, 1.0}) {
          const Vec3 position = resolved.curve(loop[i]).position(t);
          const Vec2 plane = surface.boundaryToPlane(i, t, position);
          EXPECT_LT(glm::length(surface.evaluate(plane).position - position), 1e-12);
          EXPECT_LT(glm::length(surface.clamped(plane) - plane), 1e-14);
        }
      }
    }
  }
}

TEST(ModelMapped, PositionsOutsideAreClampedToTheDomain) {
  for (const PatchType type : kCurvedTypes) {
    const Model model = randomCurvedModel(type, 3, kTypicalBend);
    const ResolvedModel resolved(model);
    const PatchSurface surface(resolved, model.patches.front());
    const StretchedPlane& plane = surface.mapped()->stretchedPlane();
    const double most = unitShapeOf(type) == UnitShape::kTriangle ? 1.0 : 2.0;
    Random random(13);
    for (int i = 0; i < 200; ++i) {
      const Vec2 unit =
          plane.toUnit(surface.clamped(Vec2(random.between(-30, 30), random.between(-30, 30))));
      EXPECT_GE(unit.x, -1e-13);
      EXPECT_GE(unit.y, -1e-13);
      EXPECT_LE(std::max(unit.x, unit.y), 1.0 + 1e-13);
      EXPECT_LE(unit.x + unit.y, most + 1e-13);
      const Vec2 inside(0.4 * random.unit(), 0.5 * random.unit());
      EXPECT_EQ(surface.clamped(plane.toPlane(inside)), plane.toPlane(inside));
    }
  }
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

TEST(ModelPlanar, LoopPlaneHasTheLoopsAreaAndOrientation) {
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
  Model model = randomCoonsModel(5, kTypicalBend);
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

TEST(ModelResolved, DrawingAClosedLineBackwardChangesNoBit) {
  const Model tube = seamedTube(1.3, 2.0);
  Model turned = tube;
  std::ranges::reverse(turned.lines.front().points);
  const ResolvedModel first(tube);
  const ResolvedModel second(turned);
  EXPECT_NE(first.isFlipped(LineId(0U)), second.isFlipped(LineId(0U)));
  for (double t = 0.0; t <= 1.0; t += 0.01) {
    const Vec3 position = first.curve(OrientedLine{0, false}).position(t);
    EXPECT_EQ(position, second.curve(OrientedLine{0, true}).position(t));
  }
}

}  // namespace
}  // namespace tetrafront::testing
