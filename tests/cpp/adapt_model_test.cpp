/// A mesh of a CAD model that is adapted has its nodes on the faces and edges of the model, not on the triangles of the mesh.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "metric/symmetric_tensor.h"
#include "support/given_meshes.h"
#include "support/meshed_models.h"
#include "support/slices.h"
#include "support/trimmed_models.h"
#include "tetrafront/mesh_adaptation.h"
#include "tetrafront/wall_layers.h"

namespace tetrafront::testing {
namespace {

constexpr double kFirstSize = 0.25;
constexpr double kModelSize = 0.16;

AdaptInput meshedSolid(const TrimmedSolid& solid) {
  const SurfaceMesh surface = meshOfModel(solid.model, kFirstSize);
  const VolumeMesh mesh = meshed(surface, {});
  return {mesh.points,
          mesh.tetrahedra,
          {},
          surface.triangles,
          surface.trianglePatch,
          numbersOf(solid.model),
          modelTriangles(solid.model, 0.2)};
}

/// The same size everywhere, or half of it along z.
MetricMesh sizes(const std::vector<double>& points, const std::vector<std::uint32_t>& elements,
                 double stretching) {
  MetricMesh background{points, elements, {}};
  const double m = 1.0 / (kModelSize * kModelSize);
  for (std::size_t i = 0; i < points.size(); i += 3)
    background.metrics.insert(background.metrics.end(),
                              {m, 0.0, 0.0, m, 0.0, m * stretching * stretching});
  return background;
}

MeshAdaptation adaptedOnModel(const AdaptInput& given, const MetricMesh& background,
                              std::uint32_t budget = 1U << 20) {
  MeshAdapter adapter(given, background, {});
  slicesOf(adapter, budget);
  return adapter.result();
}

/// Largest distance of a node from the faces of its triangles.
double farthestFromFaces(const TrimmedSolid& solid, const MeshAdaptation& made) {
  double farthest = 0.0;
  for (std::size_t c = 0; c < made.triangles.size(); ++c) {
    const Position at = positionOf(made.points, made.triangles[c]);
    farthest =
        std::max(farthest, solid.distances[made.trianglePatch[c / 3]](Vec3(at[0], at[1], at[2])));
  }
  return farthest;
}

/// Least and largest z.
std::array<double, 2> heightsOf(const std::vector<double>& points) {
  std::array<double, 2> ends{points[2], points[2]};
  for (std::size_t i = 2; i < points.size(); i += 3)
    ends = {std::min(ends[0], points[i]), std::max(ends[1], points[i])};
  return ends;
}

double volumeOf(const MeshAdaptation& made) {
  double sixfold = 0.0;
  for (std::size_t t = 0; t < made.triangles.size(); t += 3) {
    const Position a = positionOf(made.points, made.triangles[t]);
    const Position b = positionOf(made.points, made.triangles[t + 1]);
    const Position c = positionOf(made.points, made.triangles[t + 2]);
    sixfold += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sixfold / 6.0;
}

TEST(AdaptModel, HasItsNodesOnTheFacesAndEdges) {
  for (const TrimmedSolid& solid : {trimmedCone(0.6, 0.0, 1.0), trimmedPlate(2.0, 0.5, 0.5),
                                    trimmedTorus(1.0, 0.4), nurbsSphere(0.7), revolvedProfile()}) {
    SCOPED_TRACE(solid.name);
    const AdaptInput given = meshedSolid(solid);
    const MeshAdaptation made = adaptedOnModel(given, sizes(given.points, given.tetrahedra, 1.0));
    ASSERT_TRUE(made.diagnostics.empty());
    EXPECT_GT(made.after.nodes, 2 * made.before.nodes);
    EXPECT_LT(farthestFromFaces(solid, made), 1e-9);
    EXPECT_GT(made.after.unitEdges, 0.98);
    EXPECT_GT(made.after.leastQuality, 0.2);
    EXPECT_NEAR(volumeOf(made), solid.volume, 0.03 * solid.volume);
    const std::set<std::uint32_t> patches(made.trianglePatch.begin(), made.trianglePatch.end());
    EXPECT_EQ(patches.size(), solid.model.faces.size());
  }
}

/// The second adaptation begins with the first one's mesh, whose nodes are off the triangles of the model's mesh.
TEST(AdaptModel, BeginsWithABackgroundThatFillsTheModel) {
  for (const TrimmedSolid& solid : {trimmedCylinder(0.7, 0.7), trimmedPlate(1.5, 0.4, 0.5)}) {
    SCOPED_TRACE(solid.name);
    const AdaptInput given = meshedSolid(solid);
    const MeshAdaptation made = adaptedOnModel(given, sizes(given.points, given.tetrahedra, 2.0));
    const MeshAdaptation next = adaptedOnModel(given, sizes(made.points, made.tetrahedra, 2.0));
    ASSERT_TRUE(next.diagnostics.empty());
    std::set<Position> known;
    for (std::uint32_t i = 0; 3 * i < made.points.size(); ++i)
      known.insert(positionOf(made.points, i));
    std::size_t kept = 0;
    for (std::uint32_t i = 0; 3 * i < next.points.size(); ++i)
      kept += known.count(positionOf(next.points, i));
    EXPECT_GT(4 * kept, next.points.size()) << "three of four nodes";
    EXPECT_LT(farthestFromFaces(solid, next), 1e-9);
  }
}

/// A metric with thin elements along a cylinder with radius 1 about the z axis, at a position.
SymmetricTensor thinAt(double x, double y) {
  const double r = std::hypot(x, y);
  const double thin = 0.02 + 0.3 * std::fabs(1.0 - r);
  const double across = 1.0 / (thin * thin);
  constexpr double kAlong = 1.0 / (0.4 * 0.4);
  const double c = x / r;
  const double s = y / r;
  return {.xx = across * c * c + kAlong * s * s,
          .yy = across * s * s + kAlong * c * c,
          .zz = kAlong,
          .xy = (across - kAlong) * c * s};
}

/// Least quality in that metric: of each element in the metric of its densest corner, of several the least.
double leastThinQuality(const MeshAdaptation& made) {
  double least = 1.0;
  for (std::size_t t = 0; t < made.tetrahedra.size(); t += 4) {
    std::array<Vec3, 4> at{};
    std::array<SymmetricTensor, 4> metrics;
    double densest = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Position p = positionOf(made.points, made.tetrahedra[t + k]);
      at[k] = Vec3(p[0], p[1], p[2]);
      metrics[k] = thinAt(p[0], p[1]);
      densest = std::max(densest, metrics[k].determinant());
    }
    const double sixfold =
        std::fabs(glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), at[3] - at[0]));
    for (const SymmetricTensor& m : metrics) {
      if (m.determinant() < densest * (1.0 - 1e-9)) continue;
      double squares = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < i; ++k) squares += glm::dot(at[i] - at[k], m * (at[i] - at[k]));
      }
      const double volume = sixfold * std::sqrt(2.0 * m.determinant());
      least = std::min(least, 6.0 * std::pow(volume, 2.0 / 3.0) / squares);
    }
  }
  return least;
}

