/// The statistics of a mesh, compared with slow counts and with meshes whose statistics are known
/// by hand.

#include "quality/quality_analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "support/models.h"
#include "support/shapes.h"
#include "support/slow_dihedral.h"
#include "tetrafront/mesher.h"

namespace tetrafront::testing {
namespace {

constexpr double kSize = 0.2;

MeshRun finished(MeshRun run) {
  while (run.advance(10'000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return run;
}

QualityStatistics analyse(const VolumeMesh& mesh, const SurfaceMesh& surface,
                          const SizeField& field = SizeField::uniform(kSize),
                          std::uint32_t budget = 1000) {
  QualityAnalysis analysis(mesh, surface, field);
  while (!analysis.advance(budget)) {
  }
  return analysis.statistics();
}

std::array<Vec3, 4> cornersOf(const VolumeMesh& mesh, std::size_t t) {
  std::array<Vec3, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) {
    const double* at = &mesh.points[3 * std::size_t{mesh.tetrahedra[4 * t + k]}];
    corners[k] = {at[0], at[1], at[2]};
  }
  return corners;
}

std::array<double, 6> slowDihedrals(const std::array<Vec3, 4>& p) {
  return {slowDihedral(p[0], p[1], p[2], p[3]), slowDihedral(p[0], p[2], p[1], p[3]),
          slowDihedral(p[0], p[3], p[1], p[2]), slowDihedral(p[1], p[2], p[0], p[3]),
          slowDihedral(p[1], p[3], p[0], p[2]), slowDihedral(p[2], p[3], p[0], p[1])};
}

template <std::size_t N>
std::uint32_t total(const std::array<std::uint32_t, N>& bins) {
  return std::accumulate(bins.begin(), bins.end(), 0U);
}

TEST(QualityAnalysis, AgreesWithASlowCount) {
  const SurfaceMesh surface = geodesicSphere(6);
  const MeshRun run = finished(MeshRun(surface.points, surface.triangles, {}));
  const VolumeMesh mesh = run.volume();
  const QualityStatistics statistics = analyse(mesh, run.surface());
  ASSERT_EQ(statistics.regions.size(), 1U);
  const RegionStatistics& region = statistics.regions[0];
  std::array<std::uint32_t, kDihedralBins> dihedral{};
  std::array<std::uint32_t, kDihedralBins> smallest{};
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  double worst = 180.0;
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; ++t) {
    const auto corners = cornersOf(mesh, t);
    const auto angles = slowDihedrals(corners);
    const auto bin = [](double angle) { return static_cast<std::size_t>(angle / 5.0); };
    for (const double angle : angles) ++dihedral[bin(angle)];
    const double least = *std::min_element(angles.begin(), angles.end());
    ++smallest[bin(least)];
    worst = std::min(worst, least);
    volume += measureTetrahedron(corners[0], corners[1], corners[2], corners[3]).volume;
    const std::uint32_t* nodes = &mesh.tetrahedra[4 * t];
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) edges.insert(std::minmax(nodes[i], nodes[j]));
    }
  }
  EXPECT_EQ(region.dihedral, dihedral);
  EXPECT_EQ(region.smallestDihedral, smallest);
  EXPECT_EQ(total(region.radiusRatio), mesh.tetrahedra.size() / 4);
  EXPECT_NEAR(region.volume, volume, 1e-9 * volume);
  double sum = 0.0;
  double near = 0.0;
  std::array<std::uint32_t, kEdgeBins> lengths{};
  for (const auto& [a, b] : edges) {
    const auto at = [&](std::uint32_t n) {
      return Vec3(mesh.points[3 * n], mesh.points[3 * n + 1], mesh.points[3 * n + 2]);
    };
    const double length = glm::length(at(a) - at(b)) / kSize;
    sum += length;
    near += length >= 0.6 && length <= 1.5 ? 1.0 : 0.0;
    ++lengths[std::min<std::size_t>(kEdgeBins - 1, static_cast<std::size_t>(length * 10.0))];
  }
  EXPECT_EQ(region.edge, lengths);
  EXPECT_NEAR(statistics.meanEdge, sum / static_cast<double>(edges.size()), 1e-9);
  EXPECT_NEAR(statistics.edgesNearTarget, near / static_cast<double>(edges.size()), 1e-12);
  ASSERT_EQ(statistics.worst.size(), 10U);
  const auto listed = std::min_element(
      statistics.worst.begin(), statistics.worst.end(),
      [](const auto& p, const auto& q) { return p.smallestDihedral < q.smallestDihedral; });
  const auto corners = cornersOf(mesh, listed->tetrahedron);
  const auto angles = slowDihedrals(corners);
  EXPECT_NEAR(listed->smallestDihedral, *std::min_element(angles.begin(), angles.end()), 1e-9);
  EXPECT_LT(
      glm::length(listed->centroid - 0.25 * (corners[0] + corners[1] + corners[2] + corners[3])),
      1e-12);
  EXPECT_EQ(statistics.outOfRange,
            0U);  // the sphere's boundary limits no element, and no element is out of range
  EXPECT_EQ(statistics.limitedByBoundary, 0U);
}

