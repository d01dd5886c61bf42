#include "search/face_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.h"
#include "topology/node_lists.h"

namespace tetrafront {
namespace {

Box randomBox(testing::Random& random, double spread, double smallest, double decades) {
  double size = smallest;
  for (int i = random.integer(0, static_cast<int>(decades)); i > 0; --i) size *= 10.0;
  const Vec3 centre = random.inBox(spread);
  Box box = Box::of(centre, centre, centre);
  box.include(centre + random.inBox(size));
  return box;
}

Box shifted(Box box, float length) {
  for (int k = 0; k < 3; ++k) {
    box.low[k] += length;
    box.high[k] += length;
  }
  return box;
}

bool meet(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  }
  return true;
}

std::vector<std::uint32_t> found(const FaceGrid& grid, const Box& box) {
  std::vector<std::uint32_t> faces;
  faces.resize(grid.query(box, faces));
  std::sort(faces.begin(), faces.end());
  return faces;
}

void compareWithLinearSearch(std::uint64_t seed, double spread, double smallest, double decades) {
  testing::Random random(seed);
  FaceGrid grid(smallest * 3.0, Vec3(-spread));
  std::vector<Box> boxes;
  std::vector<bool> present;
  for (int step = 0; step < 4000; ++step) {
    const auto face = static_cast<std::uint32_t>(random.integer(0, 999));
    if (face >= boxes.size()) {
      boxes.resize(face + 1);
      present.resize(face + 1, false);
    }
    if (present[face] && random.integer(0, 2) > 0) {
      // Most of these stay in their cells.
      boxes[face] = step % 5 == 0 ? randomBox(random, spread, smallest, decades)
                                  : shifted(boxes[face], static_cast<float>(0.1 * smallest));
      grid.update(face, boxes[face]);
      continue;
    }
    if (present[face]) {
      grid.remove(face);
    } else {
      boxes[face] = randomBox(random, spread, smallest, decades);
      grid.insert(face, boxes[face]);
    }
    present[face] = !present[face];
    if (step % 7 != 0) continue;
    const Box queried = randomBox(random, spread, smallest, decades + 1);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (present[i] && meet(boxes[i], queried)) expected.push_back(i);
    }
    ASSERT_EQ(found(grid, queried), expected) << "seed " << seed << " step " << step;
  }
}

TEST(FaceGrid, AgreesWithLinearSearch) { compareWithLinearSearch(1, 1.0, 0.05, 1); }
TEST(FaceGrid, AgreesWithLinearSearchOverFiveDecadesOfSize) {
  compareWithLinearSearch(2, 10.0, 1e-4, 5);
}
TEST(FaceGrid, AgreesWithLinearSearchFarFromTheOrigin) { compareWithLinearSearch(3, 1e6, 10.0, 2); }

/// Faces larger than the coarsest cells, stored by their centre alone, and faces smaller than the
/// finest cells.
TEST(FaceGrid, AgreesWithLinearSearchBeyondItsLevels) {
  compareWithLinearSearch(4, 1.0, 1e-13, 13);
}

TEST(FaceGrid, AnswersQueriesWithMoreCellsThanIntegersHold) {
  FaceGrid grid(1e-6, Vec3(0.0));
  const Vec3 position{0.5, 0.5, 0.5};
  grid.insert(0, Box::of(position, position, position));
  Box everything{};
  everything.low.fill(-std::numeric_limits<float>::max());
  everything.high.fill(std::numeric_limits<float>::max());
  EXPECT_EQ(found(grid, everything), std::vector<std::uint32_t>{0});
}

TEST(Box, RoundsOutward) {
  testing::Random random(4);
  for (int i = 0; i < 20000; ++i) {
    double value = random.between(-1.0, 1.0);
    for (int k = random.integer(0, 30); k > 0; --k) value *= random.coin() ? 10.0 : 0.1;
    ASSERT_LE(static_cast<double>(roundedDown(value)), value);
    ASSERT_GE(static_cast<double>(roundedUp(value)), value);
    ASSERT_LE(static_cast<double>(roundedUp(value)) - static_cast<double>(roundedDown(value)),
              2.4e-7 * std::max(value, -value) + 1e-44);
  }
}

TEST(NodeLists, ListsEachElementOnceAtEachOfItsNodes) {
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 3, 2, 1, 5, 0, 5, 3, 1};
  NodeLists<TetId> lists(6);
  for (const std::uint32_t node : corners) lists.count(NodeId(node));
  lists.endCounting();
  for (std::uint32_t i = 0; i < corners.size(); ++i) lists.add(NodeId(corners[i]), TetId(i / 4));
  const auto at = [&](std::uint32_t node) {
    std::vector<std::uint32_t> elements;
    for (const TetId element : lists.at(NodeId(node))) elements.push_back(element.value);
    return elements;
  };
  EXPECT_EQ(at(0), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(at(1), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(at(4), (std::vector<std::uint32_t>{}));
  EXPECT_EQ(at(5), (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(at(99), (std::vector<std::uint32_t>{}));
}

}  // namespace
}  // namespace tetrafront
