/// A mesh adapted to a metric is valid, keeps its boundary, and has unit edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "metric/mesh_metric.h"
#include "support/mesh_validator.h"
#include "support/slices.h"
#include "support/tet_grids.h"
#include "tetrafront/mesh_adaptation.h"

namespace tetrafront::testing {
namespace {

/// The side of the unit cube on which all three positions lie, 0 to 5.
std::uint32_t sideOf(const std::vector<double>& points, const std::uint32_t* nodes) {
  for (std::uint32_t side = 0; side < 6; ++side) {
    const auto isOn = [&](std::uint32_t node) { return points[3 * node + side / 2] == side % 2; };
    if (isOn(nodes[0]) && isOn(nodes[1]) && isOn(nodes[2])) return side;
  }
  return 6;
}

/// The unit cube with its sides as patches.
AdaptInput cubeInput(int n) {
  const VolumeMesh mesh = cubeOfTetrahedra(n);
  AdaptInput input;
  input.points = mesh.points;
  input.tetrahedra = mesh.tetrahedra;
  input.triangles = surfaceOf(mesh, surfaceNodeCount(n)).triangles;
  for (std::size_t t = 0; t < input.triangles.size(); t += 3)
    input.trianglePatch.push_back(10 + sideOf(input.points, &input.triangles[t]));
  return input;
}

/// Sizes of a layer across the middle of the cube, thin along x.
MetricMesh layer(double thin, double wide) {
  const VolumeMesh grid = cubeOfTetrahedra(8);
  MetricMesh background{grid.points, grid.tetrahedra, {}};
  for (std::size_t i = 0; i < grid.points.size(); i += 3) {
    const double across = thin + 0.25 * std::fabs(grid.points[i] - 0.5);
    const double along = 1.0 / (wide * wide);
    background.metrics.insert(background.metrics.end(),
                              {1.0 / (across * across), 0.0, 0.0, along, 0.0, along});
  }
  return background;
}

MeshAdaptation adapted(const AdaptInput& input, const MetricMesh& background,
                       std::uint32_t budget = 1U << 20) {
  MeshAdapter adapter(input, background, {});
  slicesOf(adapter, budget);
  return adapter.result();
}

/// Checks a result with arithmetic of its own.
void expectValid(const MeshAdaptation& made) {
  ASSERT_TRUE(made.diagnostics.empty());
  ASSERT_FALSE(made.tetrahedra.empty());
  VolumeMesh mesh;
  mesh.points = made.points;
  mesh.tetrahedra = made.tetrahedra;
  mesh.regions = made.regions;
  SurfaceMesh surface;
  surface.triangles = made.triangles;
  std::uint32_t nodes = 0;
  for (const std::uint32_t node : made.triangles) nodes = std::max(nodes, node + 1);
  surface.points.assign(made.points.begin(), made.points.begin() + 3 * std::ptrdiff_t{nodes});
  EXPECT_EQ(complaintAbout(mesh, surface), "");
}

double areaOf(const MeshAdaptation& made, std::size_t triangle) {
  std::array<std::array<double, 3>, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      p[k][i] = made.points[3 * made.triangles[3 * triangle + k] + i];
  }
  double squared = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double c =
        (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
    squared += c * c;
  }
  return 0.5 * std::sqrt(squared);
}

TEST(MeshAdaptation, FollowsALayerAcrossACube) {
  const MeshAdaptation made = adapted(cubeInput(3), layer(0.03, 0.2));
  expectValid(made);
  EXPECT_GT(made.after.unitEdges, 0.99);
  EXPECT_GT(made.after.leastQuality, 0.4);
  EXPECT_GT(made.after.meanQuality, 0.75);
  EXPECT_LT(made.before.unitEdges, 0.5);
  EXPECT_EQ(made.after.tetrahedra, made.regions.size());
  std::uint32_t counted = 0;
  for (const std::uint32_t count : made.after.lengths) counted += count;
  EXPECT_EQ(counted, made.after.edges);
}

/// Unit edges alone would be kept by meshes with a third more elements.
TEST(MeshAdaptation, HasAboutAsManyElementsAsTheMetricAsksFor) {
  for (const double thin : {0.02, 0.1}) {
    const MetricMesh background = layer(thin, 0.2);
    VolumeMesh grid;
    grid.points = background.points;
    grid.tetrahedra = background.tetrahedra;
    const double wanted = kElementsPerComplexity * complexityOf(grid, background.metrics);
    const MeshAdaptation made = adapted(cubeInput(6), background);
    expectValid(made);
    EXPECT_NEAR(made.after.tetrahedra / wanted, 1.0, 0.05) << thin;
    EXPECT_GT(made.after.unitEdges, 0.99) << thin;
    EXPECT_GT(made.after.peakedEdges, 0.75) << thin;
  }
}

TEST(MeshAdaptation, KeepsThePatchesOfACube) {
  const MeshAdaptation made = adapted(cubeInput(2), layer(0.1, 0.3));
  expectValid(made);
  std::map<std::uint32_t, double> areas;
  for (std::size_t t = 0; t < made.trianglePatch.size(); ++t) {
    const std::uint32_t side = sideOf(made.points, &made.triangles[3 * t]);
    EXPECT_EQ(made.trianglePatch[t], 10 + side);
    areas[side] += areaOf(made, t);
  }
  ASSERT_EQ(areas.size(), 6U);
  for (const auto& [side, area] : areas) EXPECT_NEAR(area, 1.0, 1e-12) << side;
}

TEST(MeshAdaptation, CoarsensAFineMesh) {
  const MeshAdaptation made = adapted(cubeInput(8), layer(0.4, 0.5));
  expectValid(made);
  EXPECT_LT(made.after.tetrahedra, made.before.tetrahedra / 4);
  EXPECT_GT(made.after.unitEdges, 0.9);
}

TEST(MeshAdaptation, DoesNotDependOnTheSlices) {
  const MeshAdaptation one = adapted(cubeInput(2), layer(0.1, 0.3));
  const MeshAdaptation other = adapted(cubeInput(2), layer(0.1, 0.3), 7);
  EXPECT_EQ(one.points, other.points);
  EXPECT_EQ(one.tetrahedra, other.tetrahedra);
}

TEST(MeshAdaptation, IsValidWhereverItIsStopped) {
  std::size_t partial = 0;
  for (const int calls : {1, 20, 60, 150, 400}) {
    MeshAdapter adapter(cubeInput(2), layer(0.1, 0.3), {});
    for (int i = 0; i < calls; ++i) adapter.advance(100);
    adapter.stop();
    while (!adapter.advance(100)) {
    }
    partial += adapter.result().isPartial ? 1 : 0;
    expectValid(adapter.result());
  }
  EXPECT_GE(partial, 3U);
}

TEST(MeshAdaptation, KeepsTheInterfaceOfTwoRegions) {
  AdaptInput input = cubeInput(4);
  for (std::size_t t = 0; t < input.tetrahedra.size(); t += 4) {
    double x = 0.0;
    for (std::size_t k = 0; k < 4; ++k) x += 0.25 * input.points[3 * input.tetrahedra[t + k]];
    input.regions.push_back(x < 0.5 ? 7 : 9);
  }
  const MeshAdaptation made = adapted(input, layer(0.15, 0.3));
  ASSERT_TRUE(made.diagnostics.empty());
  std::map<std::uint32_t, double> volumes;
  for (std::size_t t = 0; t < made.regions.size(); ++t) {
    std::array<std::array<double, 3>, 4> p{};
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < 3; ++i) p[k][i] = made.points[3 * made.tetrahedra[4 * t + k] + i];
    }
    double volume = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      volume += (p[3][k] - p[0][k]) * ((p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) -
                                       (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]));
    }
    EXPECT_GT(volume, 0.0);
    volumes[made.regions[t]] += volume / 6.0;
  }
  ASSERT_EQ(volumes.size(), 2U);
  EXPECT_NEAR(volumes.at(7), 0.5, 1e-12);
  EXPECT_NEAR(volumes.at(9), 0.5, 1e-12);
}

