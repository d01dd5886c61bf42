/// Sizes from an indicator of the error: the same indicator in all elements, on any mesh, and shapes from fields.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "metric/metric.h"
#include "solution/indicator_density.h"
#include "support/random.h"
#include "support/sampled_fields.h"
#include "support/tet_grids.h"
#include "tetrafront/solution.h"

namespace tetrafront::testing {
namespace {

double volumeOfElement(const VolumeMesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t k) { return nodePosition(mesh, mesh.tetrahedra[4 * t + k]); };
  return glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6.0;
}

/// The cube with layers that become thinner towards x = 0.
VolumeMesh gradedCube(int n) {
  VolumeMesh mesh = cubeOfTetrahedra(n);
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) mesh.points[i] *= 0.2 + mesh.points[i];
  return mesh;
}

SolutionMetricOptions indicatedBy(std::uint32_t field) {
  SolutionMetricOptions options;
  options.indicator = field;
  options.growth = 0.0;
  options.maxSize = 100.0;
  return options;
}

SolutionMetric sizedBy(const VolumeMesh& mesh, const SolutionFields& fields,
                       const SolutionMetricOptions& options) {
  SolutionSizer sizer(mesh, fields, options);
  while (!sizer.advance(1000)) {
  }
  return sizer.result();
}

double sizeAt(const SolutionMetric& metric, std::size_t node) {
  return stretchedSizeOf(tensorAt(metric.metrics, node)).size;
}

/// An error h^2 |f''| is the same everywhere if h is proportional to 1 / sqrt(|f''|); the integral of 10 / h^3 is the
/// number of elements.
TEST(SolutionIndicatorTest, TheErrorOfAUniformMeshGivesTheOptimalSizes) {
  const VolumeMesh mesh = cubeOfTetrahedra(16);
  const auto second = [](const Vec3& x) { return std::exp(4.0 * x.x - x.y); };
  const auto antiderivative = [](double a) { return (std::exp(1.5 * a) - 1.0) / (1.5 * a); };
  const double integral = antiderivative(4.0) * antiderivative(-1.0);
  const auto error = [&](const Vec3& x) { return 1e-4 * second(x); };
  const SolutionFields fields{atNodes(mesh, error), {1}, {0}};
  SolutionMetricOptions options = indicatedBy(0);
  options.elements = 1e5;
  const SolutionMetric metric = sizedBy(mesh, fields, options);
  EXPECT_NEAR(metric.elements / 1e5, 1.0, 0.01);
  const double scale = std::cbrt(10.0 * integral / 1e5);
  for (std::size_t i = 0; i < mesh.points.size() / 3; ++i) {
    const double optimal = scale / std::sqrt(second(nodePosition(mesh, i)));
    ASSERT_NEAR(sizeAt(metric, i) / optimal, 1.0, 0.02);
  }
}

/// An indicator of the elements that falls with the power of their size leads to the same sizes on every mesh.
TEST(SolutionIndicatorTest, TheSizesDoNotDependOnTheMesh) {
  const VolumeMesh mesh = gradedCube(6);
  for (const double order : {1.0, 2.0, 3.5}) {
    SolutionFields fields{{}, {1}, {1}};
    for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t)
      fields.values.push_back(std::pow(10.0 * volumeOfElement(mesh, t), order / 3.0));
    SolutionMetricOptions options = indicatedBy(0);
    options.indicatorOrder = order;
    options.error = std::pow(0.07, order);
    const SolutionMetric metric = sizedBy(mesh, fields, options);
    for (std::size_t i = 0; i < mesh.points.size() / 3; ++i)
      ASSERT_NEAR(sizeAt(metric, i), 0.07, 1e-12) << order;
    EXPECT_NEAR(metric.errors[0] / options.error, 1.0, 1e-12);
  }
}

TEST(SolutionIndicatorTest, AConstantIndicatorScalesTheSizesOfTheMesh) {
  const VolumeMesh mesh = gradedCube(5);
  const std::size_t elements = mesh.tetrahedra.size() / 4;
  for (const bool isPerElement : {false, true}) {
    const std::size_t count = isPerElement ? elements : mesh.points.size() / 3;
    const SolutionFields fields{
        std::vector<double>(count, 3.0), {1}, {static_cast<std::uint8_t>(isPerElement ? 1 : 0)}};
    SolutionMetricOptions options = indicatedBy(0);
    options.error = 3.0;
    const SolutionMetric own = sizedBy(mesh, fields, options);
    // The densities are means of the elements around each node, and their logarithms are linear between the nodes: 0.9 % fewer here.
    EXPECT_NEAR(own.elements / static_cast<double>(elements), 1.0, 0.01);
    options.error = 0.75;
    const SolutionMetric half = sizedBy(mesh, fields, options);
    for (std::size_t i = 0; i < mesh.points.size() / 3; ++i)
      ASSERT_NEAR(sizeAt(own, i) / sizeAt(half, i), 2.0, 1e-12);
    options.error = 0.0;
    options.elements = 8.0 * static_cast<double>(elements);
    EXPECT_NEAR(sizedBy(mesh, fields, options).errors[0], 0.75, 0.01);
  }
}

