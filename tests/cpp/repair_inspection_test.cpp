#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/shapes.h"
#include "tetrafront/surface_tools.h"

namespace tetrafront::testing {
namespace {

SurfaceInspection inspect(const SurfaceMesh& mesh, std::uint32_t budget = 1U << 20U,
                          const InspectionOptions& options = {}) {
  SurfaceInspector inspector(mesh.points, mesh.triangles, options);
  double reached = 0.0;
  while (!inspector.advance(budget)) {
    EXPECT_GE(inspector.fraction(), reached);
    reached = inspector.fraction();
  }
  EXPECT_EQ(inspector.fraction(), 1.0);
  return inspector.result();
}

void removeTriangle(SurfaceMesh& mesh, std::size_t triangle) {
  const auto first = mesh.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(triangle);
  mesh.triangles.erase(first, first + 3);
}

TEST(SurfaceInspection, MeasuresAUnitCube) {
  const SurfaceInspection found = inspect(gridCube(2));
  EXPECT_TRUE(found.isFillable && found.isClosed && found.isManifold && found.isEmbedded);
  EXPECT_EQ(found.triangles, 48U);
  // Euler: V - E + F = 2, and 3F = 2E.
  EXPECT_EQ(found.edges, 72U);
  EXPECT_EQ(found.nodes, 26U);
  EXPECT_NEAR(found.area, 6.0, 1e-14);
  EXPECT_NEAR(found.volume, 1.0, 1e-14);
  EXPECT_EQ(found.low, Vec3(0.0));
  EXPECT_EQ(found.high, Vec3(1.0));
  EXPECT_EQ(found.shortestEdge, 0.5);
  EXPECT_NEAR(found.longestEdge, std::sqrt(0.5), 1e-15);
  // 48 half diagonals of the 24 squares, each shared by none: 24 of them among 72 edges.
  EXPECT_NEAR(found.meanEdge, (48 * 0.5 + 24 * std::sqrt(0.5)) / 72, 1e-14);
  ASSERT_EQ(found.shells.size(), 1U);
  EXPECT_NEAR(found.shells[0].area, 6.0, 1e-14);
  EXPECT_EQ(found.regions, 1U);
  EXPECT_EQ(found.flippedTriangles, 0U);
  ASSERT_EQ(found.worst.size(), 10U);
  EXPECT_NEAR(found.worst[0].smallestAngle, 45.0, 1e-10);
  EXPECT_NEAR(found.worst[0].area, 0.125, 1e-15);
  EXPECT_TRUE(found.diagnostics.empty());
}

TEST(SurfaceInspection, DistinguishesRegionsAndCavities) {
  const SurfaceInspection found = inspect(nestedSpheres(3, 2));
  EXPECT_EQ(found.regions, 2U);
  ASSERT_EQ(found.shells.size(), 3U);
  EXPECT_FALSE(found.shells[0].isCavity);
  EXPECT_TRUE(found.shells[1].isCavity);
  EXPECT_FALSE(found.shells[2].isCavity);
  EXPECT_EQ(found.shells[0].region, found.shells[1].region);
  EXPECT_NE(found.shells[0].region, found.shells[2].region);
  EXPECT_NEAR(found.volume,
              found.shells[0].volume - found.shells[1].volume + found.shells[2].volume, 1e-12);
}

TEST(SurfaceInspection, AcceptsInterfacesInEitherOrientation) {
  SurfaceMesh spheres = nestedSpheres(3, 2);
  const std::size_t last = spheres.triangles.size() - 3;
  std::swap(spheres.triangles[last], spheres.triangles[last + 1]);
  EXPECT_FALSE(inspect(spheres).isFillable);
  SurfaceInspector asRegions(spheres.points, spheres.triangles,
                             {.innerShells = InnerShells::kRegions});
  while (!asRegions.advance(1000)) {
  }
  EXPECT_TRUE(asRegions.result().isFillable);
  // Three regions; each of the two interfaces belongs to two shells, and none bounds a cavity.
  EXPECT_EQ(asRegions.result().regions, 3U);
  EXPECT_EQ(asRegions.result().shells.size(), 5U);
  for (const ShellInfo& shell : asRegions.result().shells) EXPECT_FALSE(shell.isCavity);
}

TEST(SurfaceInspection, CountsOpenEdges) {
  SurfaceMesh mesh = gridCube(2);
  removeTriangle(mesh, 5);
  const SurfaceInspection found = inspect(mesh);
  EXPECT_FALSE(found.isClosed);
  EXPECT_FALSE(found.isFillable);
  EXPECT_TRUE(found.isManifold && found.isEmbedded);
  EXPECT_EQ(found.openEdges, 3U);
  EXPECT_EQ(found.volume, 0.0);
  EXPECT_TRUE(found.shells.empty());
}

TEST(SurfaceInspection, CountsOpenEdgesAsItsDiagnosticsDo) {
  // A duplicate triangle next to a missing one: with the duplicate, the open edge would have two triangles.
  SurfaceMesh mesh = gridCube(2);
  const std::array<std::uint32_t, 3> again{mesh.triangles[3], mesh.triangles[5], mesh.triangles[4]};
  mesh.triangles.insert(mesh.triangles.end(), again.begin(), again.end());
  removeTriangle(mesh, 0);
  const SurfaceInspection found = inspect(mesh);
  const auto open = std::find_if(
      found.diagnostics.begin(), found.diagnostics.end(),
      [](const Diagnostic& diagnostic) { return diagnostic.code == DiagnosticCode::kOpenEdge; });
  ASSERT_NE(open, found.diagnostics.end());
  EXPECT_EQ(found.openEdges, 3U);
  EXPECT_EQ(open->values.back(), 3.0);
  EXPECT_FALSE(found.isClosed || found.isEmbedded);
  EXPECT_TRUE(found.isManifold);
  EXPECT_EQ(found.nonManifoldEdges + found.nonManifoldNodes, 0U);
}

TEST(SurfaceInspection, CountsNonManifoldEdgesAndNodes) {
  const SurfaceInspection edge = inspect(cubesSharingEdge());
  EXPECT_TRUE(edge.isFillable && edge.isClosed);
  EXPECT_FALSE(edge.isManifold);
  EXPECT_EQ(edge.nonManifoldEdges, 1U);
  EXPECT_NEAR(edge.volume, 2.0, 1e-14);
  const SurfaceInspection node = inspect(cubesSharingNode());
  EXPECT_TRUE(node.isFillable && node.isClosed);
  EXPECT_FALSE(node.isManifold);
  EXPECT_EQ(node.nonManifoldEdges, 0U);
  EXPECT_EQ(node.nonManifoldNodes, 1U);
}

TEST(SurfaceInspection, FindsSelfIntersections) {
  SurfaceMesh mesh = gridCube(1);
  SurfaceMesh other = gridCube(1);
  translate(other, Vec3(0.5, 0.25, 0.125));
  append(mesh, other);
  const SurfaceInspection found = inspect(mesh);
  EXPECT_FALSE(found.isEmbedded);
  EXPECT_TRUE(found.isClosed && found.isManifold);
  EXPECT_NEAR(found.area, 12.0, 1e-13);
}

TEST(SurfaceInspection, CountsFlippedTriangles) {
  SurfaceMesh mesh = geodesicSphere(3);
  std::swap(mesh.triangles[7], mesh.triangles[8]);
  EXPECT_EQ(inspect(mesh).flippedTriangles, 1U);
  EXPECT_FALSE(inspect(mesh).isFillable) << "only an explicit repair may flip single triangles";
  turnInsideOut(mesh);
  EXPECT_EQ(inspect(mesh).flippedTriangles, triangleCount(mesh) - 1);
  std::swap(mesh.triangles[7], mesh.triangles[8]);
  EXPECT_EQ(inspect(mesh).flippedTriangles, triangleCount(mesh));
  EXPECT_TRUE(inspect(mesh).isFillable) << "flipped as a whole";
}

TEST(SurfaceInspection, ReportsInvalidNumbersAndMeasuresNothing) {
  SurfaceMesh mesh = gridCube(1);
  mesh.triangles[4] = 1000;
  const SurfaceInspection found = inspect(mesh);
  EXPECT_FALSE(found.isFillable || found.isClosed || found.isManifold || found.isEmbedded);
  ASSERT_EQ(found.diagnostics.size(), 1U);
  EXPECT_EQ(found.diagnostics[0].code, DiagnosticCode::kIndexOutOfRange);
  EXPECT_FALSE(inspect(SurfaceMesh{}).isFillable);
  mesh = gridCube(1);
  mesh.points[3] = std::nan("");
  EXPECT_EQ(inspect(mesh).triangles, 0U);
}

TEST(SurfaceInspection, NamesIncompleteNodesAndTrianglesByTheirIndex) {
  SurfaceMesh mesh = gridCube(1);
  const auto nodes = static_cast<std::uint32_t>(mesh.points.size() / 3);
  const std::uint32_t triangles = triangleCount(mesh);
  mesh.points.insert(mesh.points.end(), {1.0, 2.0});
  mesh.triangles.push_back(0);
  const SurfaceInspection found = inspect(mesh);
  ASSERT_EQ(found.diagnostics.size(), 2U);
  const std::array expected{Entity{EntityKind::kSurfaceNode, nodes},
                            Entity{EntityKind::kTriangle, triangles}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Diagnostic& cut = found.diagnostics[i];
    EXPECT_EQ(cut.code, DiagnosticCode::kIndexOutOfRange);
    EXPECT_EQ(cut.entities.at(0).kind, expected[i].kind);
    EXPECT_EQ(cut.entities.at(0).index, expected[i].index);
    EXPECT_EQ(cut.values.at(0), static_cast<double>(expected[i].index));
  }
}

/// Returns pairs of needles, triangles 2i and 2i + 1, that intersect each other and are far from other pairs.
SurfaceMesh crossingNeedles(std::uint32_t pairs) {
  SurfaceMesh mesh;
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const double x = 10.0 * i;
    for (const Vec3& p :
         {Vec3(x, -1.0, 0.0), Vec3(x, 1.0, -1e-3), Vec3(x, 1.0, 1e-3), Vec3(x - 1.0, 0.0, 0.0),
          Vec3(x + 1.0, -1e-3, 0.0), Vec3(x + 1.0, 1e-3, 0.0)}) {
      mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.points.size() / 3));
      mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
    }
  }
  return mesh;
}

