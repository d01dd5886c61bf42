#pragma once

/// @file Seeded random numbers for tests: the same on every platform and with every library.

#include <cstdint>

#include "tetrafront/vec3.h"

namespace tetrafront::testing {

/// SplitMix64 (Steele, Lea & Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  /// In [0, 1).
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }

  /// In [low, high].
  int integer(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool coin() { return (bits() >> 63U) != 0; }

  Vec3 inBox(double half = 1.0) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return {x, y, between(-half, half)};
  }

 private:
  std::uint64_t state_;
};

}  // namespace tetrafront::testing
