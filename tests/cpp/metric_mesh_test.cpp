/// Metrics at the nodes of meshes.

#include "metric/mesh_metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "metric/metric.h"
#include "support/random.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

template <class Start>
auto finished(const Start& start) {
  Job job(start);
  return job.finish();
}

MeshEdges edgesOfMesh(const VolumeMesh& mesh) {
  return finished([&](Work& work) { return edgesOf(work, mesh); });
}

Vec3 positionOf(const VolumeMesh& mesh, std::uint32_t node) {
  return {mesh.points[3 * node], mesh.points[3 * node + 1], mesh.points[3 * node + 2]};
}

std::vector<double> uniformMetrics(const VolumeMesh& mesh, const SymmetricTensor& metric) {
  std::vector<double> metrics(2 * mesh.points.size());
  for (std::size_t i = 0; i < metrics.size() / 6; ++i) putTensor(metrics, i, metric);
  return metrics;
}

void limit(const VolumeMesh& mesh, double growth, std::vector<double>& metrics) {
  const MeshEdges edges = edgesOfMesh(mesh);
  Job job([&](Work& work) { return limitGrowth(work, mesh, edges, growth, metrics); });
  job.finish();
}

TEST(MeshMetricTest, AllEdgesHaveLengthOneInTheImpliedMetric) {
  Random random(4821);
  for (int i = 0; i < 300; ++i) {
    const Vec3 stretch(1.0, i % 3 == 0 ? 0.01 : 1.0, 1.0);
    const std::array<Vec3, 4> corners{random.inBox() * stretch, random.inBox() * stretch,
                                      random.inBox() * stretch, random.inBox() * stretch};
    const SymmetricTensor metric = impliedMetric(corners);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b)
        EXPECT_NEAR(metricLength(metric, corners[b] - corners[a]), 1.0, 1e-8);
    }
  }
}

TEST(MeshMetricTest, ADegenerateTetrahedronImpliesNothing) {
  const SymmetricTensor metric =
      impliedMetric({Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)});
  EXPECT_EQ(metric.xx + metric.yy + metric.zz, 0.0);
}

TEST(MeshMetricTest, TheImpliedComplexityIsTheNumberOfElementsTimesTheirUnitVolume) {
  for (const double jitter : {0.0, 0.1}) {
    const VolumeMesh mesh = cubeOfTetrahedra(6, jitter);
    const auto metrics = finished([&](Work& work) { return impliedMetrics(work, mesh); });
    const double perElement = std::sqrt(2.0) / 12.0;
    const double expected = perElement * static_cast<double>(mesh.tetrahedra.size()) / 4.0;
    EXPECT_NEAR(complexityOf(mesh, metrics) / expected, 1.0, jitter == 0.0 ? 1e-9 : 0.1);
  }
}

TEST(MeshMetricTest, TheImpliedMetricFollowsAnAffineMap) {
  VolumeMesh mesh = cubeOfTetrahedra(4, 0.1);
  const auto before = finished([&](Work& work) { return impliedMetrics(work, mesh); });
  for (double& coordinate : mesh.points) coordinate *= 0.25;
  const auto after = finished([&](Work& work) { return impliedMetrics(work, mesh); });
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NEAR(after[i], 16.0 * before[i], 1e-9 * 16.0 * 50.0);
}

TEST(MeshMetricTest, TheComplexityOfAUniformMetricIsVolumePerCube) {
  const VolumeMesh mesh = cubeOfTetrahedra(5, 0.15);
  const auto metrics = uniformMetrics(mesh, metricOf({.size = 0.1, .stretching = 2.0}));
  EXPECT_NEAR(complexityOf(mesh, metrics), 500.0, 1e-9);
}

TEST(MeshMetricTest, TheComplexityWithinATetrahedronIsTheIntegralOfAnExponential) {
  const std::array<Vec3, 4> unit{Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  EXPECT_NEAR(complexityWithin(unit, {7.0, 7.0, 7.0, 7.0}), 7.0 / 6.0, 1e-14);
  // With one corner far denser: the integral of e^(sx) over the unit tetrahedron.
  const double s = 7.0;
  const double known = (std::exp(s) - 1.0 - s - 0.5 * s * s) / (s * s * s);
  EXPECT_NEAR(complexityWithin(unit, {1.0, 1.0, std::exp(s), 1.0}) / known, 1.0, 1e-13);
  // With logarithms 0, h, 2 h and 3 h, the divided difference is (e^h - 1)^3 / (6 h^3).
  for (const double h : {0.01, 0.3, 0.4, 0.7, 3.0}) {
    const double ofSteps = std::pow(std::expm1(h), 3) / (6.0 * h * h * h);
    const std::array<double, 4> densities{1.0, std::exp(h), std::exp(2.0 * h), std::exp(3.0 * h)};
    EXPECT_NEAR(complexityWithin(unit, densities) / ofSteps, 1.0, 1e-11) << h;
    std::array<double, 4> rotated = densities;
    std::ranges::rotate(rotated, rotated.begin() + 1);
    EXPECT_EQ(complexityWithin(unit, densities), complexityWithin(unit, rotated)) << h;
  }
}

TEST(MeshMetricTest, EveryEdgeIsListedOnce) {
  const VolumeMesh mesh = cubeOfTetrahedra(3, 0.1);
  std::set<std::array<std::uint32_t, 2>> expected;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) {
        const auto [low, high] = std::minmax(mesh.tetrahedra[t + a], mesh.tetrahedra[t + b]);
        expected.insert({low, high});
      }
    }
  }
  EXPECT_EQ(edgesOfMesh(mesh), MeshEdges(expected.begin(), expected.end()));
}

