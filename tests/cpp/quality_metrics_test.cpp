#include "quality/metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/random.h"
#include "support/slow_dihedral.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

using Corners = std::array<Vec3, 4>;

TetrahedronMeasures measure(const Corners& p) { return measureTetrahedron(p[0], p[1], p[2], p[3]); }

double degrees(double cosine) { return std::acos(cosine) * 180.0 / std::numbers::pi; }

const Corners kRegular{Vec3(1.0, 1.0, 1.0), Vec3(-1.0, -1.0, 1.0), Vec3(-1.0, 1.0, -1.0),
                       Vec3(1.0, -1.0, -1.0)};

double area(const Vec3& a, const Vec3& b, const Vec3& c) {
  // Heron, from the three lengths.
  const double x = glm::length(b - a);
  const double y = glm::length(c - b);
  const double z = glm::length(a - c);
  const double s = 0.5 * (x + y + z);
  return std::sqrt(s * (s - x) * (s - y) * (s - z));
}

/// Computes it from the products of opposite edges (Crelle) and the sum of the areas.
double slowRadiusRatio(const Corners& p, double volume) {
  const auto edge = [&](std::size_t i, std::size_t j) { return glm::length(p[i] - p[j]); };
  const double x = edge(0, 1) * edge(2, 3);
  const double y = edge(0, 2) * edge(1, 3);
  const double z = edge(0, 3) * edge(1, 2);
  const double s = 0.5 * (x + y + z);
  const double circumradius = std::sqrt(s * (s - x) * (s - y) * (s - z)) / (6.0 * volume);
  const double areas = area(p[0], p[1], p[2]) + area(p[0], p[1], p[3]) + area(p[0], p[2], p[3]) +
                       area(p[1], p[2], p[3]);
  return 3.0 * (3.0 * volume / areas) / circumradius;
}

TEST(MetricsTest, RegularTetrahedron) {
  const TetrahedronMeasures m = measure(kRegular);
  EXPECT_NEAR(m.volume, 8.0 / 3.0, 1e-14);
  EXPECT_NEAR(m.radiusRatio, 1.0, 1e-14);
  EXPECT_NEAR(m.largestCosine, 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(m.smallestCosine, 1.0 / 3.0, 1e-14);
}

TEST(MetricsTest, CornerOfACube) {
  const TetrahedronMeasures m =
      measure({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)});
  EXPECT_NEAR(m.volume, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(degrees(m.smallestCosine), 90.0, 1e-12);
  EXPECT_NEAR(m.largestCosine, 1.0 / std::sqrt(3.0), 1e-14);
  // Inradius 1 / (3 + sqrt 3), circumradius sqrt 3 / 2.
  EXPECT_NEAR(m.radiusRatio, 3.0 / (3.0 + std::sqrt(3.0)) / (0.5 * std::sqrt(3.0)), 1e-14);
}

TEST(MetricsTest, DegenerateAndInvertedElementsHaveNoRadiusRatio) {
  const TetrahedronMeasures flat =
      measure({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0, 0.0), Vec3(0.0, 1.0, 0.0)});
  EXPECT_EQ(flat.volume, 0.0);
  EXPECT_EQ(flat.radiusRatio, 0.0);
  EXPECT_NEAR(degrees(flat.largestCosine), 0.0, 1e-6);
  EXPECT_NEAR(degrees(flat.smallestCosine), 180.0, 1e-6);
  const TetrahedronMeasures inverted =
      measure({kRegular[1], kRegular[0], kRegular[2], kRegular[3]});
  EXPECT_LT(inverted.volume, 0.0);
  EXPECT_EQ(inverted.radiusRatio, 0.0);
}

/// The volumes and circumcentres of these elements are rounding.
TEST(MetricsTest, RadiusRatiosOfNearlyFlatElementsAreAtMostOne) {
  Random random(602);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = random.inBox(1.0);
    const Vec3 along = random.inBox(1.0);
    Corners p;
    for (Vec3& corner : p) corner = origin + along * random.inBox(1.0).x;
    const double ratio = measure(p).radiusRatio;
    EXPECT_GE(ratio, 0.0);
    EXPECT_LE(ratio, 1.0 + 1e-9);
  }
}

TEST(MetricsTest, AgreesWithSlowFormulas) {
  Random random(601);
  for (int i = 0; i < 2000; ++i) {
    Corners p;
    for (Vec3& corner : p) corner = Vec3(3.0, -2.0, 5.0) + random.inBox(i % 2 == 0 ? 1.0 : 1e-3);
    TetrahedronMeasures m = measure(p);
    if (m.volume < 0.0) {
      std::swap(p[0], p[1]);
      m = measure(p);
    }
    double least = 180.0;
    double most = 0.0;
    for (const auto& [a, b, c, d] : {std::array{0, 1, 2, 3},
                                     {0, 2, 1, 3},
                                     {0, 3, 1, 2},
                                     {1, 2, 0, 3},
                                     {1, 3, 0, 2},
                                     {2, 3, 0, 1}}) {
      const auto corner = [&](int k) { return p[static_cast<std::size_t>(k)]; };
      const double angle = slowDihedral(corner(a), corner(b), corner(c), corner(d));
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
    EXPECT_NEAR(degrees(m.largestCosine), least, 1e-4);
    EXPECT_NEAR(degrees(m.smallestCosine), most, 1e-4);
    EXPECT_NEAR(m.radiusRatio, slowRadiusRatio(p, m.volume), 1e-5);
    EXPECT_LE(m.radiusRatio, 1.0 + 1e-12);
  }
}

TEST(MetricsTest, SummaryOfAMesh) {
  const VolumeMesh mesh = cubeOfTetrahedra(4);
  const QualitySummary summary = measureQuality(mesh);
  EXPECT_NEAR(summary.volume, 1.0, 1e-13);
  // All tetrahedra of the regular division are congruent: 45, 60 and 90 degrees.
  EXPECT_NEAR(summary.minDihedral, 45.0, 1e-9);
  EXPECT_NEAR(summary.maxDihedral, 90.0, 1e-9);
  EXPECT_NEAR(summary.minRadiusRatio, summary.meanRadiusRatio, 1e-12);
  EXPECT_GT(summary.minRadiusRatio, 0.5);
}

TEST(MetricsTest, SlicesAddUp) {
  const VolumeMesh mesh = cubeOfTetrahedra(3, 0.15);
  const QualitySummary whole = measureQuality(mesh);
  QualityMeter meter;
  for (std::size_t t = 0; t < mesh.tetrahedra.size() / 4; t += 10) {
    meter.add(mesh, t, std::min(t + 10, mesh.tetrahedra.size() / 4));
  }
  const QualitySummary sliced = meter.summary();
  EXPECT_EQ(sliced.volume, whole.volume);
  EXPECT_EQ(sliced.minDihedral, whole.minDihedral);
  EXPECT_EQ(sliced.maxDihedral, whole.maxDihedral);
  EXPECT_EQ(sliced.meanRadiusRatio, whole.meanRadiusRatio);
  EXPECT_EQ(sliced.minRadiusRatio, whole.minRadiusRatio);
}

TEST(MetricsTest, WithoutElementsAllValuesAreZero) {
  const QualitySummary summary = measureQuality({});
  EXPECT_EQ(summary.minDihedral, 0.0);
  EXPECT_EQ(summary.maxDihedral, 0.0);
  EXPECT_EQ(summary.minRadiusRatio, 0.0);
  EXPECT_EQ(summary.meanRadiusRatio, 0.0);
}

}  // namespace
}  // namespace tetrafront::testing
