#include "geom/cube_root.h"

#include <gtest/gtest.h>

#include <limits>

namespace tetrafront {
namespace {

TEST(CubeRoot, OfACubeIsExact) {
  for (const double root : {1.0, 2.0, 3.0, 10.0, 0.5, 0x1p-300, 0x1p300}) {
    EXPECT_EQ(cubeRoot(root * root * root), root);
  }
  EXPECT_EQ(cubeRoot(0.0), 0.0);
}

TEST(CubeRoot, ToTheThirdIsTheValue) {
  for (double value = 1e-300; value < 1e300; value *= 1.37) {
    const double root = cubeRoot(value);
    EXPECT_NEAR(root * root * root / value, 1.0, 4.0 * std::numeric_limits<double>::epsilon())
        << value;
  }
}

}  // namespace
}  // namespace tetrafront
