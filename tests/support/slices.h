#pragma once

/// @file Tools that work in slices.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace tetrafront::testing {

/// Runs a tool to its end in slices of `budget`, and returns the number of slices. Expects a
/// fraction that rises from 0 to 1.
template <class Tool>
std::size_t slicesOf(Tool& tool, std::uint32_t budget) {
  constexpr std::size_t kMax = 10'000'000;
  double before = 0.0;
  EXPECT_EQ(tool.fraction(), 0.0);
  for (std::size_t calls = 1; calls < kMax; ++calls) {
    const bool isFinished = tool.advance(budget);
    const double fraction = tool.fraction();
    EXPECT_GE(fraction, before);
    EXPECT_LE(fraction, 1.0);
    before = fraction;
    if (!isFinished) continue;
    EXPECT_EQ(fraction, 1.0);
    EXPECT_TRUE(tool.advance(budget));
    return calls;
  }
  ADD_FAILURE() << "no end";
  return kMax;
}

}  // namespace tetrafront::testing