TEST(SurfaceInspection, ListsAtMostTheGivenNumberOfDiagnosticsAndCountsAll) {
  constexpr std::uint32_t kPairs = 3000;
  const SurfaceMesh mesh = crossingNeedles(kPairs);
  for (const std::uint32_t limit : {1U, 1000U, kPairs, 2 * kPairs}) {
    const SurfaceInspection found = inspect(mesh, 256, {.maxDiagnostics = limit});
    std::uint32_t pairs = 0;
    std::uint32_t edges = 0;
    for (const Diagnostic& d : found.diagnostics) {
      if (d.code == DiagnosticCode::kOpenEdge) {
        ++edges;
        EXPECT_EQ(d.values, std::vector<double>{6.0 * kPairs});
      }
      if (d.code != DiagnosticCode::kSelfIntersection) continue;
      EXPECT_EQ(d.entities.at(0).index, 2 * pairs);
      EXPECT_EQ(d.entities.at(1).index, 2 * pairs + 1);
      EXPECT_NEAR(d.position.x, 10.0 * pairs, 0.01);
      EXPECT_EQ(d.values, std::vector<double>{kPairs});
      ++pairs;
    }
    EXPECT_EQ(pairs, std::min(limit, kPairs));
    EXPECT_EQ(edges, std::min(limit, 6 * kPairs));
  }
}

