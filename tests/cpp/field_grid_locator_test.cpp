#include "field/grid_locator.h"
#include "field/grid_locator_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "field/check_background_grid.h"
#include "field/size_field.h"
#include "support/random.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

double linearSize(const Vec3& p) { return 2.0 + 0.3 * p.x - 0.5 * p.y + 0.7 * p.z; }

BackgroundGrid cubeGrid(int n) {
  BackgroundGrid grid = gridOf(cubeOfTetrahedra(n, 0.15, 7));
  for (BackgroundNode& node : grid.nodes) node.size = linearSize(node.position);
  // Orientation must not matter.
  for (std::size_t t = 0; t < grid.tetrahedra.size(); t += 3) {
    std::swap(grid.tetrahedra[t][0], grid.tetrahedra[t][3]);
  }
  return grid;
}

Vec3 positionOf(const GridLocator& locator, const GridLocator::Location& location) {
  Vec3 position(0.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t node = locator.grid().tetrahedra[location.tetrahedron.index()][i];
    position += location.weights[i] * locator.grid().nodes[node].position;
  }
  return position;
}

void expectPosition(const Vec3& found, const Vec3& expected, double tolerance) {
  EXPECT_LT(glm::length(found - expected), tolerance)
      << "(" << found.x << " " << found.y << " " << found.z << ") instead of (" << expected.x << " "
      << expected.y << " " << expected.z << ")";
}

TEST(GridLocatorTest, FindsPositionsInsideFromAnyStart) {
  const GridLocator locator(cubeGrid(7));
  Random random(401);
  const auto count = static_cast<int>(locator.grid().tetrahedra.size());
  for (int i = 0; i < 3000; ++i) {
    const Vec3 position = Vec3(0.5) + random.inBox(0.5);
    const GridTetId start(static_cast<std::uint32_t>(random.integer(0, count - 1)));
    const GridLocator::Location location = locator.locate(position, start);
    ASSERT_TRUE(location.inside);
    expectPosition(positionOf(locator, location), position, 1e-12);
    EXPECT_NEAR(locator.sizeAt(location), linearSize(position), 1e-12);
    for (const double weight : location.weights) EXPECT_GE(weight, 0.0);
  }
}

/// On faces, edges and nodes, several tetrahedra contain a position; the last bits of a size depend on which one is taken.
TEST(GridLocatorTest, OnASharedFaceTheLowestTetrahedronDecides) {
  const BackgroundGrid grid = cubeGrid(4);
  const GridLocator locator(grid);
  const auto count = static_cast<int>(grid.tetrahedra.size());
  Random random(402);
  std::size_t shared = 0;
  for (int i = 0; i < 600; ++i) {
    const auto& nodes = grid.tetrahedra[static_cast<std::size_t>(random.integer(0, count - 1))];
    // A position on a face, an edge or at a node.
    Vec3 position(0.0);
    const int corners = 1 + i % 3;
    for (int k = 0; k < corners; ++k)
      position +=
          grid.nodes[nodes[static_cast<std::size_t>(k)]].position / static_cast<double>(corners);
    const GridLocator::Location first = locator.locate(position, GridTetId(0U));
    ASSERT_TRUE(first.inside);
    for (int start = 0; start < 10; ++start) {
      const GridTetId from(static_cast<std::uint32_t>(random.integer(0, count - 1)));
      const GridLocator::Location again = locator.locate(position, from);
      EXPECT_EQ(again.tetrahedron, first.tetrahedron);
      EXPECT_EQ(again.weights, first.weights);
    }
    shared += std::ranges::count(first.weights, 0.0) > 0 ? 1 : 0;
  }
  EXPECT_GT(shared, 100U);
}

