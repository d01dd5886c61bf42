#include "quality/verify_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/mesh_validator.h"
#include "support/random.h"
#include "support/tet_grids.h"

namespace tetrafront::testing {
namespace {

/// A valid mesh and its surface, to be damaged. The tests' own validator must agree each time.
struct Specimen {
  static constexpr int kCubes = 4;
  VolumeMesh mesh = cubeOfTetrahedra(kCubes, 0.15);
  SurfaceMesh surface = surfaceOf(mesh, surfaceNodeCount(kCubes));

  [[nodiscard]] MeshDefects judged() const {
    const MeshDefects defects = verifyMesh(mesh, surface);
    EXPECT_EQ(defects.count() == 0, complaintAbout(mesh, surface).empty())
        << "the validator says: " << complaintAbout(mesh, surface);
    return defects;
  }
  std::uint32_t& node(std::size_t tetrahedron, std::size_t k) {
    return mesh.tetrahedra[4 * tetrahedron + k];
  }
  /// A tetrahedron with an interior node, and the index of this node in it.
  std::pair<std::size_t, std::size_t> innerCorner() {
    std::size_t h = 0;
    while (mesh.tetrahedra[h] < surfaceNodeCount(kCubes)) ++h;
    return {h / 4, h % 4};
  }
};

TEST(VerifyMeshTest, AcceptsAValidMesh) {
  const Specimen specimen;
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.count(), 0U);
  EXPECT_NEAR(defects.meshVolume, 1.0, 1e-13);
  EXPECT_NEAR(defects.surfaceVolume, 1.0, 1e-13);
}

TEST(VerifyMeshTest, AcceptsUnusedNodes) {
  Specimen specimen;
  specimen.mesh.points.insert(specimen.mesh.points.end(), {0.5, 0.5, 0.5});
  EXPECT_EQ(specimen.judged().count(), 0U);
}

/// Its volumes are sums of needles and of cones over its whole length, so their rounding exceeds
/// the volume tolerance.
TEST(VerifyMeshTest, AcceptsALongAndThinRotatedPlate) {
  Specimen specimen;
  for (std::vector<double>* points : {&specimen.mesh.points, &specimen.surface.points}) {
    for (std::size_t i = 0; i < points->size(); i += 3) {
      const Vec3 p((*points)[i] * 40.0, (*points)[i + 1], (*points)[i + 2] * 1e-7);
      const Vec3 turned(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z);
      (*points)[i] = turned.x;
      (*points)[i + 1] = 0.28 * turned.y - 0.96 * turned.z;
      (*points)[i + 2] = 0.96 * turned.y + 0.28 * turned.z;
    }
  }
  const MeshDefects defects = verifyMesh(specimen.mesh, specimen.surface);
  EXPECT_GT(std::fabs(defects.meshVolume - defects.surfaceVolume), 1e-10 * defects.surfaceVolume)
      << "else this shows nothing";
  EXPECT_EQ(defects.count(), 0U);
}

TEST(VerifyMeshTest, FindsAnInvertedTetrahedron) {
  Specimen specimen;
  std::swap(specimen.node(7, 0), specimen.node(7, 1));
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.invertedTetrahedra, 1U);
  EXPECT_GT(defects.overlappingFaces + defects.missingTriangles, 0U);
}

TEST(VerifyMeshTest, FindsADegenerateTetrahedron) {
  Specimen specimen;
  specimen.mesh =
      cubeOfTetrahedra(Specimen::kCubes);  // no jitter: all coordinates are multiples of a quarter
  // Moving an interior node onto the plane of the opposite face flattens this tetrahedron.
  const auto [t, k] = specimen.innerCorner();
  const auto place = [&](std::size_t corner, std::size_t axis) -> double& {
    return specimen.mesh.points[3 * std::size_t{specimen.node(t, corner)} + axis];
  };
  for (std::size_t a = 0; a < 3; ++a) {
    place(k, a) = place((k + 1) % 4, a) + 0.25 * (place((k + 2) % 4, a) - place((k + 1) % 4, a)) +
                  0.25 * (place((k + 3) % 4, a) - place((k + 1) % 4, a));
  }
  EXPECT_GE(specimen.judged().invertedTetrahedra, 1U);
}

TEST(VerifyMeshTest, FindsAMissingTetrahedron) {
  Specimen specimen;
  specimen.mesh.tetrahedra.resize(specimen.mesh.tetrahedra.size() - 4);
  const MeshDefects defects = specimen.judged();
  EXPECT_GT(defects.extraBoundaryFaces, 0U);
  EXPECT_EQ(defects.wrongVolume, 1U);
  EXPECT_EQ(defects.invertedTetrahedra, 0U);
}

TEST(VerifyMeshTest, FindsADuplicateTetrahedron) {
  Specimen specimen;
  const auto [t, k] = specimen.innerCorner();
  // Another order of the same nodes, with the same sign.
  specimen.mesh.tetrahedra.insert(
      specimen.mesh.tetrahedra.end(),
      {specimen.node(t, 1), specimen.node(t, 2), specimen.node(t, 0), specimen.node(t, 3)});
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.duplicateTetrahedra, 1U);
  EXPECT_GT(defects.nonManifoldFaces, 0U);
  EXPECT_EQ(defects.wrongVolume, 1U);
}

