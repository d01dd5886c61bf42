/// Second-order elements: validity is compared with det J from the derivatives of the shape functions at many places, in higher
/// precision; volumes with analytic ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/resumable.h"
#include "curved/jacobian.h"
#include "support/random.h"
#include "support/shapes.h"
#include "support/slices.h"
#include "support/tet_grids.h"
#include "tetrafront/mesher.h"
#include "tetrafront/second_order.h"
#include "topology/tetrahedron.h"

namespace tetrafront::testing {
namespace {

using Real = long double;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Barycentric = std::array<Real, 4>;

Edge edgeOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// det J at a place, from the derivatives of the shape functions (2 x_i - 1) x_i and 4 x_i x_j.
Real jacobianAt(const QuadraticTet& tet, const Barycentric& x) {
  std::array<std::array<Real, 3>, 4> byCoordinate{};
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 4; ++i) byCoordinate[i][k] += (4 * x[i] - 1) * tet.corners[i][k];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j, left, right] = kTetEdges[e];
      byCoordinate[i][k] += 4 * x[j] * tet.middles[e][k];
      byCoordinate[j][k] += 4 * x[i] * tet.middles[e][k];
    }
  }
  std::array<std::array<Real, 3>, 3> j{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) j[i][k] = byCoordinate[i + 1][k] - byCoordinate[0][k];
  }
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
         j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

struct Sampled {
  Real least = INFINITY;
  Real largest = -INFINITY;
};

/// Samples det J at the places whose coordinates are multiples of 1/n.
Sampled sample(const QuadraticTet& tet, int n) {
  Sampled result;
  for (int a = 0; a <= n; ++a) {
    for (int b = 0; a + b <= n; ++b) {
      for (int c = 0; a + b + c <= n; ++c) {
        const Real value =
            jacobianAt(tet, {Real(a) / n, Real(b) / n, Real(c) / n, Real(n - a - b - c) / n});
        result.least = std::min(result.least, value);
        result.largest = std::max(result.largest, value);
      }
    }
  }
  return result;
}

/// Integrates det J by a rule of degree 3 (Keast 1986).
double volumeOf(const QuadraticTet& tet) {
  Real sum = -0.8L * jacobianAt(tet, {0.25L, 0.25L, 0.25L, 0.25L});
  for (int i = 0; i < 4; ++i) {
    Barycentric x{1 / 6.0L, 1 / 6.0L, 1 / 6.0L, 1 / 6.0L};
    x[i] = 0.5L;
    sum += 0.45L * jacobianAt(tet, x);
  }
  return static_cast<double>(sum / 6);
}

QuadraticTet straightTet(const std::array<Vec3, 4>& corners) {
  QuadraticTet tet{corners, {}};
  for (std::size_t e = 0; e < 6; ++e) {
    tet.middles[e] = 0.5 * (corners[kTetEdges[e].from] + corners[kTetEdges[e].to]);
  }
  return tet;
}

QuadraticTet randomTet(Random& random, double bend) {
  for (;;) {
    QuadraticTet tet =
        straightTet({random.inBox(), random.inBox(), random.inBox(), random.inBox()});
    const auto& [a, b, c, d] = tet.corners;
    if (glm::dot(glm::cross(b - a, c - a), d - a) < 0.2) continue;
    for (Vec3& middle : tet.middles) middle += random.inBox(bend);
    return tet;
  }
}

TEST(ScaledJacobian, IsProvenNeverBeyondWhatSamplesShow) {
  Random random(1);
  int valid = 0;
  int refused = 0;
  for (int i = 0; i < 1500; ++i) {
    const QuadraticTet tet = randomTet(random, random.between(0.0, 0.3));
    const Sampled sampled = sample(tet, 12);
    const double proven = scaledJacobian(tet);
    if (sampled.least <= 0) {
      ASSERT_LE(proven, 0.0);
    } else {
      ++valid;
      ASSERT_LE(proven, sampled.least / sampled.largest + 1e-12L);
      if (proven <= 0.0) {
        ++refused;
        // Between the samples, it is negative indeed.
        ASSERT_LE(sample(tet, 40).least, 0.006L * sampled.largest);
      } else {
        // Samples are too high by what lies between them.
        const Sampled closer = sample(tet, 24);
        ASSERT_GE(proven, closer.least / closer.largest - 0.03L);
      }
    }
  }
  EXPECT_GT(valid, 400);
  EXPECT_LT(refused, valid / 50);
}

TEST(ScaledJacobian, IsOneOfStraightElements) {
  Random random(2);
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(scaledJacobian(randomTet(random, 0.0)), 1.0, 1e-9);
}