TEST(GridLocatorTest, NodesAndBorderCountAsInside) {
  const GridLocator locator(cubeGrid(5));
  for (const BackgroundNode& node : locator.grid().nodes) {
    const GridLocator::Location location = locator.locate(node.position, GridTetId(3U));
    ASSERT_TRUE(location.inside);
    EXPECT_NEAR(locator.sizeAt(location), node.size, 1e-12);
  }
  // Files store rounded decimals; a thousandth is more than rounding.
  EXPECT_TRUE(locator.locate(Vec3(1.0 + 1e-12, 0.3, 0.3), GridTetId(0U)).inside);
  EXPECT_FALSE(locator.locate(Vec3(1.0 + 1e-3, 0.3, 0.3), GridTetId(0U)).inside);
}

TEST(GridLocatorTest, OutsideUsesTheNearestPointOfTheGrid) {
  const GridLocator locator(cubeGrid(6));
  Random random(402);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 position = Vec3(0.5) + random.inBox(2.0);
    const Vec3 nearest = glm::clamp(position, Vec3(0.0), Vec3(1.0));
    const GridLocator::Location location = locator.locate(position, GridTetId(0U));
    EXPECT_EQ(location.inside, position == nearest);
    expectPosition(positionOf(locator, location), nearest, 1e-10);
    EXPECT_NEAR(locator.sizeAt(location), linearSize(nearest), 1e-10);
  }
}

/// A straight walk to the position leaves this grid, so the search must find it.
TEST(GridLocatorTest, FindsPositionsAcrossANotch) {
  BackgroundGrid grid = cubeGrid(6);
  std::vector<std::array<std::uint32_t, 4>> kept;
  for (const auto& tet : grid.tetrahedra) {
    Vec3 centre(0.0);
    for (const std::uint32_t node : tet) centre += 0.25 * grid.nodes[node].position;
    if (centre.x < 0.34 || centre.x > 0.66 || centre.y < 0.34) kept.push_back(tet);
  }
  ASSERT_LT(kept.size(), grid.tetrahedra.size());
  grid.tetrahedra = kept;
  const GridLocator locator(grid);
  const GridTetId left = locator.locate(Vec3(0.1, 0.9, 0.5), GridTetId(0U)).tetrahedron;
  const GridLocator::Location across = locator.locate(Vec3(0.9, 0.9, 0.5), left);
  EXPECT_TRUE(across.inside);
  expectPosition(positionOf(locator, across), Vec3(0.9, 0.9, 0.5), 1e-12);
  EXPECT_FALSE(locator.locate(Vec3(0.5, 0.9, 0.5), left).inside);
}

TEST(GridLocatorTest, SizeFieldCoversWhatTheGridCovers) {
  const SizeField field = SizeField::fromGrid(GridLocator(cubeGrid(4)));
  FieldHint hint;
  EXPECT_TRUE(field.covers(Vec3(0.2, 0.7, 0.9), hint));
  EXPECT_NEAR(field.sizeAt(Vec3(0.2, 0.7, 0.9), hint), linearSize(Vec3(0.2, 0.7, 0.9)), 1e-12);
  EXPECT_FALSE(field.covers(Vec3(0.2, 0.7, 1.1), hint));
}

/// Many calls, each of which visits few tetrahedra, build the same locator as one call.
TEST(GridLocatorTest, IsBuiltInSlices) {
  for (const double stretching : {1.0, 4.0}) {
    BackgroundGrid grid = cubeGrid(6);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
      grid.nodes[i].stretching = stretching;
      if (i % 5 == 0) grid.nodes[i].size *= 0.1;
    }
    constexpr double kGridGrowth = 0.3;
    const GridLocator whole(grid, kGridGrowth);
    Job job([&](Work& work) { return buildGridLocator(work, grid, kGridGrowth); });
    std::size_t slices = 1;
    while (!job.advance(1)) ++slices;
    EXPECT_GT(slices, 2 * grid.tetrahedra.size());
    const GridLocator sliced = job.take();
    Random random(407);
    for (int i = 0; i < 300; ++i) {
      const Vec3 position = Vec3(0.5) + random.inBox(0.7);
      const GridLocator::Location here = sliced.locate(position, GridTetId(0U));
      const GridLocator::Location there = whole.locate(position, GridTetId(0U));
      ASSERT_EQ(here.tetrahedron, there.tetrahedron);
      ASSERT_EQ(here.weights, there.weights);
      ASSERT_EQ(sliced.sizeAt(here), whole.sizeAt(there));
      ASSERT_EQ(sliced.tensorAt(here).xx, whole.tensorAt(there).xx);
    }
  }
}

