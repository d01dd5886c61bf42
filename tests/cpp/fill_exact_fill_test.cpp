/// The exact fill alone, on hard inputs: it must fill every closed embedded surface.

#include "fill/exact_fill.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/fingerprint.h"
#include "boundary/boundary.h"
#include "fill/exact_points.h"
#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

FillTask taskOf(const SurfaceMesh& surface) {
  FillTask task;
  for (std::uint32_t i = 0; i < testing::nodeCount(surface); ++i) {
    task.positions.push_back(testing::pointOf(surface, i));
  }
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const std::uint32_t* n = surface.triangles.data() + t;
    task.triangles.push_back({NodeId(n[0]), NodeId(n[2]), NodeId(n[1])});
  }
  return task;
}

ExactFill::State fill(FillTask task, FillResult& result, std::uint32_t budget = 1000,
                      unsigned order = 0) {
  ExactFill exactFill(std::move(task), order);
  ExactFill::State state = ExactFill::State::kRunning;
  while (state == ExactFill::State::kRunning) state = exactFill.advance(budget);
  result = exactFill.result();
  return state;
}

VolumeMesh meshOf(const SurfaceMesh& surface, const FillResult& result) {
  VolumeMesh mesh;
  mesh.points = surface.points;
  for (const Vec3& p : result.newPositions) mesh.points.insert(mesh.points.end(), {p.x, p.y, p.z});
  for (const auto& tetrahedron : result.tetrahedra) {
    for (const NodeId node : tetrahedron) mesh.tetrahedra.push_back(node.value);
  }
  return mesh;
}

std::uint64_t fingerprintOf(const VolumeMesh& mesh) {
  Fingerprint fingerprint;
  fingerprint.add(mesh.points);
  fingerprint.add(mesh.tetrahedra);
  return fingerprint.value();
}

struct NamedSurface {
  std::string name;
  SurfaceMesh surface;
};
void PrintTo(const NamedSurface& named, std::ostream* out) { *out << named.name; }

class EveryHardSurface : public ::testing::TestWithParam<NamedSurface> {};

TEST_P(EveryHardSurface, IsFilledExactly) {
  const SurfaceMesh& surface = GetParam().surface;
  FillResult result;
  ASSERT_EQ(fill(taskOf(surface), result), ExactFill::State::kDone);
  const VolumeMesh mesh = meshOf(surface, result);
  EXPECT_EQ(testing::complaintAbout(mesh, surface), "");
  FillResult again;
  fill(taskOf(surface), again, 1);
  EXPECT_EQ(fingerprintOf(meshOf(surface, again)), fingerprintOf(mesh));
}

SurfaceMesh rotated(SurfaceMesh surface) {
  testing::rotateRandomly(surface, 5);
  return surface;
}
SurfaceMesh changed(SurfaceMesh surface, double factor, double by) {
  testing::scale(surface, factor);
  testing::translate(surface, Vec3(by, -2.0 * by, 0.5 * by));
  return surface;
}

INSTANTIATE_TEST_SUITE_P(
    Fill, EveryHardSurface,
    ::testing::Values(
        NamedSurface{"cubeOfTwelveTriangles", testing::gridCube(1)},
        NamedSurface{"cubeParallel", testing::gridCube(8)},
        NamedSurface{"cubeAlternating", testing::gridCube(7, testing::Diagonals::kAlternating)},
        NamedSurface{"cubeUnionJack", testing::gridCube(6, testing::Diagonals::kUnionJack)},
        NamedSurface{"cubeRandom", testing::gridCube(9, testing::Diagonals::kRandom, 3)},
        NamedSurface{"cubeRotated", rotated(testing::gridCube(6, testing::Diagonals::kRandom))},
        NamedSurface{"sphere", testing::geodesicSphere(8)},
        NamedSurface{"sphereOfNeedles", testing::latitudeSphere(16, 32)},
        NamedSurface{"torus", testing::torus(1.0, 0.35, 48, 16)},
        NamedSurface{"torusKnot", testing::torusKnot(2, 3, 60, 6)},
        NamedSurface{"plate", testing::thinPlate(10, 1e-4)},
        NamedSurface{"cavity", testing::cubeWithSphericalCavity(10, 4)},
        NamedSurface{"shells", testing::nestedSpheres(5, 4)},
        NamedSurface{"island", testing::blockWithIsland(3)},
        NamedSurface{"sharedEdge", testing::cubesSharingEdge()},
        NamedSurface{"sharedNode", testing::cubesSharingNode()},
        NamedSurface{"schoenhardt30", testing::schoenhardtPrism(30.0)},
        NamedSurface{"schoenhardt5999", testing::schoenhardtPrism(59.99)},
        NamedSurface{"schoenhardtTower", testing::schoenhardtTower(10, 50.0)},
        NamedSurface{"schoenhardtCavities", testing::schoenhardtCavities(10, 50.0)},
        NamedSurface{"schoenhardtPairAtAnEdge", testing::schoenhardtPair(50.0)},
        NamedSurface{"schoenhardtTiny", changed(testing::schoenhardtPair(50.0), 1e-9, 0.0)},
        NamedSurface{"schoenhardtFarAway", changed(testing::schoenhardtPrism(50.0), 1.0, 1e6)},
        NamedSurface{"chazelle1", testing::chazellePolyhedron(1, 0.1)},
        NamedSurface{"chazelle3", testing::chazellePolyhedron(3, 0.01)},
        NamedSurface{"chazelle6", testing::chazellePolyhedron(6, 0.01)},
        NamedSurface{"saddleSlab", testing::saddleSlab(6, 0.01)},
        NamedSurface{"wedge2", testing::wedge(2.0, 4)},
        NamedSurface{"wedgeHundredth", testing::wedge(0.01, 4)},
        NamedSurface{"wedgeMillionth", testing::wedge(1e-6, 4)},
        NamedSurface{"slit2", testing::slitBlock(2.0, 4)},
        NamedSurface{"slitMillionth", testing::slitBlock(1e-6, 4)},
        NamedSurface{"slitRotated", rotated(testing::slitBlock(1e-5, 3))},
        NamedSurface{"spikes", testing::spikySphere(4, 0.05, 1)},
        NamedSurface{"bar", testing::coarseBar(64, 1000.0)},
        NamedSurface{"tube", testing::coarseTube(64, 0.95, 1000.0)},
        NamedSurface{"finePatch", testing::cubeWithFinePatch(20)},
        NamedSurface{"graded", testing::gradedCube(8, 6)},
        NamedSurface{"blocks", testing::randomBlocks(5, 0.5, 1)}),
    [](const auto& each) { return each.param.name; });

