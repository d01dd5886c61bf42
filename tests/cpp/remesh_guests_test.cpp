/// The points of the given surface from which the remeshed one may not move away.

#include "remesh/guests.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "base/task.h"
#include "support/part_shapes.h"

namespace tetrafront::testing {
namespace {

/// Without features, all 6000 sharp edges are bends; 1000 guests on each would be 6 million.
TEST(Guests, AreLimitedInTotalAtATinyTolerance) {
  const SurfaceMesh given = prism({gear(1000, {{0.0, 0.85}, {0.05, 1.0}}), {}}, 0.2);
  ReferenceSurface reference(given, {.creaseCosine = -1.0, .cornerCosine = -1.0});
  Job<> job([&reference](Work& work) { return reference.prepare(work); });
  job.finish();
  const SurfaceComplex complex(reference);
  EXPECT_LT(findGuests(reference, complex, 0.02).size(), 100'000U);
  const std::size_t guests = findGuests(reference, complex, 1e-8).size();
  EXPECT_GT(guests, 500'000U);
  EXPECT_LT(guests, 2'100'000U);
}

}  // namespace
}  // namespace tetrafront::testing
