/// Limits of size tensors, and of their growth along the edges of a background grid.

#include "field/grid_gradation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "field/grid_locator.h"
#include "field/tensor_limits.h"
#include "support/random.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

constexpr double kGrowth = 0.3;

SymmetricTensor randomTensor(Random& random, double maxStretching) {
  BackgroundNode node;
  node.size = random.between(0.1, 2.0);
  node.stretching = random.between(1.0, maxStretching);
  node.direction = random.inBox() + Vec3(0.01);
  SymmetricTensor tensor = sizeTensor(node);
  node.direction = random.inBox() + Vec3(0.01);
  tensor.accumulate(sizeTensor(node), random.unit());
  return tensor;
}

double quadraticForm(const SymmetricTensor& tensor, const Vec3& v) {
  return glm::dot(v, tensor * v);
}

std::array<double, 6> entriesOf(const SymmetricTensor& t) {
  return {t.xx, t.yy, t.zz, t.xy, t.xz, t.yz};
}

TEST(TensorLimitsTest, PrincipalAxesDiagonalize) {
  Random random(931);
  for (int i = 0; i < 500; ++i) {
    const SymmetricTensor tensor = randomTensor(random, i % 2 == 0 ? 3.0 : 1000.0);
    const PrincipalAxes principal = principalAxes(tensor);
    const double scale = largestPossible(tensor);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 residual = tensor * principal.axes[k] - principal.values[k] * principal.axes[k];
      EXPECT_LT(glm::length(residual), 1e-13 * scale);
      EXPECT_NEAR(glm::length(principal.axes[k]), 1.0, 1e-14);
      EXPECT_LE(principal.values[k], scale * (1.0 + 1e-14));
      EXPECT_NEAR(glm::dot(principal.axes[k], principal.axes[(k + 1) % 3]), 0.0, 1e-14);
    }
  }
}

TEST(TensorLimitsTest, CappingKeepsShorterAxes) {
  Random random(932);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor tensor = randomTensor(random, 20.0);
    const double cap = random.between(0.1, 10.0);
    const SymmetricTensor capped = cappedTo(tensor, cap);
    const PrincipalAxes before = principalAxes(tensor);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(quadraticForm(capped, before.axes[k]), std::min(before.values[k], cap), 1e-12);
    }
  }
  const SymmetricTensor small = randomTensor(random, 2.0);
  EXPECT_EQ(entriesOf(cappedTo(small, 100.0)), entriesOf(small));
}

TEST(TensorLimitsTest, LimitedTensorNowhereExceedsEither) {
  Random random(933);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor tensor = randomTensor(random, 30.0);
    const SymmetricTensor limit = randomTensor(random, 30.0);
    const SymmetricTensor limited = limitedBy(tensor, limit);
    for (int k = 0; k < 30; ++k) {
      const Vec3 v = random.inBox();
      const double form = quadraticForm(limited, v);
      EXPECT_GT(form, 0.0);
      EXPECT_LE(form, quadraticForm(tensor, v) * (1.0 + 1e-10) + 1e-12);
      EXPECT_LE(form, quadraticForm(limit, v) * (1.0 + 1e-10) + 1e-12);
    }
    EXPECT_EQ(entriesOf(limitedBy(tensor, tensor.scaledBy(1.01))), entriesOf(tensor));
    const SymmetricTensor half = limitedBy(tensor, tensor.scaledBy(0.5));
    EXPECT_NEAR(half.xy, 0.5 * tensor.xy, 1e-12 * largestPossible(tensor));
  }
}

// ---- along the edges of a grid -------------------------------------------------------------------

BackgroundGrid roughGrid(int n, std::uint64_t seed) {
  Random random(seed);
  BackgroundGrid grid = gridOf(cubeOfTetrahedra(n, 0.15, seed));
  for (BackgroundNode& node : grid.nodes) {
    node.size = random.integer(0, 9) == 0 ? 0.01 : random.between(0.05, 3.0);
  }
  return grid;
}

template <class Visit>
void forEachEdge(const BackgroundGrid& grid, Visit visit) {
  for (const auto& tet : grid.tetrahedra) {
    for (const std::uint32_t a : tet) {
      for (const std::uint32_t b : tet) {
        if (a == b) continue;
        visit(a, b, glm::length(grid.nodes[a].position - grid.nodes[b].position));
      }
    }
  }
}

TEST(GridGradationTest, LimitedSizesAreTheLargestThatComply) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    BackgroundGrid grid = roughGrid(5, seed);
    // The oracle lowers one size at a time until no edge violates the limit.
    BackgroundGrid expected = grid;
    for (bool moved = true; moved;) {
      moved = false;
      forEachEdge(expected, [&](std::uint32_t a, std::uint32_t b, double length) {
        const double limit = expected.nodes[b].size + kGrowth * length;
        if (!(expected.nodes[a].size > limit)) return;
        expected.nodes[a].size = limit;
        moved = true;
      });
    }
    Job([&](Work& work) { return limitSizes(work, grid, kGrowth); }).finish();
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      EXPECT_EQ(grid.nodes[i].size, expected.nodes[i].size) << "node " << i << ", seed " << seed;
    }
  }
}

