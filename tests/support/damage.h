#pragma once

/// @file Damages input at random, for tests that any input ends with a result or a diagnostic.

#include <array>
#include <limits>
#include <vector>

#include "support/random.h"
#include "tetrafront/background_grid.h"

namespace tetrafront::testing {

/// Returns a number that often causes failures.
inline double wildNumber(Random& random) {
  constexpr std::array<double, 12> kWild{0.0,
                                         -0.0,
                                         1e-320,
                                         -1e-40,
                                         1e-13,
                                         1e12,
                                         -1e29,
                                         -1e308,
                                         1.5,
                                         -2.0,
                                         std::numeric_limits<double>::infinity(),
                                         std::numeric_limits<double>::quiet_NaN()};
  return kWild[random.bits() % kWild.size()];
}

/// Returns one of the values, which must not be empty.
template <class Value>
Value& any(Random& random, std::vector<Value>& values) {
  return values[random.bits() % values.size()];
}

inline SizeSource wildSource(Random& random) {
  SizeSource source;
  source.type = static_cast<SourceType>(random.integer(0, 2));
  source.points = {random.inBox(), random.inBox(), random.coin() ? random.inBox() : Vec3(0.0)};
  source.size = random.coin() ? 0.3 : wildNumber(random);
  source.distance = random.coin() ? 0.2 : wildNumber(random);
  source.growth = random.coin() ? 0.3 : wildNumber(random);
  return source;
}

}  // namespace tetrafront::testing
