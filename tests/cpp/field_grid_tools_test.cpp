/// Background grids that cover a model or come from a mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "boundary/boundary.h"
#include "field/check_background_grid.h"
#include "field/size_field.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/tet_grids.h"
#include "tetrafront/covering_grid.h"
#include "tetrafront/grid_from_mesh.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"
#include "topology/mesh_access.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint32_t kBudget = 100'000;

MeshStatus finish(MeshRun& run) {
  while (run.advance(kBudget) == MeshStatus::kRunning) {
  }
  return run.status();
}

std::size_t tetrahedraOf(const VolumeMesh& mesh) { return mesh.tetrahedra.size() / 4; }

// ---- covering a box or a model -------------------------------------------------------------------

double volumeOf(const BackgroundGrid& grid) {
  double sum = 0.0;
  for (const auto& tet : grid.tetrahedra) {
    const Vec3 a = grid.nodes[tet[0]].position;
    const auto edge = [&](std::size_t i) { return grid.nodes[tet[i]].position - a; };
    sum += std::fabs(glm::dot(edge(1), glm::cross(edge(2), edge(3)))) / 6.0;
  }
  return sum;
}

TEST(CoveringGridTest, ContainsTheBoxWithAMargin) {
  Random random(941);
  for (const CoverShape shape : {CoverShape::kBox, CoverShape::kTetrahedron}) {
    for (int i = 0; i < 30; ++i) {
      const Vec3 low = random.inBox(10.0);
      const Vec3 extent = Vec3(1.0) + random.inBox();
      const BackgroundGrid grid = coveringGrid(low, low + extent, 0.25, shape);
      EXPECT_TRUE(checkBackgroundGrid(grid).empty());
      const GridLocator locator(grid);
      for (int k = 0; k < 50; ++k) {
        const Vec3 position = low + extent * (0.5 + random.inBox(0.52));
        const GridLocator::Location location = locator.locate(position, GridTetId(0U));
        EXPECT_TRUE(location.inside);
        EXPECT_NEAR(locator.sizeAt(location), 0.25, 1e-15);
      }
    }
  }
}

TEST(CoveringGridTest, FiveTetrahedraFillTheBoxOnce) {
  const BackgroundGrid grid = coveringGrid(Vec3(0.0), Vec3(3.0, 4.0, 0.0), 1.0, CoverShape::kBox);
  EXPECT_EQ(grid.tetrahedra.size(), 5U);
  EXPECT_EQ(grid.nodes.size(), 8U);
  const Vec3 extent = Vec3(3.0, 4.0, 0.0) + 2.0 * 5.0 / 20.0;  // the diagonal is 5
  EXPECT_NEAR(volumeOf(grid), extent.x * extent.y * extent.z, 1e-12);
  const BackgroundGrid one = coveringGrid(Vec3(0.0), Vec3(1.0), 1.0, CoverShape::kTetrahedron);
  EXPECT_EQ(one.tetrahedra.size(), 1U);
}

TEST(CoveringGridTest, CoversCurvedPatches) {
  // The spline points of the circles are no corners of the tube's box, and its side is curved.
  const Model tube = seamedTube(1.0, 2.0);
  for (const CoverShape shape : {CoverShape::kBox, CoverShape::kTetrahedron}) {
    const BackgroundGrid grid = coveringGrid(tube, 0.0, shape);
    const ModelPreview preview = previewModel(tube, grid);
    for (const Diagnostic& d : preview.diagnostics)
      EXPECT_NE(d.code, DiagnosticCode::kOutsideBackgroundGrid);
    // A twentieth of the diagonal of the box 2 x 2 x 2.
    EXPECT_NEAR(grid.nodes[0].size, std::sqrt(12.0) / 20.0, 2e-3);
  }
  EXPECT_TRUE(coveringGrid(Model{}, 0.0, CoverShape::kBox).tetrahedra.empty());
}

bool operator==(const BackgroundGrid& a, const BackgroundGrid& b) {
  const auto alike = [](const BackgroundNode& left, const BackgroundNode& right) {
    return left.position == right.position && left.size == right.size;
  };
  return std::ranges::equal(a.nodes, b.nodes, alike) && a.tetrahedra == b.tetrahedra &&
         a.coverageMargin == b.coverageMargin;
}

TEST(CoveringGridTest, SlicesOfOnePatchGiveTheSameGrid) {
  const Model tube = seamedTube(1.0, 2.0);
  CoveringGridBuilder coverer(tube, 0.0, CoverShape::kBox);
  const std::size_t slices = slicesOf(coverer, 1);
  // Each patch is visited twice, by its check and by its sampling.
  EXPECT_GE(slices, 2 * tube.patches.size());
  EXPECT_TRUE(coverer.result() == coveringGrid(tube, 0.0, CoverShape::kBox));
  CoveringGridBuilder nothing(Model{}, 0.0, CoverShape::kBox);
  slicesOf(nothing, 1);
  EXPECT_TRUE(nothing.result().tetrahedra.empty());
}

