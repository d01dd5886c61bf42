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

  [[nodiscard]] MeshDefects verified() const {
    const MeshDefects defects = verifyMesh(mesh, surface);
    EXPECT_EQ(defects.count() == 0, complaintAbout(mesh, surface).empty())
        << "the validator reports: " << complaintAbout(mesh, surface);
    return defects;
  }
  std::uint32_t& node(std::size_t tetrahedron, std::size_t k) {
    return mesh.tetrahedra[4 * tetrahedron + k];
  }
  /// A corner of a tetrahedron.
  struct Corner {
    std::size_t tetrahedron;
    std::size_t index;
  };
  /// Returns a corner that is an interior node.
  Corner innerCorner() {
    std::size_t i = 0;
    while (mesh.tetrahedra[i] < surfaceNodeCount(kCubes)) ++i;
    return {i / 4, i % 4};
  }
};

bool names(const MeshDefects& defects, EntityKind kind, std::uint32_t index) {
  return std::ranges::any_of(defects.examples, [&](const Entity& entity) {
    return entity.kind == kind && entity.index == index;
  });
}

TEST(VerifyMeshTest, AcceptsAValidMesh) {
  const Specimen specimen;
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.count(), 0U);
  EXPECT_NEAR(defects.meshVolume, 1.0, 1e-13);
  EXPECT_NEAR(defects.surfaceVolume, 1.0, 1e-13);
  EXPECT_TRUE(defects.examples.empty());
}

TEST(VerifyMeshTest, AcceptsUnusedNodes) {
  Specimen specimen;
  specimen.mesh.points.insert(specimen.mesh.points.end(), {0.5, 0.5, 0.5});
  EXPECT_EQ(specimen.verified().count(), 0U);
}

/// Its volumes are sums of needles and of cones over its whole length, so their rounding exceeds
/// the volume tolerance.
TEST(VerifyMeshTest, AcceptsALongAndThinRotatedPlate) {
  Specimen specimen;
  for (std::vector<double>* points : {&specimen.mesh.points, &specimen.surface.points}) {
    for (std::size_t i = 0; i < points->size(); i += 3) {
      const Vec3 p((*points)[i] * 40.0, (*points)[i + 1], (*points)[i + 2] * 1e-7);
      const Vec3 rotated(0.6 * p.x - 0.8 * p.z, p.y, 0.8 * p.x + 0.6 * p.z);
      (*points)[i] = rotated.x;
      (*points)[i + 1] = 0.28 * rotated.y - 0.96 * rotated.z;
      (*points)[i + 2] = 0.96 * rotated.y + 0.28 * rotated.z;
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
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.invertedTetrahedra, 1U);
  EXPECT_GT(defects.overlappingFaces + defects.missingTriangles, 0U);
  EXPECT_TRUE(names(defects, EntityKind::kTetrahedron, 7));
}

TEST(VerifyMeshTest, FindsADegenerateTetrahedron) {
  Specimen specimen;
  specimen.mesh =
      cubeOfTetrahedra(Specimen::kCubes);  // no jitter: all coordinates are multiples of a quarter
  // Moving an interior node onto the plane of the opposite face flattens this tetrahedron.
  const auto [t, k] = specimen.innerCorner();
  const auto position = [&](std::size_t corner, std::size_t axis) -> double& {
    return specimen.mesh.points[3 * std::size_t{specimen.node(t, corner)} + axis];
  };
  for (std::size_t a = 0; a < 3; ++a) {
    position(k, a) = position((k + 1) % 4, a) +
                     0.25 * (position((k + 2) % 4, a) - position((k + 1) % 4, a)) +
                     0.25 * (position((k + 3) % 4, a) - position((k + 1) % 4, a));
  }
  EXPECT_GE(specimen.verified().invertedTetrahedra, 1U);
}

TEST(VerifyMeshTest, FindsAMissingTetrahedron) {
  Specimen specimen;
  specimen.mesh.tetrahedra.resize(specimen.mesh.tetrahedra.size() - 4);
  const MeshDefects defects = specimen.verified();
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
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.duplicateTetrahedra, 1U);
  const auto copy = static_cast<std::uint32_t>(specimen.mesh.tetrahedra.size() / 4 - 1);
  EXPECT_TRUE(names(defects, EntityKind::kTetrahedron, copy));
  EXPECT_GT(defects.nonManifoldFaces, 0U);
  EXPECT_EQ(defects.wrongVolume, 1U);
}

TEST(VerifyMeshTest, FindsATetrahedronAcrossOthers) {
  Specimen specimen;
  const auto [t, k] = specimen.innerCorner();
  const std::uint32_t other = specimen.node((t + 40) % (specimen.mesh.tetrahedra.size() / 4), 0);
  specimen.node(t, k) = other;
  EXPECT_GT(specimen.verified().count(), 0U);
}

TEST(VerifyMeshTest, FindsAFlippedSurfaceTriangle) {
  Specimen specimen;
  std::swap(specimen.surface.triangles[3], specimen.surface.triangles[4]);
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.missingTriangles, 1U);
  EXPECT_EQ(defects.extraBoundaryFaces, 1U);
  EXPECT_TRUE(names(defects, EntityKind::kTriangle, 1));
}

TEST(VerifyMeshTest, FindsAnExtraOrMissingSurfaceTriangle) {
  Specimen fewer;
  fewer.surface.triangles.resize(fewer.surface.triangles.size() - 3);
  EXPECT_EQ(fewer.verified().extraBoundaryFaces, 1U);
  Specimen more;
  const auto [t, k] = more.innerCorner();
  // Two surface nodes without a common triangle.
  more.surface.triangles.insert(more.surface.triangles.end(), {0, 30, 60});
  EXPECT_EQ(more.verified().missingTriangles, 1U) << t << " " << k;
}