/// Between the nodes of the background, its metrics are those of chords, where a curved wall is inside the layer of thin elements.
TEST(AdaptModel, HasTheQualityOfTheMetricsAtItsOwnNodes) {
  const TrimmedSolid solid = trimmedPlate(3.0, 0.5, 1.0);
  const AdaptInput given = meshedSolid(solid);
  MeshAdaptation made;
  made.points = given.points;
  made.tetrahedra = given.tetrahedra;
  for (int cycle = 0; cycle < 4; ++cycle) {
    MetricMesh background{made.points, made.tetrahedra, {}};
    for (std::size_t i = 0; i < made.points.size(); i += 3) {
      const SymmetricTensor m = thinAt(made.points[i], made.points[i + 1]);
      background.metrics.insert(background.metrics.end(), {m.xx, m.xy, m.xz, m.yy, m.yz, m.zz});
    }
    made = adaptedOnModel(given, background);
    ASSERT_TRUE(made.diagnostics.empty());
    if (cycle < 2) continue;
    EXPECT_GT(made.after.unitEdges, 0.985);
    EXPECT_GT(leastThinQuality(made), 0.9 * made.after.leastQuality);
  }
}

/// The metrics ask for edges on the wall of a hole that are fifty times as long around it as along it.
TEST(AdaptModel, FollowsALayerAcrossAHole) {
  const TrimmedSolid solid = trimmedPlate(2.0, 1.0, 0.5);
  const AdaptInput given = meshedSolid(solid);
  double low = 1.0;
  double high = -1.0;
  for (std::size_t i = 2; i < given.points.size(); i += 3) {
    low = std::min(low, given.points[i]);
    high = std::max(high, given.points[i]);
  }
  const double middle = 0.5 * (low + high);
  MeshAdaptation made;
  made.points = given.points;
  made.tetrahedra = given.tetrahedra;
  for (int cycle = 0; cycle < 4; ++cycle) {
    MetricMesh background{made.points, made.tetrahedra, {}};
    constexpr double kAround = 1.0 / (0.15 * 0.15);
    for (std::size_t i = 0; i < made.points.size(); i += 3) {
      const double thin = 0.003 + 0.3 * std::fabs(made.points[i + 2] - middle);
      background.metrics.insert(background.metrics.end(),
                                {kAround, 0.0, 0.0, kAround, 0.0, 1.0 / (thin * thin)});
    }
    made = adaptedOnModel(given, background);
    ASSERT_TRUE(made.diagnostics.empty());
  }
  EXPECT_GT(made.after.unitEdges, 0.995);
  EXPECT_GT(made.after.leastQuality, 0.45);
  EXPECT_LT(farthestFromFaces(solid, made), 1e-9);
}

