/// @file Curvature of triangulated surfaces and lines, against that of the shapes that they approximate.

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/task.h"
#include "remesh/curvature.h"
#include "remesh/mean_curvature.h"
#include "remesh/piece_cells.h"
#include "remesh/reference_surface.h"
#include "support/hard_shapes.h"
#include "support/shapes.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

constexpr CurvatureRule kRule{.anglePerEdge = 0.35, .tolerance = 0.01};

struct PieceCurvature {
  Vec3 position;
  Curvature curvature;
};

/// Returns the mean curvature in cells of a width, at each piece of the surface.
std::vector<PieceCurvature> curvaturesOf(const SurfaceMesh& mesh, double width) {
  ReferenceSurface reference(mesh, {});
  Job<> preparing([&reference](Work& work) { return reference.prepare(work); });
  preparing.finish();
  const PieceCells cells(reference, width);
  Job<std::vector<Curvature>> measuring(
      [&](Work& work) { return findMeanCurvatures(work, reference, cells, kRule); });
  const std::vector<Curvature> found = measuring.finish();
  std::vector<PieceCurvature> result;
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.push_back({reference.pieces()[i].centroid, found[i]});
  }
  return result;
}

TEST(Curvature, OfASphereIsTheSameInAllDirections) {
  for (const double width : {0.01, 0.3}) {
    const std::vector<PieceCurvature> found = curvaturesOf(geodesicSphere(20), width);
    EXPECT_GE(found.size(), countTriangles(geodesicSphere(20)));
    for (const auto& [position, curvature] : found) {
      EXPECT_NEAR(curvature.largest, 1.0, 0.12) << width;
      EXPECT_NEAR(curvature.other, 1.0, 0.35) << width;
    }
  }
}

/// The inner side of this torus bends both ways alike, so that the sum of its curvatures is zero.
TEST(Curvature, OfATorusIsThatOfItsTube) {
  for (const double width : {0.01, 0.1}) {
    const std::vector<PieceCurvature> found = curvaturesOf(torus(2.0, 1.0, 160, 80), width);
    EXPECT_GE(found.size(), std::size_t{2 * 160 * 80});
    for (const auto& [position, curvature] : found) {
      const double fromAxis = std::sqrt(position.x * position.x + position.y * position.y);
      const double around = (fromAxis - 2.0) / fromAxis;
      EXPECT_NEAR(curvature.largest, 1.0, 0.15) << fromAxis;
      EXPECT_NEAR(curvature.other, around, 0.25) << fromAxis;
    }
  }
}

TEST(Curvature, OfACylinderHasNoneAlongItEvenOfNeedles) {
  for (const int strips : {40, 1000}) {
    std::size_t bent = 0;
    for (const auto& [position, curvature] : curvaturesOf(coarseBar(strips, 4.0), 0.02)) {
      if (curvature.largest == 0.0) continue;
      ++bent;
      EXPECT_NEAR(curvature.largest, 1.0, 0.05) << strips;
      EXPECT_NEAR(curvature.other, 0.0, 1e-6) << strips;
    }
    EXPECT_GE(bent, 2U * static_cast<std::size_t>(strips));
  }
}

/// Points on a circle of radius 1, in steps by turns of a small and a large angle.
FeatureLine unevenCircle(int count, double share) {
  std::vector<Vec3> points;
  std::vector<NodeId> nodes;
  for (int i = 0; i <= count; ++i) {
    const double step = i % 2 == 0 ? 0.0 : share;
    const double angle = 2.0 * std::numbers::pi * (i % count / 2 * 2 + 2.0 * step) / count;
    points.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    nodes.emplace_back(static_cast<std::size_t>(i % count));
  }
  return {nodes, points, true};
}

TEST(Curvature, OfALineIsTheMeanOverUnevenPoints) {
  const SurfaceMesh cube = gridCube(1);
  const ReferenceSurface reference(cube, {});
  const PieceCells cells(reference, 0.02);
  for (const double share : {0.5, 0.1, 1e-3}) {
    const FeatureLine line = unevenCircle(240, share);
    const LineTurns turns(line);
    const LineTurn all = turns.over(1, turns.end());
    EXPECT_NEAR(all.absolute, 2.0 * std::numbers::pi, 1e-3);
    EXPECT_NEAR(all.length, line.length(), 1e-9);
    EXPECT_NEAR(glm::length(all.angles), all.absolute, 1e-9);
    for (std::size_t i = 1; i < turns.end(); ++i) {
      EXPECT_NEAR(meanCurvatureAlong(line, turns, i, 1e9, cells, kRule), 1.0, 0.1) << share;
    }
  }
}

/// Triangles of an edge length that the rule allows deviate from a sphere by at most the tolerance.
TEST(Curvature, TrianglesOnASphereStayWithinTheTolerance) {
  const CurvatureRule rule{.anglePerEdge = 3.0, .tolerance = 1e-4};
  const double edge = rule.sizeFor({1.0, 1.0});
  const double toCorner = edge / std::sqrt(3.0);
  EXPECT_NEAR(1.0 - std::sqrt(1.0 - toCorner * toCorner), rule.tolerance, 1e-7);
  // On a cylinder, the middle of an edge across it is farthest away.
  const double across = rule.sizeFor({1.0, 0.0});
  EXPECT_NEAR(1.0 - std::sqrt(1.0 - across * across / 4.0), rule.tolerance, 1e-7);
}

}  // namespace
}  // namespace tetrafront::testing