// ---- checkBackgroundGrid ---------------------------------------------------------------------

std::vector<DiagnosticCode> codesOf(const BackgroundGrid& grid) {
  std::vector<DiagnosticCode> codes;
  for (const Diagnostic& d : checkBackgroundGrid(grid)) codes.push_back(d.code);
  return codes;
}

TEST(BackgroundGridCheckTest, AcceptsAValidGrid) {
  BackgroundGrid grid = cubeGrid(3);
  grid.nodes[2].stretching = 4.0;
  EXPECT_TRUE(codesOf(grid).empty());
}

TEST(BackgroundGridCheckTest, RejectsAnEmptyGrid) {
  EXPECT_EQ(codesOf({}), std::vector{DiagnosticCode::kEmptyBackgroundGrid});
  BackgroundGrid nodesOnly = cubeGrid(1);
  nodesOnly.tetrahedra.clear();
  EXPECT_EQ(codesOf(nodesOnly), std::vector{DiagnosticCode::kEmptyBackgroundGrid});
}

TEST(BackgroundGridCheckTest, FindsTheSameInSlices) {
  BackgroundGrid grid = cubeGrid(5);
  grid.nodes[9].size = -1.0;
  grid.tetrahedra[70] = {7000, 7001, 7002, 7003};
  grid.tetrahedra[200] = grid.tetrahedra[3];
  grid.tetrahedra[300] = grid.tetrahedra[70];
  Job job([&](Work& work) { return checkBackgroundGrid(work, grid); });
  std::size_t slices = 1;
  while (!job.advance(1)) ++slices;
  EXPECT_GT(slices, grid.tetrahedra.size() / 4);
  const std::vector<Diagnostic> sliced = job.take();
  const std::vector<Diagnostic> whole = checkBackgroundGrid(grid);
  ASSERT_EQ(codesOf(grid),
            (std::vector{DiagnosticCode::kSizeOutOfRange, DiagnosticCode::kIndexOutOfRange,
                         DiagnosticCode::kIndexOutOfRange, DiagnosticCode::kDuplicateTriangle,
                         DiagnosticCode::kDuplicateTriangle}));
  ASSERT_EQ(sliced.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(sliced[i].code, whole[i].code);
    EXPECT_EQ(sliced[i].entities.at(0).index, whole[i].entities.at(0).index);
    EXPECT_EQ(sliced[i].values, whole[i].values);
  }
}

TEST(BackgroundGridCheckTest, NamesTheNodeAndItsValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()}) {
    BackgroundGrid grid = cubeGrid(2);
    grid.nodes[5].size = size;
    const std::vector<Diagnostic> found = checkBackgroundGrid(grid);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, DiagnosticCode::kSizeOutOfRange);
    EXPECT_EQ(found[0].entities.at(0).kind, EntityKind::kBackgroundNode);
    EXPECT_EQ(found[0].entities.at(0).index, 5U);
    EXPECT_TRUE(found[0].hasPosition);
    ASSERT_EQ(found[0].values.size(), 1U);
    EXPECT_TRUE(found[0].values[0] == size || std::isnan(size));
  }
}

TEST(BackgroundGridCheckTest, RejectsCoordinatesOutOfRangeForPredicates) {
  BackgroundGrid grid = cubeGrid(2);
  grid.nodes[5].position.y = 0x1p101;
  const std::vector<Diagnostic> found = checkBackgroundGrid(grid);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, DiagnosticCode::kNotFinite);
  EXPECT_EQ(found[0].entities.at(0).kind, EntityKind::kBackgroundNode);
  EXPECT_EQ(found[0].entities.at(0).index, 5U);
}