TEST(SurfaceInspection, DoesNotDependOnTheSlices) {
  SurfaceMesh mesh = cubeWithSphericalCavity(4, 3);
  shuffle(mesh, 5);
  const SurfaceInspection whole = inspect(mesh);
  const SurfaceInspection sliced = inspect(mesh, 7);
  EXPECT_EQ(whole.area, sliced.area);
  EXPECT_EQ(whole.volume, sliced.volume);
  EXPECT_EQ(whole.worst[0].triangle, sliced.worst[0].triangle);
}

TEST(SurfaceInspection, EndsWithABudgetOfZero) {
  const SurfaceMesh mesh = gridCube(1);
  SurfaceInspector inspector(mesh.points, mesh.triangles);
  int calls = 0;
  while (!inspector.advance(0) && calls < 10000) ++calls;
  EXPECT_LT(calls, 10000);
  EXPECT_TRUE(inspector.result().isFillable);
}

TEST(SurfaceInspection, ListsTheWorstTriangleFirst) {
  SurfaceMesh mesh = gridCube(3);
  const auto moved = std::find(mesh.points.begin(), mesh.points.end(), 1.0 / 3.0);
  ASSERT_NE(moved, mesh.points.end());
  *moved = 1e-3;
  const SurfaceInspection found = inspect(mesh);
  ASSERT_EQ(found.worst.size(), 10U);
  EXPECT_LT(found.worst[0].smallestAngle, 1.0);
  EXPECT_TRUE(
      std::is_sorted(found.worst.begin(), found.worst.end(),
                     [](const auto& a, const auto& b) { return a.radiusRatio < b.radiusRatio; }));
}

}  // namespace
}  // namespace tetrafront::testing