TEST(MeshMetricTest, NoSizeGrowsFasterThanAllowed) {
  Random random(4822);
  const VolumeMesh mesh = cubeOfTetrahedra(6, 0.15);
  std::vector<double> metrics(2 * mesh.points.size());
  for (std::size_t i = 0; i < metrics.size() / 6; ++i) {
    putTensor(metrics, i,
              metricOf({.size = random.between(0.02, 0.5),
                        .stretching = random.between(1.0, 20.0),
                        .direction = random.inBox(),
                        .secondStretching = random.between(1.0, 20.0),
                        .secondDirection = random.inBox()}));
  }
  const std::vector<double> before = metrics;
  limit(mesh, 0.4, metrics);
  for (const auto& [a, b] : edgesOfMesh(mesh)) {
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, a}}) {
      const SymmetricTensor limiting = tensorAt(metrics, from);
      const Vec3 edge = positionOf(mesh, to) - positionOf(mesh, from);
      const double growth = 1.0 + 0.4 * metricLength(limiting, edge);
      for (int k = 0; k < 5; ++k) {
        const Vec3 direction = random.inBox();
        EXPECT_GE(metricLength(tensorAt(metrics, to), direction) * (1.0 + 1e-3),
                  metricLength(limiting, direction) / growth);
      }
    }
  }
  for (std::size_t i = 0; i < metrics.size() / 6; ++i)
    EXPECT_TRUE(isNowhereBelow(tensorAt(metrics, i), tensorAt(before, i), 1e-9));
}

TEST(MeshMetricTest, IsotropicSizesGrowWithTheDistance) {
  const VolumeMesh mesh = cubeOfTetrahedra(8);
  std::vector<double> metrics = uniformMetrics(mesh, metricOf({.size = 10.0}));
  putTensor(metrics, 0, metricOf({.size = 0.01}));
  limit(mesh, 0.3, metrics);
  for (std::uint32_t i = 0; i < metrics.size() / 6; ++i) {
    const double distance = glm::length(positionOf(mesh, i) - positionOf(mesh, 0));
    const double size = stretchedSizeOf(tensorAt(metrics, i)).size;
    // Kuhn's division has edges along the axes and diagonals: a way along them is at most 1.13 times as long.
    EXPECT_GE(size, 0.01 + 0.3 * distance - 1e-3);
    EXPECT_LE(size, 0.01 + 0.3 * 1.75 * distance + 1e-3);
  }
}

/// A layer of aspect 100 at z = 0.5, and sizes of 0.3 elsewhere.
TEST(MeshMetricTest, AThinLayerStaysThin) {
  const VolumeMesh mesh = cubeOfTetrahedra(8);
  std::vector<double> metrics = uniformMetrics(mesh, metricOf({.size = 0.3}));
  const SymmetricTensor layer = metricOf({.size = 0.003,
                                          .stretching = 100.0,
                                          .direction = {1, 0, 0},
                                          .secondStretching = 100.0,
                                          .secondDirection = {0, 1, 0}});
  for (std::uint32_t i = 0; i < metrics.size() / 6; ++i)
    if (mesh.points[3 * i + 2] == 0.5) putTensor(metrics, i, layer);
  limit(mesh, 0.3, metrics);
  for (std::uint32_t i = 0; i < metrics.size() / 6; ++i) {
    const SymmetricTensor metric = tensorAt(metrics, i);
    const double distance = std::fabs(mesh.points[3 * i + 2] - 0.5);
    EXPECT_NEAR(1.0 / std::sqrt(metric.zz), std::min(0.3, 0.003 + 0.3 * distance), 1e-3);
    EXPECT_NEAR(1.0 / std::sqrt(metric.xx), 0.3, 1e-3);
    EXPECT_NEAR(1.0 / std::sqrt(metric.yy), 0.3, 1e-3);
  }
}

}  // namespace
}  // namespace tetrafront::testing