TEST(BackgroundGridCheckTest, RejectsSizesThatVanishAgainstTheGrid) {
  BackgroundGrid grid = cubeGrid(2);
  grid.nodes[5].size = 1e-11;
  grid.sources.resize(2);
  grid.sources[0].size = 1e-11;
  grid.sources[1].size = 1e-11;
  EXPECT_TRUE(codesOf(grid).empty());
  grid.nodes[5].size = 1e-13;
  grid.sources[1].size = 1e-13;
  const std::vector<Diagnostic> found = checkBackgroundGrid(grid);
  ASSERT_EQ(codesOf(grid), std::vector(2, DiagnosticCode::kSizeOutOfRange));
  EXPECT_EQ(found[0].entities.at(0).kind, EntityKind::kBackgroundNode);
  EXPECT_EQ(found[0].entities.at(0).index, 5U);
  EXPECT_EQ(found[1].entities.at(0).kind, EntityKind::kSource);
  EXPECT_EQ(found[1].entities.at(0).index, 1U);
  EXPECT_EQ(found[1].values, std::vector{1e-13});
}

/// A grid of thin sizes whose normals turn about z along x.
BackgroundGrid turningGrid() {
  BackgroundGrid grid = cubeGrid(3);
  for (BackgroundNode& node : grid.nodes) {
    node.size = 0.01;
    node.stretching = 20.0;
    node.direction = Vec3(std::sin(node.position.x), std::cos(node.position.x), 0.0);
    grid.secondStretchings.push_back({7.0, Vec3(0.0, 0.0, -3.0)});
  }
  return grid;
}

TEST(GridLocatorTest, SecondStretchingsAreThoseOfTheNodes) {
  const BackgroundGrid grid = turningGrid();
  const GridLocator locator(grid);
  for (const BackgroundNode& node : grid.nodes) {
    const auto location = locator.locate(node.position, GridTetId(0U));
    const SymmetricTensor h = locator.tensorAt(location);
    const Vec3 along = node.direction;
    const Vec3 across(along.y, -along.x, 0.0);
    EXPECT_LT(glm::length(h * along - 0.2 * along), 1e-12);
    EXPECT_LT(glm::length(h * across - 0.01 * across), 1e-12);
    EXPECT_LT(glm::length(h * Vec3(0.0, 0.0, 1.0) - Vec3(0.0, 0.0, 0.07)), 1e-12);
    EXPECT_NEAR(locator.sizeAt(location), 0.01, 1e-15);
  }
}

TEST(GridLocatorTest, SecondDirectionsHaveAnyLength) {
  const BackgroundNode node{.position = Vec3(0.0), .size = 0.5, .stretching = 1.0};
  const SymmetricTensor expected = sizeTensor(node, {3.0, Vec3(0.0, 1.0, 0.0)});
  for (const double length : {1e-300, 1e-160, 1e160, 1e300}) {
    const SymmetricTensor found = sizeTensor(node, {3.0, Vec3(0.0, length, 0.0)});
    EXPECT_EQ(found.yy, expected.yy) << length;
    EXPECT_EQ(found.xx, expected.xx) << length;
  }
}