TEST(QualityAnalysis, DoesNotDependOnHowTheWorkIsSliced) {
  const SurfaceMesh surface = nestedSpheres(3, 4);
  const MeshRun run = finished(MeshRun(surface.points, surface.triangles, {}));
  const SizeField field = SizeField::uniform(kSize);
  const QualityStatistics whole = analyse(run.volume(), run.surface(), field, 10'000'000);
  const QualityStatistics slices = analyse(run.volume(), run.surface(), field, 7);
  EXPECT_EQ(whole.regions.size(), 2U);
  for (std::size_t r = 0; r < whole.regions.size(); ++r) {
    EXPECT_EQ(whole.regions[r].region, r);
    EXPECT_EQ(whole.regions[r].dihedral, slices.regions[r].dihedral);
    EXPECT_EQ(whole.regions[r].edge, slices.regions[r].edge);
    EXPECT_EQ(total(whole.regions[r].dihedral), 6 * whole.regions[r].tetrahedra);
  }
  EXPECT_EQ(whole.outOfRange, slices.outOfRange);
  EXPECT_EQ(whole.worst[0].tetrahedron, slices.worst[0].tetrahedron);
  EXPECT_EQ(whole.smallest.tetrahedron, slices.smallest.tetrahedron);
}

/// A wedge of 12 degrees in one element: its sharp edge belongs to two boundary triangles.
TEST(QualityAnalysis, CountsAnElementAtASharpBoundaryEdgeAsLimited) {
  const double angle = 12.0 * std::numbers::pi / 180.0;
  const SurfaceMesh wedge = tetrahedronSurface({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.5, 1.0, 0.0),
                                                Vec3(0.5, std::cos(angle), std::sin(angle))});
  VolumeMesh mesh;
  mesh.points = wedge.points;
  mesh.tetrahedra = {0, 1, 2, 3};
  mesh.regions = {0};
  const QualityStatistics statistics = analyse(mesh, wedge);
  EXPECT_EQ(statistics.limitedByBoundary, 1U);
  EXPECT_EQ(statistics.outOfRange, 0U);
  ASSERT_EQ(statistics.worstLimited.size(), 1U);
  EXPECT_NEAR(statistics.worstLimited[0].smallestDihedral, 12.0, 1e-9);
  // The same element away from the boundary.
  const QualityStatistics inner = analyse(mesh, SurfaceMesh{});
  EXPECT_EQ(inner.limitedByBoundary, 0U);
  EXPECT_EQ(inner.outOfRange, 1U);
}

/// An element whose base is a boundary triangle and a needle, or that shares an edge with one.
TEST(QualityAnalysis, CountsAnElementAtABoundaryNeedleAsLimited) {
  VolumeMesh mesh;
  mesh.points = {0, 0, 0, 1, 0, 0, 0.5, 0.05, 0, 0.5, 0.3, 0.8};
  mesh.tetrahedra = {0, 1, 2, 3};
  mesh.regions = {0};
  SurfaceMesh base;
  base.points = mesh.points;
  base.triangles = {0, 2, 1};
  EXPECT_EQ(analyse(mesh, base).limitedByBoundary, 1U);
  EXPECT_EQ(analyse(mesh, base).limitedByNeedles, 1U);
  // Shares only an edge with the needle.
  mesh.points = {0, 0, 0, 1, 0, 0, 0.5, 0.05, 0, 0.5, 0.3, 0.8, 0.5, 0.3, 0.3};
  mesh.tetrahedra = {0, 1, 4, 3};
  EXPECT_EQ(analyse(mesh, base).limitedByNeedles, 1U);
  // Shares only a node with it.
  mesh.points.insert(mesh.points.end(), {0.52, 0.32, 0.5});
  mesh.tetrahedra = {0, 3, 4, 5};
  EXPECT_EQ(analyse(mesh, base).outOfRange, 1U);
  EXPECT_EQ(analyse(mesh, base).limitedByNeedles, 0U);
  // Not a needle, and only one triangle; the fourth node is free.
  mesh.points = base.points;
  std::swap_ranges(mesh.points.begin() + 6, mesh.points.begin() + 9, mesh.points.begin() + 9);
  mesh.tetrahedra = {0, 1, 3, 2};
  base.points.assign(mesh.points.begin(), mesh.points.begin() + 9);
  base.triangles = {0, 1, 2};
  EXPECT_EQ(analyse(mesh, base).limitedByBoundary, 0U);
}