/// A cylinder of radius 1 about the z axis, between z = 0 (patch 1) and z = 1 (patch 2), with 4 n edges around it (patch 3).
AdaptInput cylinderInput(int n) {
  AdaptInput input = cubeInput(n);
  for (std::size_t i = 0; i < input.points.size(); i += 3) {
    const double x = 2.0 * input.points[i] - 1.0;
    const double y = 2.0 * input.points[i + 1] - 1.0;
    const double radius = std::max(std::fabs(x), std::fabs(y));
    const double angle = radius == 0.0                  ? 0.0
                         : std::fabs(x) >= std::fabs(y) ? 0.25 * M_PI * y / x
                                                        : 0.25 * M_PI * (2.0 - x / y);
    const double sign = radius == 0.0 ? 0.0 : (std::fabs(x) >= std::fabs(y) ? x : y) / radius;
    input.points[i] = sign * radius * std::cos(angle);
    input.points[i + 1] = sign * radius * std::sin(angle);
  }
  for (std::uint32_t& patch : input.trianglePatch) patch = patch == 14 ? 1 : patch == 15 ? 2 : 3;
  return input;
}

/// The metric of a layer inside the wall of the cylinder, thin along the radius, at the nodes of a mesh.
MetricMesh wallLayer(const std::vector<double>& points,
                     const std::vector<std::uint32_t>& elements) {
  MetricMesh background{points, elements, {}};
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const double r = std::hypot(points[i], points[i + 1]);
    const double c = r == 0.0 ? 1.0 : points[i] / r;
    const double s = r == 0.0 ? 0.0 : points[i + 1] / r;
    const double thin = 0.05 + 0.3 * (1.0 - r);
    const double across = 1.0 / (thin * thin);
    const double along = 1.0 / (0.3 * 0.3);
    background.metrics.insert(background.metrics.end(),
                              {across * c * c + along * s * s, (across - along) * c * s, 0.0,
                               across * s * s + along * c * c, 0.0, along});
  }
  return background;
}