/// Thin elements across z where the field bends, with the volume that the indicator asks for.
TEST(SolutionIndicatorTest, FieldsGiveTheShapeAndTheIndicatorTheSize) {
  const VolumeMesh mesh = cubeOfTetrahedra(8, 0.1);
  const std::size_t nodes = mesh.points.size() / 3;
  SolutionFields fields{{}, {1, 1}, {0, 0}};
  for (std::size_t i = 0; i < nodes; ++i) {
    const Vec3 x = nodePosition(mesh, i);
    fields.values.push_back(1e3 * (x.x * x.x + x.y * x.y + 16.0 * x.z * x.z));
  }
  for (std::size_t i = 0; i < nodes; ++i)
    fields.values.push_back(1.0 + 7.0 * nodePosition(mesh, i).x);
  SolutionMetricOptions options = indicatedBy(1);
  options.error = 0.1;
  const SolutionMetric shaped = sizedBy(mesh, fields, options);
  const SolutionMetric round = sizedBy(
      mesh,
      {{fields.values.begin() + static_cast<std::ptrdiff_t>(nodes), fields.values.end()}, {1}, {0}},
      [&] {
        SolutionMetricOptions alone = options;
        alone.indicator = 0;
        return alone;
      }());
  for (std::size_t i = 0; i < nodes; ++i) {
    const StretchedSize sizes = stretchedSizeOf(tensorAt(shaped.metrics, i));
    ASSERT_NEAR(sizes.stretching, 4.0, 1e-4);
    ASSERT_NEAR(sizes.secondStretching, 4.0, 1e-4);
    ASSERT_NEAR(densityOf(tensorAt(shaped.metrics, i)) / densityOf(tensorAt(round.metrics, i)), 1.0,
                1e-9);
    ASSERT_NEAR(stretchedSizeOf(tensorAt(round.metrics, i)).stretching, 1.0, 1e-9);
  }
  EXPECT_GT(shaped.errors[0], 0.0);
  EXPECT_NEAR(shaped.errors[1], 0.1, 1e-9);
}

/// Where the largest size limits one direction, the others take its share of the volume.
TEST(SolutionIndicatorTest, LimitsKeepTheVolumeWhileTheyCan) {
  Random random(771);
  for (int trial = 0; trial < 200; ++trial) {
    const StretchedSize given{.size = 0.01 + random.unit(),
                              .stretching = 1.0 + 30.0 * random.unit(),
                              .direction = random.inBox(),
                              .secondStretching = 1.0,
                              .secondDirection = random.inBox()};
    const double density = 1.0 / (0.001 + random.unit());
    const MetricBounds bounds{.minSize = 0.0, .maxSize = 1.0, .maxAspect = 10.0};
    const SymmetricTensor made = withDensity(metricOf(given), density, bounds);
    const StretchedSize sizes = stretchedSizeOf(made);
    EXPECT_LE(sizes.size * sizes.stretching, 1.0 + 1e-9);
    EXPECT_LE(sizes.stretching, 10.0 + 1e-6);
    EXPECT_NEAR(densityOf(made) / std::max(1.0, density), 1.0, 1e-9);
  }
}

TEST(SolutionIndicatorTest, AnIndicatorOfZeroAsksForNothing) {
  const VolumeMesh mesh = cubeOfTetrahedra(4, 0.1);
  SolutionFields fields{std::vector<double>(mesh.points.size() / 3, 0.0), {1}, {0}};
  SolutionMetricOptions options = indicatedBy(0);
  options.elements = 5000.0;
  const SolutionMetric equal = sizedBy(mesh, fields, options);
  EXPECT_EQ(equal.hasVariation[0], 0);
  EXPECT_NEAR(equal.elements, 5000.0, 50.0);
  EXPECT_NEAR(sizeAt(equal, 0), sizeAt(equal, 17), 1e-12);
  options.elements = 0.0;
  options.error = 0.1;
  options.maxSize = 0.4;
  EXPECT_NEAR(sizeAt(sizedBy(mesh, fields, options), 3), 0.4, 1e-12);
  // One node with an error: sizes grow from it as far as the growth permits.
  fields.values[0] = 0.9;
  options.growth = 0.5;
  const SolutionMetric local = sizedBy(mesh, fields, options);
  EXPECT_LT(sizeAt(local, 0), 0.12);
  EXPECT_NEAR(
      *std::ranges::max_element(local.frontSizes.sizes) / (0.4 * std::cbrt(std::sqrt(72.0) / 10.0)),
      1.0, 1e-6);
  EXPECT_NEAR(local.errors[0], 0.1, 1e-9);
}

}  // namespace
}  // namespace tetrafront::testing