/// A wedge of 24 degrees in two elements: neither has both triangles of the sharp edge, but both
/// are limited by it.
TEST(QualityAnalysis, CountsAllElementsAtASharpEdgeAsLimited) {
  const double angle = 24.0 * std::numbers::pi / 180.0;
  const Vec3 middle(0.5, 0.5 * (1.0 + std::cos(angle)), 0.5 * std::sin(angle));
  SurfaceMesh wedge = tetrahedronSurface({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.5, 1.0, 0.0),
                                          Vec3(0.5, std::cos(angle), std::sin(angle))});
  wedge.points.insert(wedge.points.end(), {middle.x, middle.y, middle.z});
  VolumeMesh mesh;
  mesh.points = wedge.points;
  mesh.tetrahedra = {0, 1, 2, 4, 0, 1, 4, 3};
  mesh.regions = {0, 0};
  const QualityStatistics statistics = analyse(mesh, wedge);
  EXPECT_EQ(statistics.limitedByEdges, 2U);
  EXPECT_EQ(statistics.limitedByBoundary, 2U);
}

/// A wedge between two triangles at the edge from 0 to 1, with apexes at these positions along it.
/// Below 60 degrees, either one element fills it or one element has less than 30 degrees. If the
/// apexes are far apart, that one element is out of range, and so is every alternative.
TEST(QualityAnalysis, CountsElementsForcedByAnEdgeBelow60DegreesAsLimited) {
  struct Wedge {
    double degrees;
    double shift;  ///< distance of the apexes along the edge
    bool isForced;
  };
  for (const Wedge& wedge : {Wedge{40.0, 1.2, true}, Wedge{56.0, 1.2, true},
                             Wedge{64.0, 1.2, false}, Wedge{40.0, 0.0, false}}) {
    const auto at = [&](double part, double along) {
      const double radians = part * wedge.degrees * std::numbers::pi / 180.0;
      return Vec3(along, std::cos(radians), std::sin(radians));
    };
    VolumeMesh mesh;
    for (const Vec3& position : {Vec3(0.0), Vec3(1.0, 0.0, 0.0), at(0.0, 0.5 - wedge.shift),
                                 at(1.0, 0.5 + wedge.shift), at(0.6, 0.5)}) {
      mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
    }
    SurfaceMesh sheets;
    sheets.points = mesh.points;
    sheets.triangles = {0, 2, 1, 0, 1, 3};
    mesh.regions = {0};
    const auto isExcused = [&](const std::vector<std::uint32_t>& element) {
      mesh.tetrahedra = element;
      const QualityStatistics statistics = analyse(mesh, sheets);
      EXPECT_LE(statistics.limitedByEdges + statistics.outOfRange, 1U);
      return statistics.limitedByEdges == 1U;
    };
    EXPECT_EQ(isExcused({0, 1, 2, 3}), wedge.isForced) << wedge.degrees << " " << wedge.shift;
    // Two elements instead of one: the one below 30 degrees is forced, the other is not.
    EXPECT_EQ(isExcused({0, 1, 4, 3}), wedge.isForced) << wedge.degrees;
    if (0.6 * wedge.degrees > 30.0) {
      EXPECT_FALSE(isExcused({0, 1, 2, 4})) << wedge.degrees;
    }
  }
}

/// Triangles that share the edge from 0 to 1, at angles in degrees around it.
SurfaceMesh sheetsAround(const std::vector<double>& angles) {
  SurfaceMesh sheets;
  sheets.points = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0};
  for (const double angle : angles) {
    const double radians = angle * std::numbers::pi / 180.0;
    const auto apex = static_cast<std::uint32_t>(sheets.points.size() / 3);
    sheets.points.insert(sheets.points.end(), {0.5, std::cos(radians), std::sin(radians)});
    // With either orientation, as interfaces have.
    sheets.triangles.insert(sheets.triangles.end(), {apex % 2, (apex + 1) % 2, apex});
  }
  return sheets;
}