/// Number of nodes of one mesh at exactly the position of a node of another.
std::size_t countCommon(const std::vector<double>& one, const std::vector<double>& other) {
  std::map<std::array<double, 3>, int> known;
  for (std::size_t i = 0; i < one.size(); i += 3) known[{one[i], one[i + 1], one[i + 2]}] = 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < other.size(); i += 3)
    count += known.count({other[i], other[i + 1], other[i + 2]});
  return count;
}

/// Largest distance of the wall's nodes from the wall of the given cylinder, whose edges are chords.
double worstOnWall(const MeshAdaptation& made, int n) {
  const double half = 0.25 * M_PI / n;
  double worst = 0.0;
  for (std::size_t c = 0; c < made.triangles.size(); ++c) {
    if (made.trianglePatch[c / 3] != 3) continue;
    const double* const at = &made.points[3 * made.triangles[c]];
    double turn = std::fmod(std::atan2(at[1], at[0]) + 2.0 * M_PI, 2.0 * half) - half;
    const double chord = std::cos(half) / std::cos(turn);
    worst = std::max(worst, std::fabs(std::hypot(at[0], at[1]) - chord));
  }
  return worst;
}

TEST(MeshAdaptation, ConvergesOnACurvedBodyWhileTheMetricsStandAtItsNodes) {
  constexpr int kEdges = 6;
  const AdaptInput model = cylinderInput(kEdges);
  MeshAdaptation made = adapted(model, wallLayer(model.points, model.tetrahedra));
  std::vector<double> kept;
  for (int cycle = 0; cycle < 4; ++cycle) {
    const MeshAdaptation next = adapted(model, wallLayer(made.points, made.tetrahedra));
    expectValid(next);
    EXPECT_LT(worstOnWall(next, kEdges), 1e-9);
    kept.push_back(static_cast<double>(countCommon(made.points, next.points)) /
                   static_cast<double>(next.points.size() / 3));
    made = next;
  }
  EXPECT_GT(made.after.unitEdges, 0.99);
  EXPECT_GT(made.after.leastQuality, 0.3);
  EXPECT_GT(kept[3], 0.75);
  EXPECT_GT(kept[3], kept[0]);
}

TEST(MeshAdaptation, ReachesSizesThatOnlyFewElementsOfAnAdaptedMeshHaveNot) {
  const AdaptInput model = cubeInput(3);
  const MeshAdaptation even = adapted(model, layer(0.2, 0.2));
  MetricMesh background{even.points, even.tetrahedra, even.metrics};
  constexpr double kFine = 0.008;
  std::fill_n(background.metrics.begin(), 6, 0.0);
  for (const std::size_t i : {0U, 3U, 5U}) background.metrics[i] = 1.0 / (kFine * kFine);
  const MeshAdaptation made = adapted(model, background);
  expectValid(made);
  EXPECT_GT(made.after.unitEdges, 0.97);
  EXPECT_GT(made.after.tetrahedra, 2 * even.after.tetrahedra);
}

TEST(MeshAdaptation, TakesSizesFromABackgroundOfAnotherBody) {
  const AdaptInput model = cubeInput(3);
  MetricMesh wide = layer(0.05, 0.25);
  for (double& x : wide.points) x = 0.5 + 1.2 * (x - 0.5);
  const MeshAdaptation made = adapted(model, wide);
  expectValid(made);
  for (const double x : made.points) EXPECT_TRUE(x >= 0.0 && x <= 1.0);
  EXPECT_GT(made.after.unitEdges, 0.99);
}

TEST(MeshAdaptation, RefusesWhatIsNoMetric) {
  MetricMesh background = layer(0.1, 0.3);
  background.metrics[6 * 5] = -1.0;
  const MeshAdaptation made = adapted(cubeInput(2), background);
  EXPECT_FALSE(made.isReadable);
  EXPECT_TRUE(made.tetrahedra.empty());
}

TEST(MeshAdaptation, NamesABackgroundElementWithoutVolume) {
  MetricMesh background = layer(0.1, 0.3);
  background.tetrahedra[4 * 7 + 1] = background.tetrahedra[4 * 7];
  const MeshAdaptation made = adapted(cubeInput(2), background);
  ASSERT_FALSE(made.diagnostics.empty());
  ASSERT_FALSE(made.diagnostics[0].entities.empty());
  EXPECT_EQ(made.diagnostics[0].entities[0].kind, EntityKind::kBackgroundTetrahedron);
  EXPECT_EQ(made.diagnostics[0].entities[0].index, 7U);
  EXPECT_TRUE(made.tetrahedra.empty());
}

}  // namespace
}  // namespace tetrafront::testing
