/// Metrics: lengths, logarithms, means, intersections, bounds and sizes.

#include "metric/metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "metric/principal_axes.h"
#include "support/random.h"

namespace tetrafront::testing {
namespace {

/// A metric with sizes between 1e-3 and 1 along random axes.
SymmetricTensor randomMetric(Random& random) {
  StretchedSize sizes;
  sizes.size = std::pow(10.0, random.between(-3.0, 0.0));
  sizes.stretching = 1.0 / std::pow(sizes.size, random.unit());
  sizes.secondStretching = 1.0 / std::pow(sizes.size, random.unit());
  sizes.direction = random.inBox() + Vec3(0.001);
  sizes.secondDirection = random.inBox() - Vec3(0.002, 0.0, 0.0);
  return metricOf(sizes);
}

std::array<double, 6> numbersOf(const SymmetricTensor& t) {
  return {t.xx, t.xy, t.xz, t.yy, t.yz, t.zz};
}

double largestOf(const SymmetricTensor& t) {
  double largest = 0.0;
  for (const double number : numbersOf(t)) largest = std::max(largest, std::fabs(number));
  return largest;
}

void expectNear(const SymmetricTensor& a, const SymmetricTensor& b, double relative) {
  const double allowance = relative * std::max(largestOf(a), largestOf(b));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(numbersOf(a)[i], numbersOf(b)[i], allowance) << i;
}

TEST(MetricTest, ArraysHoldTheUpperTriangleByRows) {
  std::vector<double> numbers(12, 0.0);
  const SymmetricTensor tensor{.xx = 1, .yy = 4, .zz = 6, .xy = 2, .xz = 3, .yz = 5};
  putTensor(numbers, 1, tensor);
  EXPECT_EQ(numbers, (std::vector<double>{0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(numbersOf(tensorAt(numbers, 1)), numbersOf(tensor));
}

TEST(MetricTest, TheLengthAlongAnAxisIsTheLengthOverTheSize) {
  const SymmetricTensor metric = metricOf({.size = 0.1,
                                           .stretching = 5.0,
                                           .direction = {0, 0, 2},
                                           .secondStretching = 2.0,
                                           .secondDirection = {0, 3, 7}});
  EXPECT_NEAR(metricLength(metric, {1, 0, 0}), 10.0, 1e-13);
  EXPECT_NEAR(metricLength(metric, {0, 1, 0}), 5.0, 1e-13);
  EXPECT_NEAR(metricLength(metric, {0, 0, 1}), 2.0, 1e-13);
}

TEST(MetricTest, TheLengthBetweenTwoMetricsIsTheIntegralOverTheEdge) {
  Random random(4811);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor a = randomMetric(random);
    const SymmetricTensor b =
        i % 3 == 0 ? a.scaledBy(random.between(0.9, 1.1)) : randomMetric(random);
    const Vec3 edge = random.inBox();
    // Simpson's rule for the length interpolated geometrically.
    const double from = std::log(metricLength(a, edge));
    const double to = std::log(metricLength(b, edge));
    constexpr int kSteps = 2000;
    double sum = 0.0;
    for (int k = 0; k <= kSteps; ++k) {
      const double weight = k == 0 || k == kSteps ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
      sum += weight * std::exp(from + (to - from) * k / kSteps);
    }
    const double expected = sum / (3.0 * kSteps);
    EXPECT_NEAR(metricLength(a, b, edge) / expected, 1.0, 1e-9);
    EXPECT_EQ(metricLength(a, b, edge), metricLength(b, a, -edge));
  }
}

TEST(MetricTest, LogarithmicMeansAreContinuousAndBetweenTheirNumbers) {
  EXPECT_EQ(logarithmicMean(3.0, 3.0), 3.0);
  EXPECT_EQ(logarithmicMean(0.0, 1.0), 0.0);
  for (double ratio = 1.0; ratio < 1e6; ratio *= 1.003) {
    const double mean = logarithmicMean(1.0, ratio);
    if (ratio > 1.0) {
      EXPECT_NEAR(mean / ((ratio - 1.0) / std::log(ratio)), 1.0, 3e-13) << ratio;
    }
    EXPECT_GE(mean, std::sqrt(ratio) * (1.0 - 1e-15));
    EXPECT_LE(mean, 0.5 * (1.0 + ratio) * (1.0 + 1e-15));
  }
}

TEST(MetricTest, TheExponentialUndoesTheLogarithm) {
  Random random(4812);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor metric = randomMetric(random);
    const SymmetricTensor back = exponentialOf(logarithmOf(metric));
    expectNear(back, metric, 1e-13);
    for (int k = 0; k < 10; ++k) {
      const Vec3 edge = random.inBox();
      EXPECT_NEAR(metricLength(back, edge) / metricLength(metric, edge), 1.0, 1e-9);
    }
  }
}

TEST(MetricTest, TheExponentialIsItsPowerSeries) {
  Random random(4813);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = random.inBox();
    const Vec3 b = random.inBox();
    const SymmetricTensor tensor{a.x, a.y, a.z, b.x, b.y, b.z};
    // (I + T / 2^20)^(2^20) by squaring, with a second-order first factor.
    SymmetricTensor power = tensor.scaledBy(0x1p-20);
    SymmetricTensor factor = SymmetricTensor::isotropic(1.0);
    factor.accumulate(power, 1.0);
    factor.accumulate(power.squared(), 0.5);
    for (int k = 0; k < 20; ++k) factor = factor.squared();
    expectNear(exponentialOf(tensor), factor, 1e-8);
  }
}

TEST(MetricTest, TheMeanOfAlignedMetricsIsTheGeometricMeanOfTheSizes) {
  const std::array metrics{metricOf({.size = 0.1, .stretching = 100.0}), metricOf({.size = 0.4})};
  const SymmetricTensor mean = meanOf(metrics, std::array{0.5, 0.5});
  expectNear(mean, metricOf({.size = 0.2, .stretching = 10.0}), 1e-13);
}

TEST(MetricTest, TheMeanScalesWithItsMetrics) {
  Random random(4814);
  const std::array metrics{randomMetric(random), randomMetric(random), randomMetric(random)};
  const std::array<double, 3> weights{0.2, 0.3, 0.5};
  std::array scaled = metrics;
  for (SymmetricTensor& metric : scaled) metric = metric.scaledBy(7.0);
  expectNear(meanOf(scaled, weights), meanOf(metrics, weights).scaledBy(7.0), 1e-12);
}

TEST(MetricTest, TheIntersectionIsTheSmallestMetricAboveBoth) {
  Random random(4815);
  for (int i = 0; i < 500; ++i) {
    const SymmetricTensor a = randomMetric(random);
    const SymmetricTensor b = randomMetric(random);
    const SymmetricTensor both = intersectionOf(a, b);
    for (int k = 0; k < 30; ++k) {
      const Vec3 edge = random.inBox();
      const double most = std::max(metricLength(a, edge), metricLength(b, edge));
      EXPECT_GE(metricLength(both, edge), most * (1.0 - 1e-9));
    }
    // In each of three conjugate directions, it equals one of the two.
    const Cholesky lower(a);
    for (const Vec3& axis : principalAxes(lower.reduced(b)).axes) {
      // Solves L^T v = axis.
      const double z = axis.z / lower.zz;
      const double y = (axis.y - lower.zy * z) / lower.yy;
      const Vec3 conjugate((axis.x - lower.yx * y - lower.zx * z) / lower.xx, y, z);
      const double most = std::max(metricLength(a, conjugate), metricLength(b, conjugate));
      EXPECT_NEAR(metricLength(both, conjugate) / most, 1.0, 1e-8);
    }
    EXPECT_TRUE(isNowhereBelow(both, a, 1e-8));
    EXPECT_TRUE(isNowhereBelow(both, b, 1e-8));
  }
}

TEST(MetricTest, TheIntersectionWithALargerOneIsThisOne) {
  Random random(4816);
  const SymmetricTensor metric = randomMetric(random);
  EXPECT_EQ(numbersOf(intersectionOf(metric, metric)), numbersOf(metric));
  EXPECT_EQ(numbersOf(intersectionOf(metric, metric.scaledBy(0.25))), numbersOf(metric));
  expectNear(intersectionOf(metric, metric.scaledBy(4.0)), metric.scaledBy(4.0), 1e-9);
}

TEST(MetricTest, BoundsLimitSizesAndAspect) {
  Random random(4817);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor metric = randomMetric(random);
    const MetricBounds bounds{.minSize = 0.01, .maxSize = 0.3, .maxAspect = 8.0};
    const StretchedSize sizes = stretchedSizeOf(bounded(metric, bounds));
    EXPECT_GE(sizes.size, 0.01 * (1.0 - 1e-9));
    EXPECT_LE(sizes.size * sizes.stretching, 0.3 * (1.0 + 1e-9));
    EXPECT_LE(sizes.stretching, 8.0 * (1.0 + 1e-9));
    const double before = stretchedSizeOf(metric).size;
    EXPECT_NEAR(sizes.size, std::clamp(before, 0.01, 0.3), 1e-9);
    EXPECT_EQ(numbersOf(bounded(metric, {})), numbersOf(metric));
  }
  expectNear(bounded(SymmetricTensor::isotropic(0.0), {.maxSize = 2.0}),
             SymmetricTensor::isotropic(0.25), 1e-15);
}

TEST(MetricTest, SizesAndDirectionsComeBack) {
  Random random(4818);
  for (int i = 0; i < 300; ++i) {
    const SymmetricTensor metric = randomMetric(random);
    const StretchedSize sizes = stretchedSizeOf(metric);
    EXPECT_GE(sizes.stretching, sizes.secondStretching);
    EXPECT_GE(sizes.secondStretching, 1.0);
    EXPECT_NEAR(glm::dot(sizes.direction, sizes.secondDirection), 0.0, 1e-13);
    expectNear(metricOf(sizes), metric, 1e-12);
  }
}

TEST(MetricTest, DensityIsTheInverseProductOfTheSizes) {
  const SymmetricTensor metric = metricOf({.size = 0.01,
                                           .stretching = 100.0,
                                           .direction = {1, 2, 3},
                                           .secondStretching = 10.0,
                                           .secondDirection = {3, 1, 1}});
  EXPECT_NEAR(densityOf(metric) / 1000.0, 1.0, 1e-9);
  EXPECT_EQ(densityOf(SymmetricTensor::isotropic(0.0)), 0.0);
  EXPECT_EQ(densityOf(SymmetricTensor::isotropic(-1.0)), 0.0);
}

TEST(MetricTest, OnlyPositiveTensorsAreMetrics) {
  EXPECT_TRUE(isMetric(SymmetricTensor::isotropic(3.0)));
  EXPECT_FALSE(isMetric(SymmetricTensor::isotropic(0.0)));
  EXPECT_FALSE(isMetric({1.0, 1.0, 1.0, 2.0, 0.0, 0.0}));
  EXPECT_FALSE(isMetric({1.0, 1.0, std::nan(""), 0.0, 0.0, 0.0}));
  EXPECT_FALSE(isMetric({1.0, 1.0, 1e-13, 0.0, 0.0, 0.0}));
  EXPECT_TRUE(isMetric({1.0, 1.0, 2e-12, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace tetrafront::testing