/// Returns the element at the edge from 0 to 1 between two angles.
VolumeMesh elementBetween(const SurfaceMesh& sheets, double from, double to) {
  VolumeMesh mesh;
  mesh.points = sheets.points;
  const auto first = static_cast<std::uint32_t>(mesh.points.size() / 3);
  for (const double angle : {from, to}) {
    const double radians = angle * std::numbers::pi / 180.0;
    mesh.points.insert(mesh.points.end(), {0.5, 0.9 * std::cos(radians), 0.9 * std::sin(radians)});
  }
  mesh.tetrahedra = {0, 1, first, first + 1};
  mesh.regions = {0};
  return mesh;
}

/// Each element depends only on the sector between the two triangles around it, however many share
/// the edge.
TEST(QualityAnalysis, CountsElementsBetweenInterfacesAtSharpAnglesAsLimited) {
  SurfaceMesh sheets = sheetsAround({0.0, 24.0, 70.0, 96.0, 200.0});
  const auto isExcused = [&](double from, double to) {
    const QualityStatistics statistics = analyse(elementBetween(sheets, from, to), sheets);
    EXPECT_EQ(statistics.limitedByEdges + statistics.outOfRange, 1U) << from << " to " << to;
    return statistics.limitedByEdges == 1U;
  };
  EXPECT_TRUE(isExcused(1.0, 12.0));
  EXPECT_TRUE(isExcused(12.0, 23.0));
  EXPECT_TRUE(isExcused(71.0, 95.0));
  EXPECT_FALSE(isExcused(25.0, 45.0));
  EXPECT_FALSE(isExcused(45.0, 69.0));
  EXPECT_FALSE(isExcused(97.0, 110.0));
  EXPECT_FALSE(isExcused(335.0, 359.0));
  // An edge of two triangles, from inside and from outside the wedge.
  sheets = sheetsAround({0.0, 24.0});
  EXPECT_TRUE(isExcused(2.0, 20.0));
  EXPECT_FALSE(isExcused(26.0, 50.0));
  EXPECT_FALSE(isExcused(338.0, 358.0));
}

/// An element between two parallel sheets, which it touches along crossed edges.
TEST(QualityAnalysis, CountsElementsInNarrowGapsOnlyAsLimited) {
  for (const double gap : {0.55, 0.65}) {
    const double h = 3.4 * kSize;  // wide enough to be out of range in both cases
    const double z = gap * kSize;
    SurfaceMesh sheets;
    sheets.points = {-0.5 * h, 0,  0,  0.5 * h, 0, 0,  0, -0.5 * h, z,     0,  0.5 * h, z,
                     0,        -h, -z, 0,       h, -z, h, 0,        2 * z, -h, 0,       2 * z};
    sheets.triangles = {0, 4, 1, 0, 1, 5, 2, 6, 3, 2, 3, 7};
    VolumeMesh mesh;
    mesh.points = sheets.points;
    mesh.tetrahedra = {0, 1, 3, 2};
    mesh.regions = {0};
    ASSERT_GT(measureQuality(mesh).minDihedral, 0.0);
    const QualityStatistics statistics = analyse(mesh, sheets);
    EXPECT_EQ(statistics.limitedByNarrowGaps, gap < 0.6 ? 1U : 0U);
    EXPECT_EQ(statistics.outOfRange, gap < 0.6 ? 0U : 1U);
  }
}

/// In a stretched field the target element counts as regular, with edges of length 1.
TEST(QualityAnalysis, MeasuresElementsInTheMetricOfTheSizeField) {
  BackgroundGrid grid = boxGrid(Vec3(-3.0), Vec3(3.0), [](const Vec3&) { return 0.1; });
  for (BackgroundNode& node : grid.nodes) {
    node.stretching = 8.0;
    node.direction = Vec3(1.0, 2.0, -0.5);
  }
  const SizeField field = SizeField::fromGrid(GridLocator(grid));
  const SymmetricTensor toSpace = sizeTensor(grid.nodes[0]);
  VolumeMesh mesh;
  const double half = 0.5 / std::numbers::sqrt2;  // edges of length 1
  for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)}) {
    const Vec3 position = toSpace * (corner * half);
    mesh.points.insert(mesh.points.end(), {position.x, position.y, position.z});
  }
  mesh.tetrahedra = {0, 1, 2, 3};
  mesh.regions = {0};
  const QualityStatistics statistics = analyse(mesh, SurfaceMesh{}, field);
  EXPECT_NEAR(statistics.meanEdge, 1.0, 1e-9);
  EXPECT_NEAR(statistics.worst[0].radiusRatio, 1.0, 1e-9);
  EXPECT_EQ(statistics.regions[0].dihedral[14], 6U);  // 70.5 degrees
  EXPECT_EQ(statistics.outOfRange, 0U);
}

}  // namespace
}  // namespace tetrafront::testing