/// Between thin elements of different directions, the logarithmic mean stays thin, and its volume is theirs. The
/// linear mean is thicker.
TEST(GridLocatorTest, SecondStretchingsStayThinBetweenNodes) {
  const BackgroundGrid grid = turningGrid();
  const GridLocator locator(grid);
  double thickest = 0.0;
  double thickestLinear = 0.0;
  Random random(433);
  const auto smallestOf = [](const SymmetricTensor& h) {
    const auto values = principalAxes(h).values;
    return std::min({values[0], values[1], values[2]});
  };
  for (int i = 0; i < 300; ++i) {
    const auto location = locator.locate(Vec3(0.5) + random.inBox(0.5), GridTetId(0U));
    const SymmetricTensor h = locator.tensorAt(location);
    SymmetricTensor linear = SymmetricTensor::isotropic(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t node = grid.tetrahedra[location.tetrahedron.index()][k];
      linear.accumulate(sizeTensor(grid.nodes[node], grid.secondStretchings[node]),
                        location.weights[k]);
    }
    EXPECT_NEAR(h.determinant() / (0.01 * 0.2 * 0.07), 1.0, 1e-9);
    thickest = std::max(thickest, smallestOf(h));
    thickestLinear = std::max(thickestLinear, smallestOf(linear));
  }
  EXPECT_LT(thickest, 0.0112);
  EXPECT_GT(thickestLinear, 0.013);
}

TEST(BackgroundGridCheckTest, RejectsInvalidStretching) {
  BackgroundGrid grid = cubeGrid(2);
  grid.nodes[1].stretching = 0.5;
  grid.nodes[2].stretching = std::numeric_limits<double>::quiet_NaN();
  grid.nodes[3].stretching = 2.0;
  grid.nodes[3].direction = Vec3(0.0);
  grid.nodes[4].direction = Vec3(0.0);  // not stretched, so its direction does not matter
  grid.nodes[5].stretching = 1e200;
  EXPECT_EQ(codesOf(grid), std::vector(4, DiagnosticCode::kStretchingOutOfRange));
}

TEST(BackgroundGridCheckTest, RejectsInvalidSecondStretching) {
  BackgroundGrid grid = cubeGrid(2);
  grid.secondStretchings.assign(grid.nodes.size(), {});
  const auto expectOnly = [&](std::uint32_t node, double cosine) {
    const std::vector<Diagnostic> found = checkBackgroundGrid(grid);
    ASSERT_EQ(codesOf(grid), std::vector(1, DiagnosticCode::kSecondStretchingOutOfRange));
    EXPECT_EQ(found[0].entities.at(0).index, node);
    EXPECT_NEAR(found[0].values.at(1), cosine, 1e-12);
    grid.secondStretchings[node] = {};
  };
  EXPECT_TRUE(codesOf(grid).empty());
  grid.secondStretchings[4].stretching = 0.5;
  expectOnly(4, 0.0);
  grid.secondStretchings[5] = {3.0, Vec3(0.0)};
  expectOnly(5, 0.0);
  grid.secondStretchings[6].stretching = std::numeric_limits<double>::quiet_NaN();
  expectOnly(6, 0.0);
  // Without a first stretching, any second direction will do.
  grid.secondStretchings[7] = {3.0, Vec3(1.0, 1.0, 0.0)};
  EXPECT_TRUE(codesOf(grid).empty());
  grid.nodes[7].stretching = 2.0;
  expectOnly(7, std::sqrt(0.5));
  grid.secondStretchings[7] = {3.0, Vec3(0.005, -1.0, 0.0)};
  EXPECT_TRUE(codesOf(grid).empty());
}

TEST(BackgroundGridCheckTest, ReportsEverythingAtOnce) {
  BackgroundGrid grid = cubeGrid(2);
  grid.nodes[0].position.x = std::numeric_limits<double>::infinity();
  grid.tetrahedra.push_back({1, 2, 3, 999});
  grid.tetrahedra.push_back({1, 1, 2, 3});
  grid.tetrahedra.push_back(grid.tetrahedra[7]);
  std::swap(grid.tetrahedra.back()[0], grid.tetrahedra.back()[2]);
  EXPECT_EQ(codesOf(grid),
            (std::vector{DiagnosticCode::kNotFinite, DiagnosticCode::kIndexOutOfRange,
                         DiagnosticCode::kDegenerateBackgroundTetrahedron,
                         DiagnosticCode::kDuplicateTriangle}));
}

}  // namespace
}  // namespace tetrafront::testing
