/// How many elements fit into the memory.

#include "sizing/memory_limit.h"

#include <gtest/gtest.h>

namespace tetrafront {
namespace {

constexpr double kFourGigabytes = 4294967296.0;

TEST(MemoryLimit, AllowsManyMoreElementsWithLattices) {
  EXPECT_NEAR(elementsWithin(kFourGigabytes, 100'000, false), 28.6e6, 0.1e6);
  // The surface of a cube with 100 million elements.
  EXPECT_GT(elementsWithin(kFourGigabytes, 840'000, true), 100e6);
  // A surface so fine that its layer alone takes the memory: the front may still be enough.
  EXPECT_EQ(elementsWithin(kFourGigabytes, 2'000'000, true),
            elementsWithin(kFourGigabytes, 2'000'000, false));
}

TEST(MemoryLimit, LeavesTheFrontWhatOtherElementsDoNotTake) {
  EXPECT_EQ(frontElementsBeside(1500.0, 0), 10U);
  EXPECT_EQ(frontElementsBeside(1500.0, 75), 5U);
  EXPECT_EQ(frontElementsBeside(1500.0, 1000), 0U);
  EXPECT_GT(frontElementsBeside(kAddressableBytes, 100'000'000), 1'000'000'000U);
}

}  // namespace
}  // namespace tetrafront
