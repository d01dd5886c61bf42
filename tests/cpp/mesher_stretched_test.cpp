/// Stretched meshes. In the metric of a constant size tensor H, edges have a length of about 1. The
/// number of elements is that of the box mapped by T = H^-1 and meshed with size 1.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "boundary/boundary.h"
#include "field/size_field.h"
#include "quality/metrics.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "tetrafront/mesher.h"
#include "volume/volume_mesher.h"

namespace tetrafront::testing {
namespace {

constexpr std::uint32_t kBudget = 100'000;
const Vec3 kSlanted(2.0, 1.0, -0.7);
const Vec3 kAcrossSlanted(1.0, -2.0, 0.0);

struct Stretch {
  double stretching;
  double size;
  double second = 1.0;  ///< second stretching
};
void PrintTo(const Stretch& s, std::ostream* out) {
  *out << "stretchings " << s.stretching << " and " << s.second;
}

BackgroundNode parameters(const Stretch& stretch) {
  BackgroundNode node;
  node.size = stretch.size;
  node.stretching = stretch.stretching;
  node.direction = kSlanted;
  return node;
}

SymmetricTensor tensorOf(const Stretch& stretch) {
  return sizeTensor(parameters(stretch), {stretch.second, kAcrossSlanted});
}

Model unitBox() { return boxModel(Vec3(0.0), Vec3(1.0)); }

BackgroundGrid stretchedGrid(const Stretch& stretch) {
  BackgroundGrid grid = boxGrid(Vec3(-0.1), Vec3(1.1), [](const Vec3&) { return 1.0; });
  for (BackgroundNode& node : grid.nodes) {
    const Vec3 position = node.position;
    node = parameters(stretch);
    node.position = position;
    // The sign of the direction must not matter.
    if (position.x > 0.5) node.direction = -3.0 * node.direction;
    if (stretch.second > 1.0) grid.secondStretchings.push_back({stretch.second, kAcrossSlanted});
  }
  return grid;
}

struct Finished {
  SurfaceMesh surface;
  VolumeMesh volume;
  QualityStatistics statistics;
  MetricShapes shapes;
  [[nodiscard]] std::size_t count() const { return volume.tetrahedra.size() / 4; }
};

Finished meshed(const Model& model, const BackgroundGrid& grid, double size,
                Optimization optimization = Optimization::kNone) {
  MeshOptions options;
  options.size = size;
  options.optimization = optimization;
  MeshRun run(model, grid, options);
  while (run.advance(kBudget) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return {run.surface(), run.volume(), run.statistics(), run.metricShapes()};
}

/// Returns the mesh of size 1 of the box mapped by T.
Finished unstretched(const Stretch& stretch, Optimization optimization = Optimization::kNone) {
  const SymmetricTensor toUnit = tensorOf(stretch).inverse();
  Model model = unitBox();
  for (Vec3& point : model.points) point = toUnit * point;
  return meshed(model, {}, 1.0, optimization);
}

/// Measured in the metric, in which the target element is regular.
QualitySummary metricQuality(VolumeMesh mesh, const Stretch& stretch) {
  const SymmetricTensor toUnit = tensorOf(stretch).inverse();
  for (std::size_t i = 0; i < mesh.points.size(); i += 3) {
    double* at = &mesh.points[i];
    const Vec3 position = toUnit * Vec3(at[0], at[1], at[2]);
    for (int k = 0; k < 3; ++k) at[k] = position[k];
  }
  return measureQuality(mesh);
}

/// Returns the mean length of the edges in the metric; each edge counts once.
double meanMetricEdge(const VolumeMesh& mesh, const Stretch& stretch) {
  const SymmetricTensor toUnit = tensorOf(stretch).inverse();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j)
        edges.push_back(std::minmax(mesh.tetrahedra[t + i], mesh.tetrahedra[t + j]));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  double sum = 0.0;
  for (const auto& [a, b] : edges) {
    const auto at = [&mesh](std::size_t n) {
      return Vec3(mesh.points[3 * n], mesh.points[3 * n + 1], mesh.points[3 * n + 2]);
    };
    sum += glm::length(toUnit * (at(a) - at(b)));
  }
  return sum / static_cast<double>(edges.size());
}

class StretchedBox : public ::testing::TestWithParam<Stretch> {
 protected:
  void expectStretched(const Finished& mesh) const {
    EXPECT_EQ(complaintAbout(mesh.volume, mesh.surface), "");
    EXPECT_NEAR(meanMetricEdge(mesh.volume, GetParam()), 1.0, 0.15);
    const double expected = static_cast<double>(unstretched(GetParam()).count());
    EXPECT_NEAR(static_cast<double>(mesh.count()), expected, 0.2 * expected);
  }
};

/// Tests the volume alone: its surface is that of the mapped box, mapped back.
TEST_P(StretchedBox, IsFilledFromAStretchedSurface) {
  const SymmetricTensor toSpace = tensorOf(GetParam());
  Finished mesh = unstretched(GetParam());
  for (std::size_t i = 0; i < mesh.surface.points.size(); i += 3) {
    double* at = &mesh.surface.points[i];
    const Vec3 position = toSpace * Vec3(at[0], at[1], at[2]);
    for (int k = 0; k < 3; ++k) {
      // Rounding makes the faces of the box exactly planar again.
      const double rounded = std::round(position[k]);
      at[k] = std::fabs(position[k] - rounded) < 1e-9 ? rounded : position[k];
    }
  }
  const SizeField field = SizeField::fromGrid(GridLocator(stretchedGrid(GetParam())));
  std::vector<Diagnostic> diagnostics;
  const Boundary closed = closeBoundary(mesh.surface, BoundarySource::kGivenSurface, diagnostics);
  ASSERT_TRUE(closed.isValid);
  VolumeMesher mesher(mesh.surface, field, {});
  Job<MeshStatus> job([&mesher](Work& work) { return mesher.run(work); });
  job.finish();
  ASSERT_EQ(mesher.status(), MeshStatus::kDone);
  mesh.volume = toVolumeMesh(mesher.take());
  expectStretched(mesh);
}

/// From points, lines and patches to the volume.
TEST_P(StretchedBox, IsMeshedFromItsLines) {
  expectStretched(meshed(unitBox(), stretchedGrid(GetParam()), 0.0));
}

/// In the metric, elements are as good as those of the mapped box. Slivers occur only at edges of
/// the box that are sharp in the metric, which happens with a stretching of 20.
TEST_P(StretchedBox, IsOptimizedInItsMetric) {
  const Stretch stretch{GetParam().stretching, 1.4 * GetParam().size};
  const Finished mesh = meshed(unitBox(), stretchedGrid(stretch), 0.0, Optimization::kDefault);
  const Finished twin = unstretched(stretch, Optimization::kDefault);
  EXPECT_EQ(complaintAbout(mesh.volume, mesh.surface), "");
  EXPECT_NEAR(meanMetricEdge(mesh.volume, stretch), 1.0, 0.15);
  const auto expected = static_cast<double>(twin.count());
  EXPECT_NEAR(static_cast<double>(mesh.count()), expected, 0.1 * expected);
  const QualitySummary here = metricQuality(mesh.volume, stretch);
  const QualitySummary there = measureQuality(twin.volume);
  EXPECT_GT(here.minDihedral, std::min(20.0, 0.95 * there.minDihedral));
  EXPECT_LT(here.maxDihedral, std::max(145.0, 1.02 * there.maxDihedral));
  EXPECT_GT(here.meanRadiusRatio, there.meanRadiusRatio - 0.02);
}

/// The report's extremes and the shape of every element are those of the mesh mapped to the unit space.
TEST_P(StretchedBox, IsMeasuredInItsMetric) {
  const Finished mesh = meshed(unitBox(), stretchedGrid(GetParam()), 0.0);
  const QualitySummary expected = metricQuality(mesh.volume, GetParam());
  ASSERT_EQ(mesh.statistics.regions.size(), 1U);
  const RegionStatistics& region = mesh.statistics.regions[0];
  EXPECT_NEAR(region.minDihedral, expected.minDihedral, 1e-6);
  EXPECT_NEAR(region.maxDihedral, expected.maxDihedral, 1e-6);
  EXPECT_NEAR(region.minRadiusRatio, expected.minRadiusRatio, 1e-6);
  EXPECT_NEAR(region.meanRadiusRatio, expected.meanRadiusRatio, 1e-6);
  const auto& [ratios, angles] = mesh.shapes;
  ASSERT_EQ(ratios.size(), mesh.count());
  ASSERT_EQ(angles.size(), mesh.count());
  EXPECT_NEAR(*std::min_element(ratios.begin(), ratios.end()), expected.minRadiusRatio, 1e-5);
  EXPECT_NEAR(*std::min_element(angles.begin(), angles.end()), expected.minDihedral, 1e-4);
  const ElementQuality& worst = mesh.statistics.worst.at(0);
  EXPECT_NEAR(angles[worst.tetrahedron], worst.smallestDihedral, 1e-4);
}

TEST(StretchedBoxTest, HasNoShapesInAMetricWithoutStretching) {
  const Finished mesh = meshed(unitBox(), {}, 0.5);
  EXPECT_TRUE(mesh.shapes.radiusRatio.empty());
  EXPECT_TRUE(mesh.shapes.smallestDihedral.empty());
  const QualitySummary expected = measureQuality(mesh.volume);
  EXPECT_EQ(mesh.statistics.regions.at(0).minDihedral, expected.minDihedral);
  EXPECT_EQ(mesh.statistics.regions.at(0).meanRadiusRatio, expected.meanRadiusRatio);
}

/// Size, stretching and direction all vary with the position: each element is measured by the
/// tensor at its centroid.
TEST(StretchedBoxTest, IsOptimizedWhereTheMetricChanges) {
  BackgroundGrid grid = boxGrid(Vec3(-0.1), Vec3(1.1), [](const Vec3&) { return 1.0; });
  for (BackgroundNode& node : grid.nodes) {
    const Vec3& at = node.position;
    node.size = at.x > 0.5 ? 0.06 : 0.1;
    node.stretching = at.y > 0.5 ? 6.0 : 2.0;
    node.direction = at.z > 0.5 ? Vec3(1.0, 0.3, 0.0) : Vec3(1.0, -0.3, 0.4);
  }
  const SizeField field = SizeField::fromGrid(GridLocator(grid));
  const auto measured = [&](Optimization optimization) {
    const Finished mesh = meshed(unitBox(), grid, 0.0, optimization);
    EXPECT_EQ(complaintAbout(mesh.volume, mesh.surface), "");
    FieldHint hint;
    VolumeMesh unit;
    for (std::size_t i = 0; i < mesh.volume.tetrahedra.size(); i += 4) {
      std::array<Vec3, 4> corners;
      for (std::size_t k = 0; k < 4; ++k) {
        const double* at = &mesh.volume.points[3 * std::size_t{mesh.volume.tetrahedra[i + k]}];
        corners[k] = {at[0], at[1], at[2]};
      }
      const Vec3 centroid = (corners[0] + corners[1] + corners[2] + corners[3]) * 0.25;
      const SymmetricTensor toUnit = field.tensorAt(centroid, hint).inverse();
      for (const Vec3& corner : corners) {
        const Vec3 position = toUnit * (corner - centroid);
        unit.tetrahedra.push_back(static_cast<std::uint32_t>(unit.points.size() / 3));
        unit.points.insert(unit.points.end(), {position.x, position.y, position.z});
      }
    }
    return measureQuality(unit);
  };
  const QualitySummary before = measured(Optimization::kNone);
  const QualitySummary after = measured(Optimization::kDefault);
  EXPECT_LT(before.minDihedral, 5.0);
  EXPECT_GT(after.minDihedral, 22.0);
  EXPECT_LT(after.maxDihedral, 145.0);
  EXPECT_GT(after.meanRadiusRatio, 0.86);
}

/// A second stretching of 1 at all nodes changes no bit.
TEST(StretchedBoxTest, HasTheSameBitsWithSecondStretchingsOfOne) {
  const Stretch stretch{5.0, 0.09};
  BackgroundGrid grid = stretchedGrid(stretch);
  const Finished one = meshed(unitBox(), grid, 0.0, Optimization::kDefault);
  grid.secondStretchings.assign(grid.nodes.size(), {});
  const Finished same = meshed(unitBox(), grid, 0.0, Optimization::kDefault);
  EXPECT_EQ(same.volume.points, one.volume.points);
  EXPECT_EQ(same.volume.tetrahedra, one.volume.tetrahedra);
}

/// With a stretching of s, the number of elements is 1/s of the number without stretching.
TEST(StretchedBoxTest, NeedsFewerElementsInProportionToTheStretching) {
  const Stretch stretch{5.0, 0.06};
  const double stretched =
      static_cast<double>(meshed(unitBox(), stretchedGrid(stretch), 0.0).count());
  const double isotropic = static_cast<double>(meshed(unitBox(), {}, stretch.size).count());
  EXPECT_NEAR(isotropic / stretched, stretch.stretching, 0.2 * stretch.stretching);
}

INSTANTIATE_TEST_SUITE_P(Mesher, StretchedBox,
                         ::testing::Values(Stretch{5.0, 0.06}, Stretch{20.0, 0.036},
                                           Stretch{5.0, 0.04, 5.0}, Stretch{10.0, 0.03, 6.0}));

}  // namespace
}  // namespace tetrafront::testing
