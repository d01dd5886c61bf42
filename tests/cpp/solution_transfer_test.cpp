/// Fields from one mesh to another.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "solution/clipped_tetrahedra.h"
#include "solution/mesh_locator.h"
#include "support/random.h"
#include "support/sampled_fields.h"
#include "support/tet_grids.h"
#include "tetrafront/solution.h"

namespace tetrafront::testing {
namespace {

TransferredSolution transferred(const VolumeMesh& from, const VolumeMesh& to,
                                const SolutionFields& fields, bool isConservative) {
  SolutionTransferrer transfer(from, to, fields, isConservative);
  while (!transfer.advance(500)) {
  }
  return transfer.result();
}

double wave(const Vec3& x) { return std::sin(6.0 * x.x) * std::cos(5.0 * x.y) + x.z; }
double jump(const Vec3& x) { return x.x + 0.5 * x.y < 0.7 ? 0.0 : 1.0; }

Corners randomTetrahedron(Random& random) {
  return {random.inBox(), random.inBox(), random.inBox(), random.inBox()};
}

double volumeOfPieces(const std::vector<Corners>& pieces) {
  double sum = 0.0;
  for (const Corners& piece : pieces) sum += volumeWithin(piece);
  return sum;
}

TEST(SolutionTransferTest, IntersectionsAreTheSameFromBothSides) {
  Random random(4841);
  TetrahedronClipper clipper;
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const Corners a = randomTetrahedron(random);
    const Corners b = randomTetrahedron(random);
    const double first = volumeOfPieces(clipper.clip(a, ClippingPlanes(b, {0, 1, 2, 3})));
    const double second = volumeOfPieces(clipper.clip(b, ClippingPlanes(a, {3, 1, 0, 2})));
    EXPECT_NEAR(first, second, 1e-14);
    EXPECT_LE(first, std::min(volumeWithin(a), volumeWithin(b)) * (1.0 + 1e-12));
    overlapping += first > 0.0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 500);
}

/// Volume of an intersection by sampling one of the tetrahedra.
TEST(SolutionTransferTest, IntersectionsHaveTheVolumeOfTheirSamples) {
  Random random(4842);
  TetrahedronClipper clipper;
  for (int i = 0; i < 20; ++i) {
    const Corners a = randomTetrahedron(random);
    const Corners b = randomTetrahedron(random);
    const BarycentricFrame inB(b);
    int inside = 0;
    constexpr int kSamples = 20'000;
    for (int k = 0; k < kSamples; ++k) {
      std::array<double, 3> cuts{random.unit(), random.unit(), random.unit()};
      std::ranges::sort(cuts);
      const Vec3 x = cuts[0] * a[0] + (cuts[1] - cuts[0]) * a[1] + (cuts[2] - cuts[1]) * a[2] +
                     (1.0 - cuts[2]) * a[3];
      inside += std::ranges::min(inB.at(x)) >= 0.0 ? 1 : 0;
    }
    const double share =
        volumeOfPieces(clipper.clip(a, ClippingPlanes(b, {0, 1, 2, 3}))) / volumeWithin(a);
    EXPECT_NEAR(share, static_cast<double>(inside) / kSamples, 0.02);
  }
}

TEST(SolutionTransferTest, ASmallerTetrahedronInsideIsKeptWhole) {
  const Corners large{Vec3(0.0), Vec3(10, 0, 0), Vec3(0, 10, 0), Vec3(0, 0, 10)};
  const Corners small{Vec3(1.0), Vec3(2, 1, 1), Vec3(1, 2, 1), Vec3(1, 1, 2)};
  TetrahedronClipper clipper;
  EXPECT_EQ(clipper.clip(small, ClippingPlanes(large, {0, 1, 2, 3})).size(), 1U);
  EXPECT_NEAR(volumeOfPieces(clipper.clip(large, ClippingPlanes(small, {0, 1, 2, 3}))), 1.0 / 6.0,
              1e-14);
  const Corners far{Vec3(20.0), Vec3(21, 20, 20), Vec3(20, 21, 20), Vec3(20, 20, 21)};
  EXPECT_TRUE(clipper.clip(far, ClippingPlanes(large, {0, 1, 2, 3})).empty());
}

TEST(SolutionTransferTest, LinearFieldsAreExact) {
  const VolumeMesh from = cubeOfTetrahedra(5, 0.15, 1);
  const VolumeMesh to = cubeOfTetrahedra(7, 0.15, 2);
  const Field linear = [](const Vec3& x) { return 3.0 - 2.0 * x.x + x.y + 0.25 * x.z; };
  const SolutionFields fields{atNodes(from, linear), {1}, {0}};
  const std::vector<double> expected = atNodes(to, linear);
  for (const bool isConservative : {false, true}) {
    const TransferredSolution result = transferred(from, to, fields, isConservative);
    for (std::size_t i = 0; i < expected.size(); ++i)
      ASSERT_NEAR(result.values[i], expected[i], 1e-11) << i << isConservative;
    EXPECT_EQ(result.outside, 0U);
  }
}

TEST(SolutionTransferTest, ASolutionStaysOnItsOwnMesh) {
  const VolumeMesh mesh = cubeOfTetrahedra(5, 0.15);
  const SolutionFields fields{atNodes(mesh, wave), {1}, {0}};
  const TransferredSolution interpolated = transferred(mesh, mesh, fields, false);
  const TransferredSolution projected = transferred(mesh, mesh, fields, true);
  for (std::size_t i = 0; i < fields.values.size(); ++i) {
    ASSERT_NEAR(interpolated.values[i], fields.values[i], 1e-13);
    ASSERT_NEAR(projected.values[i], fields.values[i], 1e-11);
  }
}

/// Two fields at nodes, one of them with three components, and one at elements with a jump.
TEST(SolutionTransferTest, IntegralsAreKept) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const VolumeMesh from = cubeOfTetrahedra(6, 0.15, seed);
    const VolumeMesh to = cubeOfTetrahedra(5, 0.15, seed + 10);
    SolutionFields fields{atNodes(from, wave), {1, 3, 1}, {0, 0, 1}};
    for (std::size_t i = 0; i < from.points.size() / 3; ++i) {
      const Vec3 x = nodePosition(from, i);
      for (const double value : {jump(x), 1e6 + wave(x), x.x * x.y}) fields.values.push_back(value);
    }
    for (std::size_t t = 0; t < from.tetrahedra.size(); t += 4)
      fields.values.push_back(1.0 + jump(nodePosition(from, from.tetrahedra[t])));
    const TransferredSolution result = transferred(from, to, fields, true);
    ASSERT_EQ(result.integralsBefore.size(), 5U);
    for (std::size_t c = 0; c < 5; ++c)
      EXPECT_NEAR(result.integralsAfter[c] / result.integralsBefore[c], 1.0, 1e-12) << c;
    // Means over elements stay in the range of the values.
    const std::size_t elements = to.tetrahedra.size() / 4;
    const std::vector<double> means(result.values.end() - static_cast<std::ptrdiff_t>(elements),
                                    result.values.end());
    EXPECT_GE(std::ranges::min(means), 1.0 - 1e-12);
    EXPECT_LE(std::ranges::max(means), 2.0 + 1e-12);
    // Interpolation does not keep integrals; the test would be void otherwise.
    const TransferredSolution interpolated = transferred(from, to, fields, false);
    EXPECT_GT(std::fabs(interpolated.integralsAfter[0] / result.integralsBefore[0] - 1.0), 1e-6);
  }
}

