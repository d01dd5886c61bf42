/// From fields to metrics: recovered Hessians, the number of elements, the expected error, and limits.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "metric/mesh_metric.h"
#include "metric/metric.h"
#include "solution/quadratic_fit.h"
#include "solution/recovered_hessian.h"
#include "support/random.h"
#include "support/sampled_fields.h"
#include "support/tet_grids.h"
#include "tetrafront/solution.h"

namespace tetrafront::testing {
namespace {

std::vector<double> atCentroids(const VolumeMesh& mesh, const Field& function) {
  std::vector<double> values;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    Vec3 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) sum += nodePosition(mesh, mesh.tetrahedra[t + k]);
    values.push_back(function(0.25 * sum));
  }
  return values;
}

std::vector<double> recovered(const VolumeMesh& mesh, const std::vector<double>& values,
                              std::uint32_t components, bool isPerElement) {
  Job edgeJob([&](Work& work) { return edgesOf(work, mesh); });
  const MeshEdges edges = edgeJob.finish();
  Job job([&](Work& work) {
    return recoverHessians(work, mesh, edges, {values, components, isPerElement});
  });
  return job.finish();
}

SolutionMetric sized(const VolumeMesh& mesh, const SolutionFields& fields,
                     const SolutionMetricOptions& options) {
  SolutionSizer sizer(mesh, fields, options);
  while (!sizer.advance(1000)) {
  }
  return sizer.result();
}

SolutionFields oneField(std::vector<double> values) { return {std::move(values), {1}, {0}}; }

/// A mesh that is 1, 1 and `thickness` wide.
VolumeMesh slab(int n, double thickness) {
  VolumeMesh mesh = cubeOfTetrahedra(n, 0.15);
  for (std::size_t i = 2; i < mesh.points.size(); i += 3) mesh.points[i] *= thickness;
  return mesh;
}

struct Quadratic {
  SymmetricTensor hessian;
  Vec3 gradient;
  double constant;
  double operator()(const Vec3& x) const {
    return 0.5 * glm::dot(x, hessian * x) + glm::dot(gradient, x) + constant;
  }
};

Quadratic randomQuadratic(Random& random) {
  const Vec3 a = random.inBox();
  const Vec3 b = random.inBox();
  return {{a.x, a.y, a.z, b.x, b.y, b.z}, random.inBox(), 100.0 * random.unit()};
}

void expectHessian(const std::vector<double>& hessians, std::size_t slot,
                   const SymmetricTensor& expected, double allowance) {
  std::vector<double> numbers(6);
  putTensor(numbers, 0, expected);
  for (std::size_t k = 0; k < 6; ++k)
    ASSERT_NEAR(hessians[6 * slot + k], numbers[k], allowance) << "node " << slot << ", " << k;
}

TEST(SolutionMetricTest, HessiansOfQuadraticFunctionsAreExactAtEveryNode) {
  Random random(4831);
  for (const double thickness : {1.0, 0.01}) {
    const VolumeMesh mesh = slab(5, thickness);
    const Quadratic first = randomQuadratic(random);
    const Quadratic second = randomQuadratic(random);
    const std::size_t nodes = mesh.points.size() / 3;
    std::vector<double> values;
    for (std::size_t i = 0; i < nodes; ++i) {
      values.push_back(first(nodePosition(mesh, i)));
      values.push_back(second(nodePosition(mesh, i)));
    }
    const std::vector<double> hessians = recovered(mesh, values, 2, false);
    const double allowance = 1e-11 * 100.0 / (thickness * thickness);
    for (std::size_t i = 0; i < nodes; ++i) {
      expectHessian(hessians, i, first.hessian, allowance);
      expectHessian(hessians, nodes + i, second.hessian, allowance);
    }
  }
}