TEST(GridGradationTest, KeepsGridsOfSmallGradation) {
  BackgroundGrid grid = gridOf(cubeOfTetrahedra(4, 0.1, 5));
  for (BackgroundNode& node : grid.nodes) node.size = 0.1 + 0.29 * node.position.x;
  const GridLocator limited(grid, kGrowth);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    EXPECT_EQ(limited.grid().nodes[i].size, grid.nodes[i].size);
  }
  EXPECT_EQ(GridLocator(roughGrid(3, 4), 0.0).grid().nodes[5].size, roughGrid(3, 4).nodes[5].size);
}

TEST(GridGradationTest, LimitsEveryAxisOfStretchedNodes) {
  BackgroundGrid grid = roughGrid(4, 6);
  Random random(7);
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = random.between(1.0, 20.0);
    node.direction = random.inBox() + Vec3(0.01);
  }
  std::vector<SymmetricTensor> before;
  for (const BackgroundNode& node : grid.nodes) before.push_back(sizeTensor(node));
  std::vector<SymmetricTensor> tensors = before;
  Job([&](Work& work) { return limitTensors(work, grid, kGrowth, tensors); }).finish();
  int complying = 0;
  int edges = 0;
  forEachEdge(grid, [&](std::uint32_t a, std::uint32_t b, double length) {
    const double own =
        std::max({principalAxes(tensors[a]).values[0], principalAxes(tensors[a]).values[1],
                  principalAxes(tensors[a]).values[2]});
    const double limit = largestPossible(tensors[b]) + kGrowth * length;
    ++edges;
    if (own <= limit * (1.0 + 1e-9)) ++complying;
    EXPECT_LE(own, 1.1 * limit);
  });
  EXPECT_GT(complying, 0.99 * edges);
  for (std::size_t i = 0; i < tensors.size(); ++i) {
    EXPECT_GT(tensors[i].determinant(), 0.0);
    EXPECT_LE(tensors[i].determinant(), before[i].determinant() * (1.0 + 1e-9));
  }
}

/// Thin elements along a layer stay thin beside each other; across it, sizes grow as without stretching.
TEST(GridGradationTest, SecondStretchingsGrowInRatio) {
  BackgroundGrid grid = gridOf(cubeOfTetrahedra(6));
  const auto isInLayer = [](const BackgroundNode& node) { return node.position.x < 0.01; };
  for (BackgroundNode& node : grid.nodes) {
    node.size = isInLayer(node) ? 0.01 : 1.0;
    node.stretching = isInLayer(node) ? 30.0 : 1.0;
    node.direction = Vec3(0.0, 1.0, 0.0);
    grid.secondStretchings.push_back({node.stretching, Vec3(0.0, 0.0, 1.0)});
  }
  const GridLocator locator(grid, kGrowth);
  const auto tensorNear = [&](double x) {
    return locator.tensorAt(locator.locate(Vec3(x, 0.5, 0.5), GridTetId(0U)));
  };
  const SymmetricTensor layer = tensorNear(0.0);
  EXPECT_NEAR(layer.xx, 0.01, 1e-9);
  EXPECT_NEAR(layer.yy, 0.3, 1e-9);
  EXPECT_NEAR(layer.zz, 0.3, 1e-9);
  const double growth = 1.0 + kGrowth / 6.0 / 0.01;
  const SymmetricTensor beside = tensorNear(1.0 / 6.0);
  EXPECT_NEAR(beside.xx, 0.01 * growth, 1e-9);
  EXPECT_NEAR(beside.yy, std::min(1.0, 0.3 * growth), 1e-9);
  // Along the layer, the thin size of the nodes beside may not grow faster than the long one.
  for (GridNodeId node(0U); node.index() < grid.nodes.size(); node = GridNodeId(node.value + 1)) {
    if (grid.nodes[node.index()].position.y < 0.99) continue;
    grid.nodes[node.index()].size = 1.0;
    grid.nodes[node.index()].stretching = 1.0;
    grid.secondStretchings[node.index()].stretching = 1.0;
  }
  const GridLocator ended(grid, kGrowth);
  const SymmetricTensor end = ended.tensorAt(ended.locate(Vec3(0.0, 1.0, 0.5), GridTetId(0U)));
  EXPECT_NEAR(end.xx, 0.01 * (1.0 + kGrowth / 6.0 / 0.3), 1e-9);
}

TEST(GridGradationTest, SizesOfStretchedGridsFollowTheirTensors) {
  BackgroundGrid grid = roughGrid(3, 8);
  for (BackgroundNode& node : grid.nodes) node.stretching = 4.0;
  const GridLocator locator(grid, kGrowth);
  for (const GridTetId tet : IdRange<GridTetId>(locator.grid().tetrahedra.size())) {
    GridLocator::Location location;
    location.tetrahedron = tet;
    location.weights = {1.0, 0.0, 0.0, 0.0};
    const std::array<double, 3> sizes = principalAxes(locator.tensorAt(location)).values;
    EXPECT_NEAR(locator.sizeAt(location), std::min({sizes[0], sizes[1], sizes[2]}), 1e-12);
  }
}

}  // namespace
}  // namespace tetrafront::testing