TEST(VerifyMeshTest, FindsMovedSurfaceNodes) {
  Specimen specimen;
  specimen.mesh.points[3 * 4] += 1e-15;
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.movedNodes, 1U);
  EXPECT_TRUE(names(defects, EntityKind::kNode, 4));
}

TEST(VerifyMeshTest, FindsAVolumeThatDiffersByOneHundredMillionth) {
  /// Returns the defects of a mesh with a coordinate of a corner of the cube moved.
  const auto moved = [](double by) {
    Specimen specimen;
    specimen.mesh.points[0] += by;
    return specimen.verified();
  };
  // The volume is linear in one coordinate.
  constexpr double kStep = 1e-3;
  const MeshDefects coarse = moved(kStep);
  const double slope = (coarse.meshVolume - coarse.surfaceVolume) / kStep;
  ASSERT_NE(slope, 0.0);
  const auto changedBy = [&](double relative) {
    return moved(relative * coarse.surfaceVolume / slope);
  };
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(changedBy(sign * 1e-8).wrongVolume, 1U) << sign;
    EXPECT_EQ(changedBy(sign * 1e-12).wrongVolume, 0U) << sign;
  }
}

TEST(VerifyMeshTest, FindsCoincidentNodes) {
  Specimen specimen;
  const auto [t, k] = specimen.innerCorner();
  const std::size_t from = 3 * std::size_t{specimen.node(t, (k + 1) % 4)};
  const std::size_t to = 3 * std::size_t{specimen.node(t, k)};
  for (std::size_t a = 0; a < 3; ++a) specimen.mesh.points[to + a] = specimen.mesh.points[from + a];
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.coincidentNodes, 1U);
  EXPECT_TRUE(names(defects, EntityKind::kNode, static_cast<std::uint32_t>(from / 3)) ||
              names(defects, EntityKind::kNode, static_cast<std::uint32_t>(to / 3)));
  EXPECT_GT(defects.invertedTetrahedra, 0U);
}

TEST(VerifyMeshTest, CountsEveryUsedNodeAtThePositionOfAnother) {
  // Positions on a coarse lattice, including 0 and -0: most occur many times.
  Specimen specimen;
  Random random(77);
  std::set<std::array<double, 3>> positions;
  std::uint64_t expected = 0;
  std::set<std::uint32_t> used(specimen.mesh.tetrahedra.begin(), specimen.mesh.tetrahedra.end());
  for (const std::uint32_t node : used) {
    std::array<double, 3> position{};
    for (double& x : position) x = 0.5 * random.integer(-1, 1) * (random.coin() ? 1.0 : -1.0);
    std::copy(position.begin(), position.end(),
              specimen.mesh.points.begin() + 3 * static_cast<std::ptrdiff_t>(node));
    if (!positions.insert(position).second) ++expected;
  }
  EXPECT_GT(expected, 50U);
  EXPECT_EQ(verifyMesh(specimen.mesh, specimen.surface).coincidentNodes, expected);
}

TEST(VerifyMeshTest, NoSliceExceedsItsBudget) {
  const Specimen specimen;
  MeshVerifier verifier(specimen.mesh, specimen.surface);
  std::size_t slices = 1;
  while (!verifier.advance(1)) ++slices;
  // Nodes are visited four times, and tetrahedra twice one by one.
  const std::size_t nodes = specimen.mesh.points.size() / 3;
  const std::size_t tetrahedra = specimen.mesh.tetrahedra.size() / 4;
  EXPECT_GT(slices, 4 * nodes + 2 * tetrahedra);
}

TEST(VerifyMeshTest, FindsInvalidIndicesAndCoordinates) {
  Specimen notFinite;
  notFinite.mesh.points[5] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(notFinite.verified().invalidNumbers, 0U);
  Specimen outOfRange;
  outOfRange.node(3, 2) = 1000000;
  const MeshDefects defects = outOfRange.verified();
  EXPECT_EQ(defects.invalidNumbers, 1U);
  EXPECT_TRUE(names(defects, EntityKind::kTetrahedron, 3));
}

TEST(VerifyMeshTest, NamesOneEntityPerKindOfDefect) {
  Specimen specimen;
  for (const std::size_t node : {4, 5, 6}) specimen.mesh.points[3 * node] += 1e-15;
  std::swap(specimen.node(7, 0), specimen.node(7, 1));
  const MeshDefects defects = specimen.verified();
  EXPECT_GE(defects.movedNodes, 3U);
  const auto nodes = std::ranges::count(defects.examples, EntityKind::kNode, &Entity::kind);
  EXPECT_EQ(nodes, 1);
  EXPECT_TRUE(names(defects, EntityKind::kNode, 4));
  EXPECT_TRUE(names(defects, EntityKind::kTetrahedron, 7));
}

TEST(VerifyMeshTest, AnEmptyMeshDoesNotFillASurface) {
  Specimen specimen;
  specimen.mesh.tetrahedra.clear();
  const MeshDefects defects = specimen.verified();
  EXPECT_EQ(defects.missingTriangles, specimen.surface.triangles.size() / 3);
  EXPECT_EQ(defects.wrongVolume, 1U);
}

TEST(VerifyMeshTest, SlicesGiveTheSameAsOneRun) {
  Specimen specimen;
  std::swap(specimen.node(7, 0), specimen.node(7, 1));
  const MeshDefects whole = specimen.verified();
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