TEST(VerifyMeshTest, FindsATetrahedronAcrossOthers) {
  Specimen specimen;
  const auto [t, k] = specimen.innerCorner();
  const std::uint32_t other = specimen.node((t + 40) % (specimen.mesh.tetrahedra.size() / 4), 0);
  specimen.node(t, k) = other;
  EXPECT_GT(specimen.judged().count(), 0U);
}

TEST(VerifyMeshTest, FindsAFlippedSurfaceTriangle) {
  Specimen specimen;
  std::swap(specimen.surface.triangles[3], specimen.surface.triangles[4]);
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.missingTriangles, 1U);
  EXPECT_EQ(defects.extraBoundaryFaces, 1U);
}

TEST(VerifyMeshTest, FindsAnExtraOrMissingSurfaceTriangle) {
  Specimen fewer;
  fewer.surface.triangles.resize(fewer.surface.triangles.size() - 3);
  EXPECT_EQ(fewer.judged().extraBoundaryFaces, 1U);
  Specimen more;
  const auto [t, k] = more.innerCorner();
  // Two surface nodes without a common triangle.
  more.surface.triangles.insert(more.surface.triangles.end(), {0, 30, 60});
  EXPECT_EQ(more.judged().missingTriangles, 1U) << t << " " << k;
}

TEST(VerifyMeshTest, FindsMovedSurfaceNodes) {
  Specimen specimen;
  specimen.mesh.points[3 * 4] += 1e-15;
  EXPECT_EQ(specimen.judged().movedNodes, 1U);
}

TEST(VerifyMeshTest, FindsCoincidentNodes) {
  Specimen specimen;
  const auto [t, k] = specimen.innerCorner();
  const std::size_t from = 3 * std::size_t{specimen.node(t, (k + 1) % 4)};
  const std::size_t to = 3 * std::size_t{specimen.node(t, k)};
  for (std::size_t a = 0; a < 3; ++a) specimen.mesh.points[to + a] = specimen.mesh.points[from + a];
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.coincidentNodes, 1U);
  EXPECT_GT(defects.invertedTetrahedra, 0U);
}

TEST(VerifyMeshTest, CountsEveryUsedNodeAtThePositionOfAnother) {
  // Positions on a coarse lattice, including 0 and -0: most occur many times.
  Specimen specimen;
  Random random(77);
  std::set<std::array<double, 3>> places;
  std::uint64_t expected = 0;
  std::set<std::uint32_t> used(specimen.mesh.tetrahedra.begin(), specimen.mesh.tetrahedra.end());
  for (const std::uint32_t node : used) {
    std::array<double, 3> place{};
    for (double& x : place) x = 0.5 * random.integer(-1, 1) * (random.coin() ? 1.0 : -1.0);
    std::copy(place.begin(), place.end(),
              specimen.mesh.points.begin() + 3 * static_cast<std::ptrdiff_t>(node));
    if (!places.insert(place).second) ++expected;
  }
  EXPECT_GT(expected, 50U);
  EXPECT_EQ(verifyMesh(specimen.mesh, specimen.surface).coincidentNodes, expected);
}

TEST(VerifyMeshTest, NoSliceExceedsItsBudget) {
  const Specimen specimen;
  MeshVerifier verifier(specimen.mesh, specimen.surface);
  std::size_t slices = 1;
  while (!verifier.advance(1)) ++slices;
  // Nodes are visited four times and tetrahedra four times; indices of both in one pass.
  EXPECT_GT(slices, specimen.mesh.points.size() + specimen.mesh.tetrahedra.size());
}

TEST(VerifyMeshTest, FindsInvalidIndicesAndCoordinates) {
  Specimen notFinite;
  notFinite.mesh.points[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(notFinite.judged().badNumbers, 0U);
  Specimen outOfRange;
  outOfRange.node(3, 2) = 1000000;
  EXPECT_EQ(outOfRange.judged().badNumbers, 1U);
}

TEST(VerifyMeshTest, AnEmptyMeshDoesNotFillASurface) {
  Specimen specimen;
  specimen.mesh.tetrahedra.clear();
  const MeshDefects defects = specimen.judged();
  EXPECT_EQ(defects.missingTriangles, specimen.surface.triangles.size() / 3);
  EXPECT_EQ(defects.wrongVolume, 1U);
}

TEST(VerifyMeshTest, SlicesGiveTheSameAsOneRun) {
  Specimen specimen;
  std::swap(specimen.node(7, 0), specimen.node(7, 1));
  const MeshDefects whole = specimen.judged();
  MeshVerifier verifier(specimen.mesh, specimen.surface);
  double fraction = 0.0;
  while (!verifier.advance(5)) {
    EXPECT_GE(verifier.fraction(), fraction);
    fraction = verifier.fraction();
  }
  EXPECT_EQ(verifier.defects().count(), whole.count());
  EXPECT_EQ(verifier.defects().meshVolume, whole.meshVolume);
}

}  // namespace
}  // namespace tetrafront::testing