TEST(CoveringGridTest, MeshesLikeAUniformSize) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0));
  MeshOptions uniform;
  uniform.size = 0.2;
  MeshRun byOption(box, {}, uniform);
  MeshRun byGrid(box, coveringGrid(box, 0.2, CoverShape::kBox), {});
  ASSERT_EQ(finish(byOption), MeshStatus::kDone);
  ASSERT_EQ(finish(byGrid), MeshStatus::kDone);
  // Sizes between the grid's nodes are rounded, so a tie may be decided either way.
  const double expected = tetrahedraOf(byOption.volume());
  EXPECT_NEAR(tetrahedraOf(byGrid.volume()), expected, 0.03 * expected);
}

// ---- a mesh as background grid --------------------------------------------------------------------

VolumeMesh filled(const SurfaceMesh& surface, const MeshOptions& options) {
  MeshRun run(surface.points, surface.triangles, options);
  EXPECT_EQ(finish(run), MeshStatus::kDone);
  return run.volume();
}

TEST(GridFromMeshTest, UsesGivenSizesAndRemovesUnusedNodes) {
  VolumeMesh mesh = cubeOfTetrahedra(2);
  const std::size_t nodes = mesh.points.size() / 3;
  mesh.points.insert(mesh.points.begin(), {9.0, 9.0, 9.0});
  for (std::uint32_t& node : mesh.tetrahedra) ++node;
  std::vector<double> sizes;
  for (std::size_t i = 0; i <= nodes; ++i) sizes.push_back(0.1 + static_cast<double>(i));
  const BackgroundGrid grid = gridFromMesh(mesh, sizes);
  ASSERT_EQ(grid.nodes.size(), nodes);
  EXPECT_EQ(grid.tetrahedra.size(), 48U);
  for (std::size_t i = 0; i < nodes; ++i) {
    EXPECT_EQ(grid.nodes[i].size, sizes[i + 1]);
    EXPECT_EQ(grid.nodes[i].position.x, mesh.points[3 * i + 3]);
  }
  EXPECT_TRUE(checkBackgroundGrid(grid).empty());
}

TEST(GridFromMeshTest, SlicesGiveTheSameGrid) {
  const VolumeMesh mesh = cubeOfTetrahedra(3);
  const std::size_t elements = mesh.tetrahedra.size() / 4;
  const std::size_t nodes = mesh.points.size() / 3;
  for (const std::vector<double>& sizes : {std::vector<double>{}, std::vector(nodes, 0.5)}) {
    MeshGridBuilder gridder(mesh, sizes);
    EXPECT_EQ(slicesOf(gridder, 10), (2 * elements + nodes + 9) / 10);
    EXPECT_TRUE(gridder.result() == gridFromMesh(mesh, sizes));
  }
}

TEST(GridFromMeshTest, RemeshingTheSameModelGivesAboutTheSameCount) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0, 1.2, 0.8));
  const BackgroundGrid graded =
      boxGrid(Vec3(-0.1), Vec3(1.3), [](const Vec3& p) { return p.x < 0.5 ? 0.06 : 0.16; });
  MeshRun first(box, graded, {});
  ASSERT_EQ(finish(first), MeshStatus::kDone);
  MeshRun second(box, gridFromMesh(first.volume(), {}), {});
  ASSERT_EQ(finish(second), MeshStatus::kDone);
  const double ratio = static_cast<double>(tetrahedraOf(second.volume())) /
                       static_cast<double>(tetrahedraOf(first.volume()));
  EXPECT_GT(ratio, 0.85);
  EXPECT_LT(ratio, 1.15);
}

TEST(GridFromMeshTest, CoversCurvedPatchesThatItDoesNotReach) {
  const BackgroundGrid grid = gridFromMesh(filled(geodesicSphere(4), MeshOptions{}), {});
  FieldHint hint;
  const SizeField field = SizeField::fromGrid(GridLocator(grid));
  Random random(942);
  for (int i = 0; i < 500; ++i) {
    Vec3 position = random.inBox();
    if (glm::length(position) < 0.1) continue;
    position /= glm::length(position);
    EXPECT_TRUE(field.covers(position, hint));
    EXPECT_FALSE(field.covers(1.3 * position, hint));
  }
}

/// A query begins where one at a node of the same face has ended.
TEST(GridFromMeshTest, WalksAreShortOnALargeGridInTheOrderOfTheFront) {
  MeshOptions unoptimized;
  unoptimized.optimization = Optimization::kNone;
  const VolumeMesh mesh = filled(sphereOfAbout(5'000), unoptimized);
  ASSERT_GT(tetrahedraOf(mesh), 20'000U);
  const GridLocator locator(gridFromMesh(filled(sphereOfAbout(6'000), unoptimized), {}));
  std::vector<GridTetId> hints(countNodes(mesh), GridTetId(0U));
  std::uint64_t steps = 0;
  for (const TetId tet : IdRange<TetId>(tetrahedraOf(mesh))) {
    const auto [a, b, c, d] = cornersOf(mesh, tet);
    const NodeQuad nodes = nodesOf(mesh, tet);
    const GridLocator::Location found =
        locator.locate((a + b + c + d) / 4.0, hints[nodes[0].index()]);
    for (const NodeId node : nodes) hints[node.index()] = found.tetrahedron;
    steps += found.steps;
  }
  EXPECT_LT(static_cast<double>(steps), 5.0 * tetrahedraOf(mesh));
}
}  // namespace
}  // namespace tetrafront::testing
