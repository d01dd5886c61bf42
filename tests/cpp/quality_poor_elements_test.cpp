/// @file Reasons of poor elements, on elements whose reason is known.

#include "quality/poor_elements.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "quality/quality_analysis.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

PoorElements poorOf(const VolumeMesh& mesh, const SurfaceMesh& surface) {
  const SizeField field = SizeField::uniform(1.0);
  QualityAnalysis analysis(mesh, surface, field);
  while (!analysis.advance(1000)) {
  }
  return analysis.statistics().poor;
}

VolumeMesh oneElement(const SurfaceMesh& surface) {
  VolumeMesh mesh;
  mesh.points = surface.points;
  mesh.tetrahedra = {0, 1, 2, 3};
  mesh.regions = {0};
  return mesh;
}

SurfaceMesh elementOfWedge(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return tetrahedronSurface({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.5, 1.0, 0.0),
                             Vec3(0.5, std::cos(angle), std::sin(angle))});
}

TEST(PoorElements, InAWedgeHaveItsEdgeAndAngle) {
  const SurfaceMesh wedge = elementOfWedge(4.0);
  const PoorElements poor = poorOf(oneElement(wedge), wedge);
  EXPECT_EQ(poor.count, 1U);
  EXPECT_EQ(poor.inWedges, 1U);
  EXPECT_EQ(poor.reason, PoorReason::kWedge);
  EXPECT_NEAR(poor.value, 4.0, 1e-9);
  EXPECT_NEAR(poor.worst.smallestDihedral, 4.0, 1e-9);
  EXPECT_EQ(glm::length(poor.edgeTo - poor.edgeFrom), 1.0);
}

TEST(PoorElements, AreNoneAtAnAngleOfTwelveDegrees) {
  const SurfaceMesh wedge = elementOfWedge(12.0);
  EXPECT_EQ(poorOf(oneElement(wedge), wedge).count, 0U);
}

/// Without a boundary, nothing forces the angle.
TEST(PoorElements, InTheInteriorHaveNoReason) {
  const PoorElements poor = poorOf(oneElement(elementOfWedge(4.0)), SurfaceMesh{});
  EXPECT_EQ(poor.count, 1U);
  EXPECT_EQ(poor.reason, PoorReason::kOther);
}

/// Two edges of the boundary cross at a distance of 0.02.
TEST(PoorElements, BetweenCloseFacesHaveTheThickness) {
  VolumeMesh mesh;
  mesh.points = {-1.0, 0.0, 0.0, 1.0, 0.0,  0.0, 0.0, -1.0, 0.02, 0.0,  1.0, 0.02,
                 0.0,  2.0, 0.0, 0.0, -2.0, 0.0, 2.0, 0.0,  0.02, -2.0, 0.0, 0.02};
  mesh.tetrahedra = {0, 1, 3, 2};
  mesh.regions = {0};
  SurfaceMesh surface;
  surface.points = mesh.points;
  surface.triangles = {0, 4, 1, 0, 1, 5, 2, 6, 3, 2, 3, 7};
  const PoorElements poor = poorOf(mesh, surface);
  EXPECT_EQ(poor.inThinPlaces, 1U);
  EXPECT_EQ(poor.reason, PoorReason::kThickness);
  EXPECT_NEAR(poor.value, 0.02, 1e-12);
  EXPECT_GT(poor.goodSize, 0.02);
  EXPECT_LT(poor.goodSize, 0.2);
  EXPECT_GT(poor.goodTetrahedra, 10.0);
}

/// A needle of 1 : 100 beside elements of a large angle.
TEST(PoorElements, AtANeedleHaveItsAngle) {
  const SurfaceMesh needle = tetrahedronSurface(
      {Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.5, 0.01, 0.0), Vec3(0.5, 0.5, 1.0)});
  const PoorElements poor = poorOf(oneElement(needle), needle);
  ASSERT_EQ(poor.count, 1U);
  EXPECT_NE(poor.reason, PoorReason::kOther);
  EXPECT_LT(poor.value, 30.0);
}

}  // namespace
}  // namespace tetrafront::testing