TEST(SolutionTransferTest, TheErrorFallsWithTheSecondOrder) {
  std::array<std::array<double, 2>, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const int n = level == 0 ? 6 : 12;
    const VolumeMesh from = cubeOfTetrahedra(n, 0.1, 1);
    const VolumeMesh to = cubeOfTetrahedra(n + 1, 0.1, 2);
    const SolutionFields fields{atNodes(from, wave), {1}, {0}};
    const std::vector<double> exact = atNodes(to, wave);
    for (const bool isConservative : {false, true}) {
      const TransferredSolution result = transferred(from, to, fields, isConservative);
      double sum = 0.0;
      for (std::size_t i = 0; i < exact.size(); ++i)
        sum += (result.values[i] - exact[i]) * (result.values[i] - exact[i]);
      errors[level][isConservative ? 1 : 0] = std::sqrt(sum / static_cast<double>(exact.size()));
    }
  }
  EXPECT_LT(errors[1][0], 0.32 * errors[0][0]);
  EXPECT_LT(errors[1][1], 0.32 * errors[0][1]);
}

TEST(SolutionTransferTest, RoundingAtTheBoundaryIsNotOutside) {
  const VolumeMesh from = cubeOfTetrahedra(4, 0.1, 1);
  VolumeMesh to = cubeOfTetrahedra(5, 0.1, 2);
  for (double& coordinate : to.points) coordinate = 0.5 + (1.0 + 1e-14) * (coordinate - 0.5);
  const SolutionFields fields{atNodes(from, wave), {1}, {0}};
  EXPECT_EQ(transferred(from, to, fields, false).outside, 0U);
}