TEST(SolutionMetricTest, HessiansFromCentroidsAreExactToo) {
  Random random(4832);
  const VolumeMesh mesh = cubeOfTetrahedra(4, 0.15);
  const Quadratic function = randomQuadratic(random);
  const std::vector<double> hessians = recovered(mesh, atCentroids(mesh, function), 1, true);
  for (std::size_t i = 0; i < mesh.points.size() / 3; ++i)
    expectHessian(hessians, i, function.hessian, 1e-9);
}

/// One cube of six tetrahedra has eight nodes: they determine the mixed derivatives only.
TEST(SolutionMetricTest, TooFewNodesGiveWhatTheyDetermine) {
  const VolumeMesh mesh = cubeOfTetrahedra(1);
  const auto values = atNodes(mesh, [](const Vec3& x) { return 3.0 * x.x - 2.0 * x.y + x.z; });
  for (const double number : recovered(mesh, values, 1, false)) EXPECT_NEAR(number, 0.0, 1e-12);
}

TEST(SolutionMetricTest, HessiansOfSmoothFunctionsConverge) {
  const auto function = [](const Vec3& x) {
    return std::sin(3.0 * x.x) * std::exp(x.y) + x.z * x.z * x.z;
  };
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const VolumeMesh mesh = cubeOfTetrahedra(level == 0 ? 6 : 12, 0.1);
    const auto hessians = recovered(mesh, atNodes(mesh, function), 1, false);
    double sum = 0.0;
    const std::size_t nodes = mesh.points.size() / 3;
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vec3 x = nodePosition(mesh, i);
      sum += std::fabs(hessians[6 * i] + 9.0 * function(x) - 9.0 * x.z * x.z * x.z) +
             std::fabs(hessians[6 * i + 5] - 6.0 * x.z);
    }
    errors[level] = sum / static_cast<double>(nodes);
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}

/// Steep tangential layers (tanh) and ridges, as in the tests of NASA's refine.
double layers(const Vec3& x) {
  return std::tanh(20.0 * (x.x + 0.3 * std::sin(5.0 * x.y) - 0.5)) + 0.3 * x.z * x.z;
}

