// Compares the quadtree with a list while boxes are inserted and removed.

#include "search/quadtree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/random.h"

namespace tetrafront::testing {
namespace {

PlaneBox randomBox(Random& random, double spread, double largest) {
  const Vec2 corner(random.between(-spread, spread), random.between(-spread, spread));
  return PlaneBox::of(corner,
                      corner + Vec2(random.between(0, largest), random.between(0, largest)));
}

std::vector<std::uint32_t> byList(const std::map<std::uint32_t, PlaneBox>& boxes,
                                  const PlaneBox& query) {
  std::vector<std::uint32_t> found;
  for (const auto& [id, box] : boxes)
    if (box.overlaps(query)) found.push_back(id);
  return found;
}

TEST(SearchQuadtree, AgreesWithAListWhileBoxesAreInsertedAndRemoved) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    // Odd seeds put half of the boxes outside the region, with sizes over four decades.
    const double spread = seed % 2 == 0 ? 1.0 : 1.4;
    Quadtree tree(PlaneBox::of(Vec2(-1.0), Vec2(1.0)));
    std::map<std::uint32_t, PlaneBox> boxes;
    for (std::uint32_t step = 0; step < 4000; ++step) {
      const auto id = static_cast<std::uint32_t>(random.bits() % 700);
      if (const auto old = boxes.find(id); old != boxes.end()) {
        tree.remove(id);
        boxes.erase(old);
      } else {
        const double largest = seed % 2 == 0 ? 0.05 : 0.5 / (1 << random.integer(0, 12));
        boxes[id] = randomBox(random, spread, largest);
        tree.insert(id, boxes[id]);
      }
      if (step % 7 != 0) continue;
      const PlaneBox query = randomBox(random, spread, 0.3);
      std::vector<std::uint32_t> found;
      tree.query(query, found);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, byList(boxes, query)) << "seed " << seed << " step " << step;
    }
  }
}

TEST(SearchQuadtree, HoldsManyBoxesAtOnePosition) {
  Quadtree tree(PlaneBox::of(Vec2(0.0), Vec2(1.0)));
  for (std::uint32_t id = 0; id < 100; ++id) tree.insert(id, PlaneBox::of(Vec2(0.3), Vec2(0.3)));
  std::vector<std::uint32_t> found;
  tree.query(PlaneBox::of(Vec2(0.2), Vec2(0.4)), found);
  EXPECT_EQ(found.size(), 100U);
}

}  // namespace
}  // namespace tetrafront::testing