/// The triangles of the given mesh are further from the wall than its first layer is high.
TEST(AdaptModel, HasLayersAlongACurvedFace) {
  constexpr double kRadius = 0.5;
  const TrimmedSolid solid = trimmedPlate(2.0, 0.3, kRadius);
  const AdaptInput given = meshedSolid(solid);
  const auto hole = static_cast<std::uint32_t>(
      std::ranges::find_if(solid.distances,
                           [](const auto& distance) {
                             return std::fabs(distance(Vec3(kRadius, 0.0, 0.1))) < 1e-12;
                           }) -
      solid.distances.begin());
  const PatchLayers wall{.patch = hole, .firstHeight = 0.008, .growth = 1.4, .count = 5};
  LayerOptions options;
  options.maxAspect = 20.0;
  LayerMaker maker(given, {}, {}, {wall}, options);
  slicesOf(maker, 1U << 20U);
  const LayeredMesh made = maker.result();
  ASSERT_TRUE(made.adaptation.diagnostics.empty());
  EXPECT_LT(farthestFromFaces(solid, made.adaptation), 1e-9);
  EXPECT_GT(made.adaptation.after.unitEdges, 0.98);
  EXPECT_GT(made.adaptation.after.leastQuality, 0.3);
  EXPECT_NEAR(made.walls[0].meanFirstHeight, wall.firstHeight, 0.25 * wall.firstHeight);
  EXPECT_NEAR(volumeOf(made.adaptation), solid.volume, 0.002 * solid.volume);
}

/// Triangles with two nodes at one height of the wall and a third one beside them tilt much if they are low.
TEST(AdaptModel, HasTheAreaOfAWallWhereElementsAreThinAlongIt) {
  constexpr double kRadius = 0.5;
  constexpr double kWide = 0.1;
  const TrimmedSolid solid = trimmedCylinder(kRadius, 0.5);
  const AdaptInput given = meshedSolid(solid);
  MeshAdaptation made;
  made.points = given.points;
  made.tetrahedra = given.tetrahedra;
  const auto [low, high] = heightsOf(made.points);
  for (int cycle = 0; cycle < 2; ++cycle) {
    MetricMesh background{made.points, made.tetrahedra, {}};
    for (std::size_t i = 0; i < made.points.size(); i += 3) {
      const double off = std::fabs(made.points[i + 2] - 0.5 * (low + high));
      const double thin = std::min(kWide, 0.003 + 0.4 * off);
      constexpr double kAlong = 1.0 / (kWide * kWide);
      background.metrics.insert(background.metrics.end(),
                                {kAlong, 0.0, 0.0, kAlong, 0.0, 1.0 / (thin * thin)});
    }
    made = adaptedOnModel(given, background);
    ASSERT_TRUE(made.diagnostics.empty());
  }
  double area = 0.0;
  for (std::size_t t = 0; t < made.triangles.size(); t += 3) {
    std::array<Vec3, 3> at{};
    bool isAtEnd = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Position p = positionOf(made.points, made.triangles[t + k]);
      at[k] = Vec3(p[0], p[1], p[2]);
      isAtEnd = isAtEnd && (p[2] == low || p[2] == high);
    }
    if (!isAtEnd) area += 0.5 * glm::length(glm::cross(at[1] - at[0], at[2] - at[0]));
  }
  const double exact = 2.0 * std::numbers::pi * kRadius * (high - low);
  EXPECT_GT(made.after.unitEdges, 0.99);
  EXPECT_NEAR(area, exact, 0.002 * exact);
}

TEST(AdaptModel, DoesNotDependOnTheSlices) {
  const AdaptInput given = meshedSolid(trimmedCylinder(0.5, 0.5));
  const MetricMesh background = sizes(given.points, given.tetrahedra, 1.0);
  const MeshAdaptation one = adaptedOnModel(given, background);
  const MeshAdaptation other = adaptedOnModel(given, background, 7);
  EXPECT_EQ(one.points, other.points);
  EXPECT_EQ(one.tetrahedra, other.tetrahedra);
}

}  // namespace
}  // namespace tetrafront::testing