/// Points are added on the boundary only when swaps make no more progress. Otherwise each edge of a
/// needle would get some, and their edges would block the swaps of others.
TEST(ExactFill, FillsNeedlesInFewSteps) {
  SurfaceMesh surface = testing::spikySphere(8, 0.05, 1);
  testing::stretch(surface, {1.0, 1e-3, 1e-6});
  ExactFill exactFill(taskOf(surface));
  int steps = 0;
  while (exactFill.advance(1000) == ExactFill::State::kRunning) ++steps;
  EXPECT_EQ(testing::complaintAbout(meshOf(surface, exactFill.result()), surface), "");
  EXPECT_LT(steps, 200);
}

/// Hundreds of nodes of long needles are nearly on one sphere. If the mesh of the nodes were not
/// Delaunay there, most edges would have to be recovered, and each would add elements.
TEST(ExactFill, FillsRingsOfNeedlesWithFewElements) {
  const SurfaceMesh surface = rotated(testing::torus(1.0, 0.2, 4, 200));
  FillResult result;
  ASSERT_EQ(fill(taskOf(surface), result), ExactFill::State::kDone);
  EXPECT_EQ(testing::complaintAbout(meshOf(surface, result), surface), "");
  EXPECT_LT(result.tetrahedra.size(), 5 * testing::triangleCount(surface));
}

/// A boundary point that no other can replace is retried only when something around it has changed.
TEST(ExactFill, RemovesPointsFromBulgingBoundariesInFewSteps) {
  std::vector<Vec2> outline;
  constexpr int kPieces = 50;
  const std::array<Vec2, 5> corners{{{0, 0}, {3, 0}, {3, 2}, {0, 2}, {0, 0}}};
  for (std::size_t edge = 0; edge < 4; ++edge) {
    const Vec2 along = corners[edge + 1] - corners[edge];
    for (int i = 0; i < kPieces; ++i) {
      const double t = static_cast<double>(i) / kPieces;
      outline.push_back(corners[edge] + along * t +
                        Vec2(along.y, -along.x) * (4e-3 * t * (1.0 - t)));
    }
  }
  const SurfaceMesh surface = testing::extruded(outline, 0.7, 1, 1);
  ExactFill exactFill(taskOf(surface));
  int steps = 0;
  while (exactFill.advance(1000) == ExactFill::State::kRunning) ++steps;
  EXPECT_EQ(testing::complaintAbout(meshOf(surface, exactFill.result()), surface), "");
  EXPECT_LT(steps, 700);
}

/// Needles of the flat faces cross each other in one plane, up to rounding.
TEST(ExactFill, FillsRotatedPlatesOfNeedlesCompletely) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SurfaceMesh surface = testing::needlePlate(3, 24, 0.05);
    testing::rotateRandomly(surface, seed);
    FillResult result;
    ASSERT_EQ(fill(taskOf(surface), result), ExactFill::State::kDone) << "seed " << seed;
    EXPECT_EQ(testing::complaintAbout(meshOf(surface, result), surface), "") << "seed " << seed;
  }
}