TEST(SolutionMetricTest, TheNumberOfElementsIsReachedWithinFivePercent) {
  const VolumeMesh mesh = cubeOfTetrahedra(10, 0.1);
  const SolutionFields fields = oneField(atNodes(mesh, layers));
  for (const ErrorNorm norm : {ErrorNorm::kL1, ErrorNorm::kL2, ErrorNorm::kL4, ErrorNorm::kMax}) {
    for (const double elements : {500.0, 20'000.0, 1e6}) {
      for (const bool isIsotropic : {false, true}) {
        SolutionMetricOptions options;
        options.norm = norm;
        options.elements = elements;
        options.isIsotropic = isIsotropic;
        options.maxSize = 0.5;
        const SolutionMetric metric = sized(mesh, fields, options);
        EXPECT_NEAR(metric.elements / elements, 1.0, 0.05);
        // The number is an integral over the mesh, here once more by its nodes' shares.
        EXPECT_NEAR(metric.elements / (10.0 * complexityOf(mesh, metric.metrics)), 1.0, 1e-12);
        for (std::size_t i = 0; i < metric.frontSizes.sizes.size(); ++i) {
          const StretchedSize sizes = stretchedSizeOf(tensorAt(metric.metrics, i));
          EXPECT_LE(sizes.size * sizes.stretching, 0.5 * (1.0 + 1e-6));
          if (isIsotropic) {
            EXPECT_NEAR(sizes.stretching, 1.0, 0.05);
          }
        }
      }
    }
  }
}

/// On a quadratic function, the optimal metric is constant, so regular elements have the error that was asked for.
TEST(SolutionMetricTest, TheErrorOfAQuadraticFunctionGivesItsMetric) {
  const VolumeMesh mesh = cubeOfTetrahedra(6, 0.1);
  const SymmetricTensor hessian{.xx = 50.0, .yy = 4.0, .zz = 1.0, .xy = 3.0, .xz = 0.0, .yz = 0.5};
  const Quadratic function{hessian, {1, 2, 3}, 4.0};
  const std::array<double, 4> unitErrors{0.15, std::sqrt(13.0 / 560.0),
                                         std::pow(109.0 / 184800.0, 0.25), 0.1875};
  for (std::size_t norm = 0; norm < 4; ++norm) {
    SolutionMetricOptions options;
    options.norm = static_cast<ErrorNorm>(norm);
    options.error = 0.002;
    options.growth = 0.0;
    options.maxSize = 100.0;
    const SolutionMetric metric = sized(mesh, oneField(atNodes(mesh, function)), options);
    EXPECT_NEAR(metric.errors[0], 0.002, 1e-8);
    // Volume 1: the norm is the error of every element, c times the square of the length in |H|.
    const double factor = unitErrors[norm] / 0.002;
    for (std::size_t i = 0; i < metric.frontSizes.sizes.size(); ++i)
      expectHessian(metric.metrics, i, hessian.scaledBy(factor), 1e-6 * factor);
  }
}

/// The constants of the norms, by quadrature over a regular tetrahedron with edges of length 1.
TEST(SolutionMetricTest, TheExpectedErrorIsThatOfARegularElement) {
  const std::array<Vec3, 4> corners{Vec3(0.0), Vec3(1, 0, 0), Vec3(0.5, std::sqrt(0.75), 0),
                                    Vec3(0.5, std::sqrt(0.75) / 3.0, std::sqrt(2.0 / 3.0))};
  constexpr int kSteps = 60;
  std::array<double, 3> sums{};
  double largest = 0.0;
  int samples = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; i + j < kSteps; ++j) {
      for (int k = 0; i + j + k < kSteps; ++k) {
        const std::array<double, 4> weights{(i + 0.25) / kSteps, (j + 0.25) / kSteps,
                                            (k + 0.25) / kSteps, 1.0 - (i + j + k + 0.75) / kSteps};
        Vec3 x(0.0);
        double interpolant = 0.0;
        for (std::size_t c = 0; c < 4; ++c) {
          x += weights[c] * corners[c];
          interpolant += weights[c] * 0.5 * glm::dot(corners[c], corners[c]);
        }
        const double error = interpolant - 0.5 * glm::dot(x, x);
        largest = std::max(largest, error);
        sums[0] += error;
        sums[1] += error * error;
        sums[2] += error * error * error * error;
        ++samples;
      }
    }
  }
  EXPECT_NEAR(sums[0] / samples, 3.0 / 20.0, 2e-3);
  EXPECT_NEAR(sums[1] / samples, 13.0 / 560.0, 5e-4);
  EXPECT_NEAR(sums[2] / samples, 109.0 / 184800.0, 3e-5);
  EXPECT_NEAR(largest, 3.0 / 16.0, 1e-3);
}

TEST(SolutionMetricTest, TheExpectedErrorFallsWithTheSecondOrder) {
  const VolumeMesh mesh = cubeOfTetrahedra(12, 0.1);
  const SolutionFields fields = oneField(atNodes(mesh, layers));
  std::vector<double> errors;
  for (const double elements : {1e4, 8e4, 64e4}) {
    SolutionMetricOptions options;
    options.elements = elements;
    options.growth = 0.0;
    errors.push_back(sized(mesh, fields, options).errors[0]);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.1);
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.1);
}

TEST(SolutionMetricTest, TheOptimalMetricHasTheLeastError) {
  const VolumeMesh mesh = cubeOfTetrahedra(12, 0.1);
  const SolutionFields fields = oneField(atNodes(mesh, layers));
  const auto errorWith = [&](bool isIsotropic) {
    SolutionMetricOptions options;
    options.elements = 1e5;
    options.growth = 0.0;
    options.isIsotropic = isIsotropic;
    return sized(mesh, fields, options).errors[0];
  };
  EXPECT_LT(errorWith(false), 0.7 * errorWith(true));
}