TEST(ScaledJacobian, IsNotPositiveIfAnEdgeBeginsWithoutDirection) {
  // If the middle node lies at a quarter of the edge, the derivative along the edge is zero at that end.
  const std::array<Vec3, 4> corners{Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0),
                                    Vec3(0.0, 0.0, 1.0)};
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [from, to, left, right] = kTetEdges[e];
    QuadraticTet tet = straightTet(corners);
    tet.middles[e] = 0.75 * corners[from] + 0.25 * corners[to];
    EXPECT_LE(scaledJacobian(tet), 0.0);
    EXPECT_GT(scaledJacobian(tet), -1e-9);
    tet.middles[e] = 0.74 * corners[from] + 0.26 * corners[to];
    EXPECT_GT(scaledJacobian(tet), 0.0);
  }
}

TEST(ScaledJacobian, ComparesTheLeastValueWithTheLargest) {
  // One edge along x: the derivative along it is 1 - 4 s at one end and 1 + 4 s at the other one, for a shift of s.
  QuadraticTet tet =
      straightTet({Vec3(0.0), Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)});
  tet.middles[0].x += 0.1;
  EXPECT_NEAR(scaledJacobian(tet), 0.6 / 1.4, 1e-3);
}

// ---- meshes --------------------------------------------------------------------------------------

struct Given {
  VolumeMesh mesh;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> edges;
  std::vector<double> middles;
};

Vec3 pointAt(const std::vector<double>& points, std::size_t node) {
  return {points[3 * node], points[3 * node + 1], points[3 * node + 2]};
}

SecondOrderBuilder builderOf(const Given& given) {
  return SecondOrderBuilder(given.mesh.points, given.mesh.tetrahedra, given.triangles, given.edges,
                            given.middles);
}

SecondOrderMesh built(const Given& given) {
  SecondOrderBuilder builder = builderOf(given);
  finish(builder);
  return builder.result();
}

/// The ten-node elements of a result.
std::vector<QuadraticTet> elementsOf(const Given& given, const SecondOrderMesh& result) {
  std::vector<double> points = given.mesh.points;
  for (std::size_t i = 0; i < result.movedNodes.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      points[3 * result.movedNodes[i] + k] = result.movedPoints[3 * i + k];
    }
  }
  std::map<Edge, Vec3> middles;
  for (std::size_t e = 0; e < result.edges.size() / 2; ++e) {
    middles[{result.edges[2 * e], result.edges[2 * e + 1]}] = pointAt(result.middles, e);
  }
  std::vector<QuadraticTet> tets;
  for (std::size_t t = 0; t < given.mesh.tetrahedra.size() / 4; ++t) {
    std::array<Vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      corners[k] = pointAt(points, given.mesh.tetrahedra[4 * t + k]);
    }
    QuadraticTet tet = straightTet(corners);
    for (std::size_t e = 0; e < 6; ++e) {
      const auto found = middles.find(edgeOf(given.mesh.tetrahedra[4 * t + kTetEdges[e].from],
                                             given.mesh.tetrahedra[4 * t + kTetEdges[e].to]));
      if (found != middles.end()) tet.middles[e] = found->second;
    }
    tets.push_back(tet);
  }
  return tets;
}

void expectValid(const Given& given, const SecondOrderMesh& result) {
  ASSERT_TRUE(result.isReadable);
  EXPECT_GT(result.minScaledJacobian, 0.0);
  Real least = 1.0;
  for (const QuadraticTet& tet : elementsOf(given, result)) {
    const Sampled sampled = sample(tet, 6);
    EXPECT_GT(sampled.least, 0.0L);
    least = std::min(least, sampled.least / sampled.largest);
  }
  EXPECT_LE(result.minScaledJacobian, least + 1e-12L);
}

/// Gives each edge of the triangles the middle that `project` makes of the one halfway.
template <class Project>
void curve(Given& given, const Project& project) {
  std::map<Edge, Vec3> middles;
  for (std::size_t i = 0; i < given.triangles.size(); ++i) {
    const std::uint32_t a = given.triangles[i];
    const std::uint32_t b = given.triangles[i % 3 == 2 ? i - 2 : i + 1];
    const Vec3 from = pointAt(given.mesh.points, a);
    const Vec3 to = pointAt(given.mesh.points, b);
    middles[edgeOf(a, b)] = project(0.5 * (from + to), from, to);
  }
  for (const auto& [edge, middle] : middles) {
    given.edges.insert(given.edges.end(), {edge.first, edge.second});
    given.middles.insert(given.middles.end(), {middle.x, middle.y, middle.z});
  }
}

