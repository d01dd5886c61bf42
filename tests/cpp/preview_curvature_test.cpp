// Normals and curvatures for display: those of known surfaces.

#include <gtest/gtest.h>

#include <cmath>

#include "support/models.h"
#include "tetrafront/curvature_samples.h"

namespace tetrafront::testing {
namespace {

CurvatureSamples curvatureOf(const Model& model) {
  CurvatureSampler sampler(model);
  while (!sampler.advance(100)) {
  }
  return sampler.result();
}

Vec3 vertexOf(const std::vector<double>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

TEST(PreviewCurvature, TubeBetweenCirclesHasThoseOfTheCylinder) {
  ModelBuilder builder;
  builder.patch(PatchType::kTube,
                {{builder.exactCircle({0, 0, 0}, 2.0)}, {builder.exactCircle({0, 0, 3}, 2.0)}});
  const CurvatureSamples samples = curvatureOf(builder.model);
  ASSERT_FALSE(samples.gaussian.empty());
  for (std::size_t i = 0; i < samples.gaussian.size(); ++i) {
    const Vec3 position = vertexOf(samples.points, i);
    const Vec3 radial = Vec3(position.x, position.y, 0.0) / 2.0;
    EXPECT_NEAR(std::fabs(glm::dot(vertexOf(samples.normals, i), radial)), 1.0, 1e-9);
    EXPECT_NEAR(samples.gaussian[i], 0.0, 1e-6);
    EXPECT_NEAR(samples.largest[i], 0.5, 1e-5);
  }
  EXPECT_EQ(samples.patchOffsets.back() * 3, samples.triangles.size());
}

TEST(PreviewCurvature, SmoothSphereHasAboutTheCurvatureOfTheSphere) {
  Model model = sphereModel(2.0);
  for (Patch& patch : model.patches) patch.type = PatchType::kGregory;
  const CurvatureSamples samples = curvatureOf(model);
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.gaussian.size(); ++i) {
    EXPECT_NEAR(glm::length(vertexOf(samples.normals, i)), 1.0, 1e-12);
    EXPECT_GT(std::fabs(glm::dot(vertexOf(samples.normals, i),
                                 glm::normalize(vertexOf(samples.points, i)))),
              0.97);
    sum += samples.gaussian[i];
  }
  EXPECT_NEAR(sum / static_cast<double>(samples.gaussian.size()), 0.25, 0.05);
}

TEST(PreviewCurvature, PlanesHaveNoneAndUnusablePatchesNoTriangles) {
  Model model = boxModel({0, 0, 0}, {1, 2, 3});
  model.patches.push_back({PatchType::kGregory, {{{0, false}}}});
  const CurvatureSamples samples = curvatureOf(model);
  ASSERT_EQ(samples.patchOffsets.size(), 8U);
  EXPECT_EQ(samples.patchOffsets[6], samples.patchOffsets[7]);
  EXPECT_GT(samples.patchOffsets[6], 0U);
  for (std::size_t i = 0; i < samples.gaussian.size(); ++i) {
    EXPECT_EQ(samples.largest[i], 0.0);
    EXPECT_NEAR(glm::length(vertexOf(samples.normals, i)), 1.0, 1e-14);
  }
  EXPECT_EQ(curvatureOf({}).patchOffsets.size(), 1U);
}

}  // namespace
}  // namespace tetrafront::testing
