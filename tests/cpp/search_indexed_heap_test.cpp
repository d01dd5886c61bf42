#include "search/indexed_heap.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "support/random.h"

namespace tetrafront {
namespace {

TEST(IndexedHeap, AgreesWithAnOrderedSetOverRandomPushesPopsAndRemovals) {
  testing::Random random(7);
  IndexedHeap heap;
  constexpr std::uint32_t kIds = 500;
  heap.reserveIds(kIds);
  std::set<std::pair<std::uint64_t, std::uint32_t>> expected;
  std::vector<std::uint64_t> keyOf(kIds, 0);
  for (std::uint64_t step = 0; step < 20000; ++step) {
    const auto id = static_cast<std::uint32_t>(random.integer(0, kIds - 1));
    if (!heap.contains(id)) {
      // Unique keys, so that the heap has the order of the set.
      keyOf[id] = random.bits() / 1000 * 1000 + step % 1000;
      heap.push(id, keyOf[id]);
      expected.insert({keyOf[id], id});
    } else if (random.coin()) {
      heap.remove(id);
      expected.erase({keyOf[id], id});
    } else {
      const auto least = *expected.begin();
      ASSERT_EQ(heap.pop(), least.second) << "step " << step;
      expected.erase(expected.begin());
    }
    ASSERT_EQ(heap.size(), expected.size());
  }
  while (!heap.empty()) {
    ASSERT_EQ(heap.pop(), expected.begin()->second);
    expected.erase(expected.begin());
  }
}

TEST(IndexedHeap, ClearRemovesAllIds) {
  IndexedHeap heap;
  heap.reserveIds(3);
  heap.push(1, 10);
  heap.push(2, 5);
  heap.clear();
  EXPECT_TRUE(heap.empty());
  EXPECT_FALSE(heap.contains(1));
  heap.remove(2);
  heap.push(2, 7);
  EXPECT_EQ(heap.pop(), 2U);
}

}  // namespace
}  // namespace tetrafront