TEST(SolutionMetricTest, AConstantFieldAsksForOneSize) {
  const VolumeMesh mesh = cubeOfTetrahedra(4, 0.1);
  for (const bool isLinear : {false, true}) {
    const auto values =
        atNodes(mesh, [&](const Vec3& x) { return 1e6 + (isLinear ? 7.0 * x.x - x.z : 0.0); });
    SolutionMetricOptions options;
    options.elements = 5000.0;
    const SolutionMetric metric = sized(mesh, oneField(values), options);
    EXPECT_EQ(metric.hasVariation[0], 0);
    EXPECT_NEAR(metric.elements, 5000.0, 50.0);
    for (const double size : metric.frontSizes.sizes)
      EXPECT_NEAR(size, metric.frontSizes.sizes[0], 1e-12);
    options.elements = 0.0;
    options.error = 1e-3;
    options.maxSize = 0.4;
    const SolutionMetric largest = sized(mesh, oneField(values), options);
    for (std::size_t i = 0; i < largest.frontSizes.sizes.size(); ++i)
      EXPECT_NEAR(stretchedSizeOf(tensorAt(largest.metrics, i)).size, 0.4, 1e-12);
  }
}

TEST(SolutionMetricTest, SeveralFieldsAreAllFollowed) {
  const VolumeMesh mesh = cubeOfTetrahedra(10, 0.1);
  const auto inX = atNodes(mesh, [](const Vec3& x) { return std::tanh(20.0 * (x.x - 0.5)); });
  const auto inZ =
      atNodes(mesh, [](const Vec3& x) { return 1e-6 * std::tanh(20.0 * (x.z - 0.5)); });
  SolutionFields both{inX, {1, 1}, {0, 0}};
  both.values.insert(both.values.end(), inZ.begin(), inZ.end());
  SolutionMetricOptions options;
  options.elements = 50'000.0;
  const SolutionMetric metric = sized(mesh, both, options);
  EXPECT_NEAR(metric.elements / 50'000.0, 1.0, 0.05);
  std::array<double, 2> smallest{1.0, 1.0};
  for (std::size_t i = 0; i < metric.frontSizes.sizes.size(); ++i) {
    const SymmetricTensor own = tensorAt(metric.metrics, i);
    smallest[0] = std::min(smallest[0], 1.0 / std::sqrt(own.xx));
    smallest[1] = std::min(smallest[1], 1.0 / std::sqrt(own.zz));
  }
  EXPECT_NEAR(smallest[0] / smallest[1], 1.0, 0.3);
}

TEST(SolutionMetricTest, TheComponentsOfAVectorMayBeRotated) {
  const VolumeMesh mesh = cubeOfTetrahedra(6, 0.1);
  SolutionFields fields{{}, {2}, {0}};
  SolutionFields rotated = fields;
  for (std::size_t i = 0; i < mesh.points.size() / 3; ++i) {
    const Vec3 x = nodePosition(mesh, i);
    const double u = std::sin(4.0 * x.x);
    const double v = x.y * x.y * x.z;
    fields.values.insert(fields.values.end(), {u, v});
    rotated.values.insert(rotated.values.end(), {0.6 * u - 0.8 * v, 0.8 * u + 0.6 * v});
  }
  SolutionMetricOptions options;
  options.elements = 3000.0;
  const SolutionMetric a = sized(mesh, fields, options);
  const SolutionMetric b = sized(mesh, rotated, options);
  for (std::size_t i = 0; i < a.metrics.size(); ++i)
    ASSERT_NEAR(a.metrics[i], b.metrics[i], 1e-6 * (1.0 + std::fabs(a.metrics[i])));
}

/// The front makes 6 sqrt 2 elements per cube of its size, the metric asks for 10 per unit of complexity.
TEST(SolutionMetricTest, SizesOfTheFrontAreThoseOfTheMetric) {
  const VolumeMesh mesh = cubeOfTetrahedra(10, 0.1);
  SolutionMetricOptions options;
  options.elements = 20'000.0;
  const SolutionMetric metric = sized(mesh, oneField(atNodes(mesh, layers)), options);
  const FrontSizes& front = metric.frontSizes;
  ASSERT_EQ(front.secondStretchings.size(), front.sizes.size());
  const double perLength = std::cbrt(std::sqrt(72.0) / 10.0);
  const auto at = [](const std::vector<double>& values, std::size_t i) {
    return Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  for (std::size_t i = 0; i < front.sizes.size(); ++i) {
    const SymmetricTensor own = tensorAt(metric.metrics, i);
    const double size = front.sizes[i];
    const Vec3 first = size * front.stretchings[i] * at(front.directions, i);
    const Vec3 second = size * front.secondStretchings[i] * at(front.secondDirections, i);
    const Vec3 across = size * glm::cross(at(front.directions, i), at(front.secondDirections, i));
    for (const Vec3& edge : {first, second, across})
      EXPECT_NEAR(metricLength(own, edge), perLength, 1e-6);
    EXPECT_GE(front.stretchings[i], front.secondStretchings[i]);
    EXPECT_GE(front.secondStretchings[i], 1.0);
  }
}

/// Metrics that are long in one direction need one stretching.
TEST(SolutionMetricTest, OneStretchingIsEnoughForLongElements) {
  std::vector<double> metrics(6 * 5);
  Random random(4833);
  for (std::size_t i = 0; i < 5; ++i) {
    const SymmetricTensor metric =
        metricOf({.size = 0.2, .stretching = 7.0, .direction = random.inBox()});
    putTensor(metrics, i, metric);
  }
  const auto converted = [&] {
    FrontSizer sizer(metrics);
    while (!sizer.advance(1)) {
    }
    return sizer.result();
  };
  EXPECT_TRUE(converted().secondStretchings.empty());
  EXPECT_NEAR(converted().stretchings[3], 7.0, 1e-9);
  EXPECT_NEAR(converted().sizes[3], 0.2 * std::cbrt(std::sqrt(72.0) / 10.0), 1e-12);
  putTensor(metrics, 4, metricOf({.size = 0.2, .stretching = 7.0, .secondStretching = 1.01}));
  EXPECT_NEAR(converted().secondStretchings[4], 1.01, 1e-9);
  EXPECT_EQ(converted().secondDirections.size(), 15U);
}

TEST(SolutionMetricTest, MetricsThatAreNotPositiveAreNamed) {
  std::vector<double> metrics;
  for (int i = 0; i < 20; ++i) metrics.insert(metrics.end(), {4.0, 0.0, 0.0, 4.0, 0.0, 4.0});
  const auto converted = [&] {
    FrontSizer sizer(metrics);
    while (!sizer.advance(1)) {
    }
    return sizer.result();
  };
  EXPECT_EQ(converted().invalidNode, FrontSizes::kNoNode);
  EXPECT_EQ(converted().sizes.size(), 20U);
  EXPECT_NEAR(converted().sizes[7], 0.5 * std::cbrt(std::sqrt(72.0) / 10.0), 1e-15);
  metrics[6 * 12 + 1] = 4.0;
  EXPECT_EQ(converted().invalidNode, 12U);
  EXPECT_TRUE(converted().sizes.empty());
  metrics[6 * 3] = std::nan("");
  EXPECT_EQ(converted().invalidNode, 3U);
}

TEST(SolutionMetricTest, LimitsThatExcludeTheNumberAreKept) {
  const VolumeMesh mesh = cubeOfTetrahedra(6, 0.1);
  SolutionMetricOptions options;
  options.elements = 1e7;
  options.minSize = 0.1;
  const SolutionMetric metric = sized(mesh, oneField(atNodes(mesh, layers)), options);
  EXPECT_LE(metric.elements, 10'000.0 * (1.0 + 1e-9));
  EXPECT_GT(metric.elements, 5000.0);
}

}  // namespace
}  // namespace tetrafront::testing
