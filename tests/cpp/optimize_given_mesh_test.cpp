/// Which given meshes an improvement refuses, and what it says about them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "support/given_meshes.h"
#include "support/hard_shapes.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/tet_grids.h"
#include "tetrafront/mesh_improvement.h"

namespace tetrafront::testing {
namespace {

/// Expects exactly one diagnostic, an error of this code that names these elements.
void expectRefused(const VolumeMesh& mesh, DiagnosticCode code,
                   const std::set<std::uint32_t>& elements) {
  const MeshImprovement made = improved(mesh);
  ASSERT_EQ(made.diagnostics.size(), 1U);
  const Diagnostic& found = made.diagnostics[0];
  EXPECT_EQ(found.code, code);
  EXPECT_EQ(found.severity, Severity::kError);
  EXPECT_TRUE(found.hasPosition);
  std::set<std::uint32_t> named;
  for (const Entity& entity : found.entities) {
    EXPECT_EQ(entity.kind, EntityKind::kTetrahedron);
    named.insert(entity.index);
  }
  EXPECT_EQ(named, elements);
  EXPECT_TRUE(made.tetrahedra.empty());
}

TEST(MeshImprovement, RefusesElementsWithoutVolume) {
  VolumeMesh mesh = cubeOfTetrahedra(2);
  mesh.tetrahedra[4 * 5 + 1] = mesh.tetrahedra[4 * 5];
  expectRefused(mesh, DiagnosticCode::kDegenerateTetrahedron, {5});
}

TEST(MeshImprovement, RefusesAFaceOfThreeElements) {
  VolumeMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0.1, 0.1, 2};
  mesh.tetrahedra = {0, 1, 2, 3, 0, 2, 1, 4, 0, 1, 2, 5};
  expectRefused(mesh, DiagnosticCode::kNonManifoldFace, {0, 1, 2});
}

TEST(MeshImprovement, RefusesElementsThatOverlap) {
  // On one side of a common face.
  VolumeMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.2, 0.2, 2};
  mesh.tetrahedra = {0, 1, 2, 3, 0, 1, 2, 4};
  expectRefused(mesh, DiagnosticCode::kOverlappingTetrahedra, {0, 1});
  // Through each other, without a common node.
  VolumeMesh apart;
  apart.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0.1, 0.1, 2, 0, 0, 0, 2, 0, 0, 0, 2};
  apart.tetrahedra = {0, 1, 2, 3, 4, 5, 6, 7};
  expectRefused(apart, DiagnosticCode::kOverlappingTetrahedra, {0, 1});
}

/// Adds another mesh, scaled around a point, with nodes of its own and region 1.
void appendScaled(VolumeMesh& mesh, const VolumeMesh& other, double factor, const Vec3& centre) {
  const auto nodes = static_cast<std::uint32_t>(mesh.points.size() / 3);
  for (std::size_t i = 0; i < other.points.size(); ++i) {
    const double middle = centre[static_cast<int>(i % 3)];
    mesh.points.push_back(middle + factor * (other.points[i] - middle));
  }
  for (const std::uint32_t node : other.tetrahedra) mesh.tetrahedra.push_back(nodes + node);
  mesh.regions.resize(mesh.tetrahedra.size() / 4, 1);
}

/// Expects that an element of the part of region `outer` and one of region `inner` are named as overlapping.
void expectNested(const VolumeMesh& mesh, std::uint32_t inner, std::uint32_t outer) {
  const MeshImprovement made = improved(mesh);
  ASSERT_EQ(made.diagnostics.size(), 1U);
  EXPECT_EQ(made.diagnostics[0].code, DiagnosticCode::kOverlappingTetrahedra);
  EXPECT_EQ(made.diagnostics[0].values, std::vector<double>{1.0});
  ASSERT_EQ(made.diagnostics[0].entities.size(), 2U);
  EXPECT_EQ(mesh.regions[made.diagnostics[0].entities[0].index], inner);
  EXPECT_EQ(mesh.regions[made.diagnostics[0].entities[1].index], outer);
  EXPECT_TRUE(made.tetrahedra.empty());
}

/// Returns the mesh with its elements in the opposite order.
VolumeMesh reversed(const VolumeMesh& mesh) {
  VolumeMesh result = mesh;
  std::ranges::reverse(result.regions);
  std::ranges::reverse(result.tetrahedra);
  return result;
}

TEST(MeshImprovement, RefusesAPartInsideAnother) {
  const VolumeMesh cube = cubeOfTetrahedra(3);
  VolumeMesh nested = cube;
  nested.regions.assign(cube.tetrahedra.size() / 4, 0);
  appendScaled(nested, cube, 0.2, Vec3(0.53, 0.41, 0.47));
  expectNested(nested, 1, 0);
  expectNested(reversed(nested), 1, 0);
  MeshImprover improver(nested.points, nested.tetrahedra, nested.regions, {}, {});
  slicesOf(improver, 1);
  const Diagnostic& found = improver.result().diagnostics.at(0);
  EXPECT_EQ(found.values, std::vector<double>{1.0});
  EXPECT_EQ(nested.regions[found.entities.at(1).index], 0U);
}

