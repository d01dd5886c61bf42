#include "search/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

std::vector<Box> randomBoxes(std::size_t count) {
  Random random(31);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 position = random.inBox();
    boxes.push_back(
        Box::of(position, position + random.inBox(0.05), position + random.inBox(0.05)));
  }
  return boxes;
}

std::vector<std::uint32_t> meeting(const BoxTree& tree, const Box& box) {
  std::vector<std::uint32_t> items;
  tree.visitOverlaps(box, [&](std::uint32_t item) { items.push_back(item); });
  return items;
}

/// Each call visits as many boxes as requested, and the result is the tree that one call builds.
TEST(BoxTree, IsBuiltInSlices) {
  for (const std::size_t count : {0U, 1U, 4U, 5U, 700U}) {
    const std::vector<Box> boxes = randomBoxes(count);
    const BoxTree whole(boxes);
    Job job([&](Work& work) { return BoxTree::build(work, boxes, 1); });
    std::size_t slices = 1;
    while (!job.advance(1)) ++slices;
    EXPECT_GE(slices, 13 * count);
    const BoxTree sliced = job.take();
    EXPECT_EQ(sliced.nodeCount(), whole.nodeCount());
    for (const Box& box : boxes) EXPECT_EQ(meeting(sliced, box), meeting(whole, box));
  }
}

TEST(BoxTree, FindsAllItemsThatOverlapABox) {
  const std::vector<Box> boxes = randomBoxes(400);
  const BoxTree tree(boxes);
  for (const Box& box : boxes) {
    std::vector<std::uint32_t> found = meeting(tree, box);
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (BoxTree::overlaps(boxes[i], box)) expected.push_back(i);
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace tetrafront::testing
