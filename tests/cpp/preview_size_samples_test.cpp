// Samples of the size field of a model before it is meshed, and the expected number of elements.

#include "tetrafront/size_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sizing/expected_count.h"
#include "support/models.h"
#include "support/shapes.h"

namespace tetrafront::testing {
namespace {

TEST(SizeSamples, ABoxOfOneSizeHasTheTetrahedraOfItsVolume) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0, 2.0, 3.0));
  MeshOptions options;
  options.size = 0.1;
  const std::vector<double> positions{0.5, 0.5, 0.5, 9.0, 9.0, 9.0};
  const SizeSamples samples = sampleSizes(box, {}, {}, options, positions);
  ASSERT_EQ(samples.sizes.size(), 2U);
  for (const double size : samples.sizes) EXPECT_NEAR(size, 0.1, 1e-14);
  const double exact = kTetrahedraPerUnitVolume * 6.0 / 1e-3;
  EXPECT_NEAR(samples.tetrahedra, exact, 1e-6 * exact);
}

TEST(SizeSamples, ABodyBesideAModelCounts) {
  const Model box = boxModel(Vec3(0.0), Vec3(1.0));
  const SurfaceMesh sphere = geodesicSphere(8);
  BodySurfaces bodies;
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    bodies.points.push_back(sphere.points[i] + (i % 3 == 0 ? 5.0 : 0.0));
  }
  bodies.triangles = sphere.triangles;
  bodies.trianglePatch.assign(sphere.triangles.size() / 3, 0);
  bodies.patches = 1;
  MeshOptions options;
  options.size = 0.05;
  const double volume = 1.0 + tetrafront::enclosedVolume(sphere);
  const SizeSamples samples = sampleSizes(box, bodies, {}, options, {});
  const double exact = kTetrahedraPerUnitVolume * volume / std::pow(0.05, 3);
  EXPECT_NEAR(samples.tetrahedra, exact, 1e-3 * exact);

  // Bodies with invalid indices enclose nothing; the sizes of the model are still known.
  bodies.triangles.front() = 1000000;
  const SizeSamples invalid = sampleSizes(box, bodies, {}, options, {0.0, 0.0, 0.0});
  EXPECT_EQ(invalid.tetrahedra, 0.0);
  ASSERT_EQ(invalid.sizes.size(), 1U);
  EXPECT_NEAR(invalid.sizes.front(), 0.05, 1e-14);
}

TEST(SizeSamples, InvalidSizesGiveNothing) {
  const SizeSamples samples =
      sampleSizes(boxModel(Vec3(0.0), Vec3(1.0)), {}, {}, {}, {0.0, 0.0, 0.0});
  EXPECT_TRUE(samples.sizes.empty());
  EXPECT_EQ(samples.tetrahedra, 0.0);
}

}  // namespace
}  // namespace tetrafront::testing