Given meshed(const SurfaceMesh& surface) {
  MeshRun run(surface.points, surface.triangles, MeshOptions{});
  while (run.advance(100'000) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  return {run.volume(), run.surface().triangles, {}, {}};
}

Given ball(int n) {
  Given given = meshed(geodesicSphere(n));
  curve(given,
        [](const Vec3& halfway, const Vec3&, const Vec3&) { return glm::normalize(halfway); });
  return given;
}

TEST(SecondOrder, VolumeOfABallConvergesAtThirdOrderAtLeast) {
  std::vector<double> errors;
  for (const int n : {2, 4, 8}) {
    const Given given = ball(n);
    const SecondOrderMesh result = built(given);
    expectValid(given, result);
    EXPECT_TRUE(result.straightened.empty());
    double volume = 0.0;
    for (const QuadraticTet& tet : elementsOf(given, result)) volume += volumeOf(tet);
    errors.push_back(std::fabs(volume - 4.0 / 3.0 * std::numbers::pi));
  }
  EXPECT_LT(errors[1], errors[0] / 8.0);
  EXPECT_LT(errors[2], errors[1] / 8.0);
  EXPECT_LT(errors[2], 1e-4);
}

TEST(SecondOrder, StatisticsCountAllElements) {
  const Given given = ball(3);
  const SecondOrderMesh result = built(given);
  const std::vector<QuadraticTet> elements = elementsOf(given, result);
  std::array<std::uint32_t, kScaledJacobianBins> histogram{};
  std::vector<double> all;
  std::vector<std::uint32_t> curved;
  for (std::uint32_t t = 0; t < elements.size(); ++t) {
    const double own = scaledJacobian(elements[t]);
    const bool isCurved = own < 1.0 - 1e-9;
    all.push_back(isCurved ? own : 1.0);
    if (isCurved) curved.push_back(t);
    ++histogram[std::min<std::size_t>(19, static_cast<std::size_t>(all.back() * 20.0))];
  }
  EXPECT_EQ(result.histogram, histogram);
  EXPECT_EQ(result.curvedTetrahedra, curved);
  EXPECT_EQ(result.minScaledJacobian, *std::ranges::min_element(all));
  double sum = 0.0;
  for (const double own : all) sum += own;
  EXPECT_NEAR(result.meanScaledJacobian, sum / static_cast<double>(all.size()), 1e-12);
  ASSERT_EQ(result.worst.size(), kWorstCurvedElements);
  const std::vector<double> inOrder = [all]() mutable {
    std::ranges::sort(all);
    return std::move(all);
  }();
  for (std::size_t i = 0; i < result.worst.size(); ++i) {
    EXPECT_EQ(all[result.worst[i]], inOrder[i]);
  }
}

TEST(SecondOrder, MiddlesOfGivenEdgesAreKept) {
  const Given given = ball(3);
  const SecondOrderMesh result = built(given);
  std::map<Edge, Vec3> middles;
  for (std::size_t e = 0; e < result.edges.size() / 2; ++e) {
    EXPECT_LT(result.edges[2 * e], result.edges[2 * e + 1]);
    middles[{result.edges[2 * e], result.edges[2 * e + 1]}] = pointAt(result.middles, e);
  }
  EXPECT_EQ(middles.size(), result.edges.size() / 2);
  for (std::size_t e = 0; e < given.edges.size() / 2; ++e) {
    const auto found = middles.find({given.edges[2 * e], given.edges[2 * e + 1]});
    ASSERT_NE(found, middles.end());
    EXPECT_EQ(found->second, pointAt(given.middles, e));
  }
}

/// A cube with a spherical cavity, whose curved edges reach into the elements.
Given cubeAroundBall(int n) {
  Given given = meshed(cubeWithSphericalCavity(2, n));
  const Vec3 centre(0.5);
  curve(given, [centre](const Vec3& halfway, const Vec3& from, const Vec3& to) {
    const auto isOnBall = [centre](const Vec3& at) {
      return std::fabs(glm::length(at - centre) - 0.3) < 1e-6;
    };
    if (!isOnBall(from) || !isOnBall(to)) return halfway;
    return centre + 0.3 * glm::normalize(halfway - centre);
  });
  return given;
}

TEST(SecondOrder, ElementsAroundACoarseCavityAreValid) {
  for (const int n : {1, 2, 3}) {
    const Given given = cubeAroundBall(n);
    const SecondOrderMesh result = built(given);
    expectValid(given, result);
    EXPECT_TRUE(result.straightened.empty());
  }
}

/// A cube of n^3 cubes, where the middle of one edge of the face z = 1 is pushed inward by `depth` edges.
Given dentedCube(int n, double depth) {
  Given given;
  given.mesh = cubeOfTetrahedra(n);
  given.triangles = surfaceOf(given.mesh, surfaceNodeCount(n)).triangles;
  curve(given, [n, depth](const Vec3& halfway, const Vec3& from, const Vec3& to) {
    const double h = 1.0 / n;
    const bool isDented = std::fabs(from.z + to.z - 2.0) < 1e-9 &&
                          std::fabs(from.y - to.y) < 1e-9 &&
                          std::fabs(halfway.x - (n / 2 + 0.5) * h) < 1e-9 &&
                          std::fabs(halfway.y - (n / 2) * h) < 1e-9;
    return isDented ? halfway - Vec3(0.0, 0.0, depth * h) : halfway;
  });
  return given;
}

TEST(SecondOrder, TangledElementsAreUntangledByNodesInside) {
  for (const double depth : {0.3, 0.5, 0.7, 0.9}) {
    const Given given = dentedCube(4, depth);
    const SecondOrderMesh result = built(given);
    expectValid(given, result);
    EXPECT_TRUE(result.straightened.empty());
    EXPECT_GT(result.edges.size(), 2U);
    for (const std::uint32_t node : result.movedNodes) EXPECT_GE(node, surfaceNodeCount(4));
  }
}

TEST(SecondOrder, CornersInsideMoveWhereMiddlesDoNotSuffice) {
  const SecondOrderMesh result = built(dentedCube(4, 0.9));
  EXPECT_TRUE(result.straightened.empty());
  EXPECT_FALSE(result.movedNodes.empty());
}

TEST(SecondOrder, AnEdgeThatNothingInsideCanFollowIsStraightenedAndListed) {
  const Given given = dentedCube(4, 2.5);
  const SecondOrderMesh result = built(given);
  expectValid(given, result);
  ASSERT_EQ(result.straightened.size(), 2U);
  const Vec3 halfway = 0.5 * (pointAt(given.mesh.points, result.straightened[0]) +
                              pointAt(given.mesh.points, result.straightened[1]));
  EXPECT_LT(glm::length(halfway - Vec3(0.625, 0.5, 1.0)), 1e-9);
}

TEST(SecondOrder, DoesNotDependOnSlices) {
  const Given given = dentedCube(4, 0.4);
  const SecondOrderMesh whole = built(given);
  for (const std::uint32_t budget : {1U, 37U, 1000U}) {
    SecondOrderBuilder builder = builderOf(given);
    EXPECT_GT(slicesOf(builder, budget), 1U);
    const SecondOrderMesh& result = builder.result();
    EXPECT_EQ(result.edges, whole.edges);
    EXPECT_EQ(result.middles, whole.middles);
    EXPECT_EQ(result.movedPoints, whole.movedPoints);
    EXPECT_EQ(result.scaledJacobians, whole.scaledJacobians);
  }
}

TEST(SecondOrder, RandomDentsAreValid) {
  Random random(7);
  for (int i = 0; i < 6; ++i) {
    Given given;
    given.mesh = cubeOfTetrahedra(3, 0.15, random.bits());
    given.triangles = surfaceOf(given.mesh, surfaceNodeCount(3)).triangles;
    const double bend = random.between(0.02, 0.3);
    curve(given, [&](const Vec3& halfway, const Vec3&, const Vec3&) {
      return halfway + random.inBox(bend);
    });
    expectValid(given, built(given));
  }
}

TEST(SecondOrder, WithoutCurvedEdgesAllIsStraight) {
  Given given;
  given.mesh = cubeOfTetrahedra(3);
  given.triangles = surfaceOf(given.mesh, surfaceNodeCount(3)).triangles;
  curve(given, [](const Vec3& halfway, const Vec3&, const Vec3&) { return halfway; });
  const SecondOrderMesh result = built(given);
  EXPECT_TRUE(result.edges.empty());
  EXPECT_TRUE(result.curvedTetrahedra.empty());
  EXPECT_EQ(result.minScaledJacobian, 1.0);
  EXPECT_EQ(result.meanScaledJacobian, 1.0);
}

TEST(SecondOrder, InvertedElementsAreListed) {
  Given given;
  given.mesh = cubeOfTetrahedra(2);
  std::swap(given.mesh.tetrahedra[20], given.mesh.tetrahedra[21]);
  const SecondOrderMesh result = built(given);
  EXPECT_EQ(result.invertedTetrahedra, std::vector<std::uint32_t>{5});
  EXPECT_EQ(result.minScaledJacobian, -1.0);
}

TEST(SecondOrder, WrongArraysAreNotReadable) {
  Given given;
  given.mesh = cubeOfTetrahedra(1);
  given.edges = {0, 1};
  EXPECT_FALSE(built(given).isReadable);
  given.middles = {0.0, 0.0, std::nan("")};
  EXPECT_FALSE(built(given).isReadable);
  given.middles = {0.5, 0.0, 0.0};
  EXPECT_TRUE(built(given).isReadable);
  given.edges = {0, 8};
  EXPECT_FALSE(built(given).isReadable);
}

}  // namespace
}  // namespace tetrafront::testing