/// The elements of a cube of n^3 cells; those in the cells inside have nodes of their own and region 1.
VolumeMesh cubeInLayers(int n) {
  VolumeMesh mesh = cubeOfTetrahedra(n);
  const auto nodes = static_cast<std::uint32_t>(mesh.points.size() / 3);
  const std::vector<double> points = mesh.points;
  mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  const auto isInside = [](double at) { return at > 0.0 && at < 1.0; };
  mesh.regions.assign(mesh.tetrahedra.size() / 4, 0);
  for (std::size_t t = 0; t < mesh.regions.size(); ++t) {
    std::uint32_t* const corners = &mesh.tetrahedra[4 * t];
    if (!std::all_of(corners, corners + 4, [&](std::uint32_t node) {
          return std::ranges::all_of(positionOf(points, node), isInside);
        })) {
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k) corners[k] += nodes;
    mesh.regions[t] = 1;
  }
  return mesh;
}

TEST(MeshImprovement, AcceptsAPartThatFillsTheCavityOfAnother) {
  const VolumeMesh mesh = cubeInLayers(4);
  ASSERT_EQ(std::ranges::count(mesh.regions, 1U) * 8, std::ssize(mesh.regions));
  for (const VolumeMesh& given : {mesh, reversed(mesh)}) {
    const MeshImprovement made = improved(given);
    EXPECT_TRUE(made.diagnostics.empty());
    EXPECT_FALSE(made.tetrahedra.empty());
  }
}

/// The nodes of the inner part are where interior nodes of the outer part are.
TEST(MeshImprovement, RefusesElementsThatAreGivenAgainWithNodesOfTheirOwn) {
  const VolumeMesh layers = cubeInLayers(4);
  VolumeMesh mesh = cubeOfTetrahedra(4);
  mesh.points = layers.points;
  mesh.regions.assign(mesh.tetrahedra.size() / 4, 0);
  for (std::size_t t = 0; t < layers.regions.size(); ++t) {
    if (layers.regions[t] == 0) continue;
    const auto first = layers.tetrahedra.begin() + 4 * static_cast<std::ptrdiff_t>(t);
    mesh.tetrahedra.insert(mesh.tetrahedra.end(), first, first + 4);
    mesh.regions.push_back(1);
  }
  expectNested(mesh, 1, 0);
  expectNested(reversed(mesh), 1, 0);
}

/// The cavity of a hollow ball contains a smaller ball; a third one is far away.
TEST(MeshImprovement, AcceptsAPartInTheCavityOfAnother) {
  SurfaceMesh shell = nestedSpheres(2, 4);
  VolumeMesh mesh = poorMesh(shell);
  mesh.regions.assign(mesh.tetrahedra.size() / 4, 0);
  const VolumeMesh ball = poorMesh(geodesicSphere(3));
  appendScaled(mesh, ball, 0.2, Vec3(0.0));
  EXPECT_TRUE(improved(mesh).diagnostics.empty());
  // In the wall.
  appendScaled(mesh, ball, 0.01, Vec3(0.0, 0.0, 0.8));
  const MeshImprovement made = improved(mesh);
  ASSERT_EQ(made.diagnostics.size(), 1U);
  EXPECT_EQ(made.diagnostics[0].code, DiagnosticCode::kOverlappingTetrahedra);
}

TEST(MeshImprovement, RefusesAHangingNode) {
  // The second block has a node in the middle of a face of the first.
  VolumeMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0.25, 0.25, 0};
  mesh.tetrahedra = {0, 1, 2, 3, 0, 5, 1, 4, 1, 5, 2, 4, 2, 5, 0, 4};
  const MeshImprovement made = improved(mesh);
  ASSERT_EQ(made.diagnostics.size(), 1U);
  EXPECT_EQ(made.diagnostics[0].code, DiagnosticCode::kOverlappingTetrahedra);
}

TEST(MeshImprovement, AcceptsPartsThatTouchWithNodesOfTheirOwn) {
  VolumeMesh mesh = poorMesh(gridCube(3));
  const auto nodes = static_cast<std::uint32_t>(mesh.points.size() / 3);
  const VolumeMesh other = mesh;
  for (std::size_t i = 0; i < other.points.size(); i += 3) {
    // A mirror image beside it, so that the triangles of both match.
    mesh.points.insert(mesh.points.end(),
                       {-other.points[i], other.points[i + 1], other.points[i + 2]});
  }
  for (const std::uint32_t node : other.tetrahedra) mesh.tetrahedra.push_back(nodes + node);
  mesh.regions.assign(mesh.tetrahedra.size() / 4, 0);
  const MeshImprovement made = improved(mesh);
  EXPECT_TRUE(made.diagnostics.empty());
  EXPECT_TRUE(made.isImproved);
  EXPECT_EQ(made.orientedTetrahedra, other.tetrahedra.size() / 4);
}

TEST(MeshImprovement, RefusesInvalidArrays) {
  VolumeMesh mesh = cubeOfTetrahedra(1);
  mesh.tetrahedra[3] = 1000;
  EXPECT_FALSE(improved(mesh).isReadable);
  EXPECT_FALSE(improved(VolumeMesh{}).isReadable);
  EXPECT_FALSE(improved(cubeOfTetrahedra(1), {0, 1, 1000}).isReadable);
}

}  // namespace
}  // namespace tetrafront::testing