/// The limit counts work, so the outcome does not depend on the slices.
TEST(ExactFill, FailsAtItsLimit) {
  const FillTask task = taskOf(testing::needleGear(12, 0.05));
  std::uint64_t enough = 1;
  const auto stateWith = [&](std::uint64_t limit, std::uint32_t budget) {
    ExactFill exactFill(task, 0, limit);
    ExactFill::State state = ExactFill::State::kRunning;
    while (state == ExactFill::State::kRunning) state = exactFill.advance(budget);
    return state;
  };
  while (stateWith(enough, 1) == ExactFill::State::kFailed && enough < 1'000'000) enough *= 2;
  EXPECT_GT(enough, 100U);
  for (const std::uint32_t budget : {1U, 7U, 100'000U}) {
    EXPECT_EQ(stateWith(enough, budget), ExactFill::State::kDone) << "slices of " << budget;
    EXPECT_EQ(stateWith(enough / 2, budget), ExactFill::State::kFailed) << "slices of " << budget;
  }
}

/// If doubles cannot hold a point, everything except the volume around it is filled.
TEST(ExactFill, LeavesOpenOnlyTheVolumeAroundPointsThatDoublesCannotHold) {
  const SurfaceMesh surface = testing::flatPocket();
  FillResult result;
  ASSERT_EQ(fill(taskOf(surface), result), ExactFill::State::kPartial);
  ASSERT_FALSE(result.tetrahedra.empty());
  ASSERT_EQ(result.facetOfOpenFace.size(), result.openFaces.size());
  const VolumeMesh mesh = meshOf(surface, result);
  SurfaceMesh filled;
  filled.points = mesh.points;
  const std::set<FacetId> open(result.openTriangles.begin(), result.openTriangles.end());
  EXPECT_EQ(open.size(), result.openTriangles.size()) << "each triangle once";
  for (std::uint32_t t = 0; t < surface.triangles.size() / 3; ++t) {
    if (open.contains(FacetId(t))) continue;
    const auto first = surface.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(t);
    filled.triangles.insert(filled.triangles.end(), first, first + 3);
  }
  // The open faces are counter-clockwise seen from the open volume, and therefore outward for the
  // filled one.
  for (const auto& face : result.openFaces) {
    for (const NodeId node : face) filled.triangles.push_back(node.value);
  }
  EXPECT_EQ(testing::complaintAbout(mesh, filled), "");
}

TEST(ExactFill, FillsInEveryOrderOfTheNodes) {
  const SurfaceMesh surface = testing::randomBlocks(4, 0.5, 1);
  std::set<std::uint64_t> fingerprints;
  for (unsigned order = 0; order < ExactFill::kOrders; ++order) {
    FillResult result;
    ASSERT_EQ(fill(taskOf(surface), result, 1000, order), ExactFill::State::kDone);
    const VolumeMesh mesh = meshOf(surface, result);
    EXPECT_EQ(testing::complaintAbout(mesh, surface), "");
    fingerprints.insert(fingerprintOf(mesh));
  }
  EXPECT_EQ(fingerprints.size(), ExactFill::kOrders) << "some orders give the same mesh";
}

TEST(ExactFill, AddsNoUnnecessaryPoints) {
  FillResult result;
  ASSERT_EQ(fill(taskOf(testing::geodesicSphere(4)), result), ExactFill::State::kDone);
  EXPECT_TRUE(result.newPositions.empty());
  ASSERT_EQ(fill(taskOf(testing::schoenhardtTower(7, 40.0)), result), ExactFill::State::kDone);
  EXPECT_EQ(result.newPositions.size(), 7U) << "each prism needs one";
}

TEST(ExactFill, NamesATriangleOfEachTetrahedronsPocket) {
  // Two separate spheres: each tetrahedron names a triangle of its own sphere.
  SurfaceMesh surface = testing::geodesicSphere(2);
  SurfaceMesh other = testing::geodesicSphere(2);
  testing::translate(other, Vec3(3.0, 0.0, 0.0));
  testing::append(surface, other);
  FillResult result;
  ASSERT_EQ(fill(taskOf(surface), result), ExactFill::State::kDone);
  const std::size_t half = surface.triangles.size() / 6;
  for (std::size_t t = 0; t < result.tetrahedra.size(); ++t) {
    const bool right = testing::pointOf(surface, result.tetrahedra[t][0].value).x > 1.5;
    ASSERT_EQ(result.facetOfTetrahedron[t].index() >= half, right);
  }
}

TEST(ExactFill, HasNoResultIfTheTrianglesAreNotAClosedBoundary) {
  FillTask open = taskOf(testing::gridCube(2));
  open.triangles.pop_back();
  FillResult result;
  EXPECT_EQ(fill(open, result), ExactFill::State::kFailed);
  // A prism that crosses a cube.
  SurfaceMesh crossing = testing::gridCube(1);
  SurfaceMesh prism = testing::schoenhardtPrism(30.0);
  testing::translate(prism, Vec3(0.3, 0.4, 0.5));
  testing::append(crossing, prism);
  EXPECT_EQ(fill(taskOf(crossing), result), ExactFill::State::kFailed);
  EXPECT_TRUE(result.tetrahedra.empty());
}

TEST(ExactPoints, SignsOfConstructedPointsAreExact) {
  ExactPoints points;
  testing::Random random(7);
  for (int i = 0; i < 500; ++i) {
    const NodeId a = points.add(random.inBox());
    const NodeId b = points.add(random.inBox());
    const NodeId c = points.add(random.inBox());
    const DyadicVec3 origin = points.exact(a);
    const DyadicVec3 ab = points.exact(b) - origin;
    const DyadicVec3 ac = points.exact(c) - origin;
    const DyadicVec3 inPlane =
        origin + ab * Dyadic(random.between(-1.0, 1.0)) + ac * Dyadic(random.between(-1.0, 1.0));
    const NodeId d = points.add(inPlane);
    EXPECT_FALSE(points.isDouble(d));
    EXPECT_EQ(points.orient(a, b, c, d), 0);
    // The point is off the plane by far less than the last bit of a double.
    const DyadicVec3 above = inPlane + cross(ab, ac) * Dyadic(0x1p-300);
    const NodeId e = points.add(above);
    EXPECT_EQ(points.orient(a, b, c, e), 1);
    EXPECT_EQ(points.orient(a, c, b, e), -1);
    EXPECT_EQ(points.position(e), points.position(d));
  }
}

/// Filters may leave a sign open but must not return a wrong one. Tested at all heights at which
/// one filter after the other decides, far from the origin, and for points that differ only by
/// rounding.
TEST(ExactPoints, SignsNearAPlaneAreExact) {
  testing::Random random(11);
  for (const double offset : {0.0, 1e6}) {
    for (int power = 20; power < 140; ++power) {
      ExactPoints points;
      const Vec3 far(offset, -2.0 * offset, 0.5 * offset);
      const NodeId a = points.add(far + random.inBox());
      const NodeId b = points.add(far + random.inBox());
      const NodeId c = points.add(far + random.inBox());
      const DyadicVec3 origin = points.exact(a);
      const DyadicVec3 ab = points.exact(b) - origin;
      const DyadicVec3 ac = points.exact(c) - origin;
      const DyadicVec3 up = cross(ab, ac) * Dyadic(std::ldexp(1.0, -power));
      const auto pointAt = [&](double s, double r, double height) {
        return points.add(origin + ab * Dyadic(s) + ac * Dyadic(r) + up * Dyadic(height));
      };
      const double s = random.between(-1.0, 1.0);
      std::vector<NodeId> near;
      for (const double height : {-1.0, 0.0, 1.0}) {
        near.push_back(pointAt(s, s, height));
        near.push_back(pointAt(random.between(-1.0, 1.0), random.between(-1.0, 1.0), height));
      }
      for (std::size_t i = 0; i < near.size(); ++i) {
        const int sign = static_cast<int>(i / 2) - 1;
        ASSERT_EQ(points.orient(a, b, c, near[i]), sign) << "height 2^-" << power;
        for (std::size_t j = 0; j < near.size(); ++j) {
          for (const NodeId third : {a, near[(j + 1) % near.size()]}) {
            ASSERT_EQ(points.orient(near[i], near[j], third, b),
                      points.exactVolume(near[i], near[j], third, b).sign());
          }
        }
      }
    }
  }
}

TEST(MeshRun, UsesOnlyTheExactFillIfRequested) {
  const SurfaceMesh surface = testing::schoenhardtTower(4, 50.0);
  MeshOptions options;
  options.exactFillOnly = true;
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  EXPECT_EQ(run.recovery().filled, 1U);
  EXPECT_EQ(run.recovery().steinerPoints, 4U);
  EXPECT_EQ(run.recovery().starred, 0U);
  EXPECT_EQ(run.counters().pops, 0U);
}

/// The open volume is filled together with elements around it. Points that this removes again are
/// not counted.
TEST(MeshRun, FillsAFlatPocketInParts) {
  const SurfaceMesh surface = testing::flatPocket();
  MeshOptions options;
  options.exactFillOnly = true;
  options.optimization = Optimization::kNone;
  MeshRun run(surface.points, surface.triangles, options);
  while (run.advance(1000) == MeshStatus::kRunning) {
  }
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  const std::size_t inside = (run.volume().points.size() - run.surface().points.size()) / 3;
  EXPECT_EQ(run.recovery().steinerPoints, inside) << "removed points must not count";
}

}  // namespace
}  // namespace tetrafront