TEST(SolutionTransferTest, NodesOutsideTakeTheNearestValue) {
  const VolumeMesh from = cubeOfTetrahedra(4, 0.1, 1);
  VolumeMesh to = cubeOfTetrahedra(5, 0.1, 2);
  for (double& coordinate : to.points) coordinate = 0.5 + 1.02 * (coordinate - 0.5);
  const Field field = [](const Vec3& x) { return x.x + 2.0 * x.y; };
  SolutionFields fields{atNodes(from, field), {1, 1}, {0, 1}};
  fields.values.insert(fields.values.end(), from.tetrahedra.size() / 4, 7.0);
  for (const bool isConservative : {false, true}) {
    const TransferredSolution result = transferred(from, to, fields, isConservative);
    EXPECT_EQ(result.outside, surfaceNodeCount(5));
    EXPECT_NEAR(result.farthest, 0.01 * std::sqrt(3.0), 1e-9);
    for (std::size_t i = 0; i < to.points.size() / 3; ++i)
      EXPECT_NEAR(result.values[i], field(glm::clamp(nodePosition(to, i), 0.0, 1.0)), 0.05);
    for (std::size_t t = to.points.size() / 3; t < result.values.size(); ++t)
      EXPECT_NEAR(result.values[t], 7.0, 1e-12);
  }
}

TEST(SolutionTransferTest, EveryPositionIsLocatedInAnElementAroundIt) {
  const VolumeMesh mesh = cubeOfTetrahedra(6, 0.15);
  Job job([&](Work& work) { return MeshLocator::build(work, mesh); });
  const MeshLocator locator = job.finish();
  Random random(4843);
  for (int i = 0; i < 2000; ++i) {
    Vec3 x = Vec3(0.5) + random.inBox(0.5);
    // Also nodes, and points of faces between the cubes.
    if (i % 3 == 0) x = nodePosition(mesh, static_cast<std::size_t>(random.integer(0, 300)));
    if (i % 3 == 1) x.z = 0.5;
    const MeshLocator::Location location = locator.locate(x);
    Vec3 sum(0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GE(location.weights[k], 0.0);
      sum += location.weights[k] *
             nodePosition(mesh, mesh.tetrahedra[4 * location.element.index() + k]);
    }
    EXPECT_NEAR(glm::length(sum - x), 0.0, 1e-9);
    EXPECT_EQ(location.distance, 0.0);
  }
}

}  // namespace
}  // namespace tetrafront::testing
