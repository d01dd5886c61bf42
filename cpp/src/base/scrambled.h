#pragma once

/// @file Numbers that look random, the same on every machine.

#include <cstdint>

namespace tetrafront {

/// Returns a number that looks random: the finalizer of SplitMix64 (Steele, Lea and Flood, 2014).
/// Different numbers have different results.
[[nodiscard]] constexpr std::uint64_t scrambled(std::uint64_t number) {
  number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
  number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
  return number ^ (number >> 31U);
}

}  // namespace tetrafront
