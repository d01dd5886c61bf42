/// The minimum quality of every default mesh. If the boundary triangles are good, then for any
/// solid and any way of filling it: no dihedral angle below 30 or above 135 degrees, shapes near
/// the regular one, and the target sizes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "support/hard_shapes.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"

namespace tetrafront {
namespace {

struct Solid {
  std::string name;
  std::variant<Model, SurfaceMesh> boundary;
  double size;  ///< uniform; 0: sizes of the given surface
  double meanRadiusRatio;
  double leastDihedral = 30.0;
  double greatestDihedral = 135.0;
  double edgesNearTarget = 0.95;
  BackgroundGrid sources{};
};
void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }

MeshRun finished(const Solid& solid, MeshOptions options) {
  options.size = solid.size;
  const auto* const model = std::get_if<Model>(&solid.boundary);
  const auto* const surface = std::get_if<SurfaceMesh>(&solid.boundary);
  MeshRun run = model != nullptr ? MeshRun(*model, solid.sources, options)
                                 : MeshRun(surface->points, surface->triangles, options);
  while (run.advance(10000) == MeshStatus::kRunning) {
  }
  return run;
}

void expectFloor(const Solid& solid, const MeshRun& run) {
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
  const QualitySummary quality = run.quality();
  EXPECT_GE(quality.minDihedral, solid.leastDihedral);
  EXPECT_LE(quality.maxDihedral, solid.greatestDihedral);
  EXPECT_GE(quality.meanRadiusRatio, solid.meanRadiusRatio);
  EXPECT_GE(run.statistics().edgesNearTarget, solid.edgesNearTarget);
}

/// Adds the patches of the second model to the first.
Model both(Model first, const Model& second) {
  const auto points = static_cast<std::uint32_t>(first.points.size());
  const auto lines = static_cast<std::uint32_t>(first.lines.size());
  first.points.insert(first.points.end(), second.points.begin(), second.points.end());
  for (Line line : second.lines) {
    for (std::uint32_t& point : line.points) point += points;
    first.lines.push_back(std::move(line));
  }
  for (Patch patch : second.patches) {
    for (Loop& loop : patch.loops) {
      for (OrientedLine& line : loop) line.line += lines;
    }
    first.patches.push_back(std::move(patch));
  }
  return first;
}

/// Sizes that grow from `least` at the pole of the unit sphere.
BackgroundGrid fineAtPole(double least) {
  SizeSource pole;
  pole.points[0] = Vec3(0.0, 0.0, 1.0);
  pole.size = least;
  pole.distance = 2.0 * least;
  pole.growth = 0.15;
  BackgroundGrid grid;
  grid.sources = {pole};
  return grid;
}

/// A sphere from an icosahedron with `rows` rows of triangles; its nodes are moved at random along
/// it by up to the given fraction of an edge.
SurfaceMesh sphere(double radius, int rows, double shaking, std::uint64_t seed) {
  SurfaceMesh surface = testing::geodesicSphere(rows);
  testing::Random random(seed);
  const double edge = std::sqrt(48.0 * std::numbers::pi / std::numbers::sqrt3 /
                                static_cast<double>(surface.triangles.size()));
  for (std::size_t i = 0; i < surface.points.size(); i += 3) {
    Vec3 position(surface.points[i], surface.points[i + 1], surface.points[i + 2]);
    position = glm::normalize(position + random.inBox(shaking * edge)) * radius;
    for (int k = 0; k < 3; ++k) surface.points[i + static_cast<std::size_t>(k)] = position[k];
  }
  return surface;
}

/// The volume between two such spheres. The inner one is rotated, because triangles that face each
/// other node by node would leave no choice of elements.
SurfaceMesh sphericalGap(double radius, int rows, double gap, int innerRows, double shaking = 0.0) {
  SurfaceMesh surface = sphere(radius, rows, shaking, 4);
  SurfaceMesh inner = sphere(radius - gap, innerRows, shaking, 104);
  testing::rotateRandomly(inner, 3);
  testing::turnInsideOut(inner);
  testing::append(surface, inner);
  return surface;
}

/// Elements with an angle out of range, including those limited by the boundary.
std::uint32_t beyond(const QualityStatistics& statistics) {
  return statistics.outOfRange + statistics.limitedByBoundary;
}

class QualityFloor : public ::testing::TestWithParam<Solid> {};

TEST_P(QualityFloor, HoldsForTheDefaultMesh) {
  const MeshRun run = finished(GetParam(), {});
  expectFloor(GetParam(), run);
  EXPECT_NEAR(run.statistics().meanEdge, 1.0, 0.12);
}

/// The exact fill makes almost no interior nodes: the optimizer must make all of them.
TEST_P(QualityFloor, HoldsAfterAFillWithoutInteriorNodes) {
  MeshOptions options;
  options.exactFillOnly = true;
  const MeshRun run = finished(GetParam(), options);
  expectFloor(GetParam(), run);
  EXPECT_NEAR(run.statistics().meanEdge, 1.0, 0.12);
}

class BesideCoarseTriangles : public ::testing::TestWithParam<Solid> {};

/// If sizes jump, the front puts nodes close to triangles much larger than the target elements; the
/// exact fill puts none there. The optimized mesh of the front must not be much worse than that of
/// the exact fill.
TEST_P(BesideCoarseTriangles, FrontAndExactFillGiveSimilarQuality) {
  MeshOptions options;
  const MeshRun usual = finished(GetParam(), options);
  options.exactFillOnly = true;
  const MeshRun filled = finished(GetParam(), options);
  ASSERT_EQ(usual.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(usual.volume(), usual.surface()), "");
  EXPECT_LT(beyond(usual.statistics()), 1.15 * beyond(filled.statistics()));
  EXPECT_GT(usual.quality().meanRadiusRatio, 0.97 * filled.quality().meanRadiusRatio);
}

class NeedleFloor : public ::testing::TestWithParam<Solid> {};

/// Spheres with a few needles and caps. Improving single elements leaves some of them, so the
/// elements around them must change too.
TEST_P(NeedleFloor, HoldsBesideNeedles) { expectFloor(GetParam(), finished(GetParam(), {})); }

SurfaceMesh plate(double length, double width, double thickness, int columns, int rows) {
  return testing::gridBox(Vec3(0.0), Vec3(length, width, thickness), {columns, rows, 1});
}

class CoarseFloor : public ::testing::TestWithParam<Solid> {};

/// Small meshes of solids one element thick, in which many elements are out of range at first.
TEST_P(CoarseFloor, HoldsInThinSolids) { expectFloor(GetParam(), finished(GetParam(), {})); }

class ThoroughFloor : public ::testing::TestWithParam<Solid> {};

/// Compared with the default mesh, no angle may be further out of range, no more elements may be
/// out of range, and the mean shape may not be worse.
TEST_P(ThoroughFloor, IsNotBelowTheDefault) {
  const MeshRun usual = finished(GetParam(), {});
  const QualitySummary byDefault = usual.quality();
  MeshOptions options;
  options.optimization = Optimization::kThorough;
  const MeshRun striving = finished(GetParam(), options);
  ASSERT_EQ(striving.status(), MeshStatus::kDone);
  EXPECT_EQ(testing::complaintAbout(striving.volume(), striving.surface()), "");
  const QualitySummary quality = striving.quality();
  constexpr double kRounding = 1e-9;
  EXPECT_GE(quality.minDihedral, std::min(byDefault.minDihedral, 30.0) - kRounding);
  EXPECT_LE(quality.maxDihedral, std::max(byDefault.maxDihedral, 135.0) + kRounding);
  EXPECT_GE(quality.meanRadiusRatio, byDefault.meanRadiusRatio - kRounding);
  EXPECT_LE(beyond(striving.statistics()), beyond(usual.statistics()));
}

/// Slices of the optimizer, and whether it has found nothing better.
struct Effort {
  std::size_t slices = 0;
  bool hasFoundNothingBetter = false;
  std::uint64_t fingerprint = 0;
};

Effort effortFor(const SurfaceMesh& surface, Optimization level) {
  MeshOptions options;
  options.optimization = level;
  MeshRun run(surface.points, surface.triangles, options);
  Effort effort;
  for (Phase phase = Phase::kCheck; run.advance(500) == MeshStatus::kRunning;
       phase = run.progress().phase) {
    if (phase == Phase::kOptimize) ++effort.slices;
  }
  effort.hasFoundNothingBetter = run.hasFoundNothingBetter();
  effort.fingerprint = run.fingerprint();
  return effort;
}

TEST(Optimize, ThoroughEndsEarlyIfTheBoundaryLeavesNothingToGain) {
  const SurfaceMesh surface = testing::gradedCube(8, 3);
  const Effort usual = effortFor(surface, Optimization::kDefault);
  const Effort thorough = effortFor(surface, Optimization::kThorough);
  EXPECT_TRUE(thorough.hasFoundNothingBetter);
  EXPECT_EQ(thorough.fingerprint, usual.fingerprint);
  EXPECT_LT(static_cast<double>(thorough.slices), 1.3 * static_cast<double>(usual.slices));
}

TEST(Optimize, ACancelledRunHasNotFoundOutThatNothingIsBetter) {
  const SurfaceMesh surface = testing::geodesicSphere(8);
  for (const Optimization level : {Optimization::kDefault, Optimization::kThorough}) {
    MeshOptions options;
    options.optimization = level;
    MeshRun run(surface.points, surface.triangles, options);
    while (run.progress().phase != Phase::kOptimize) {
      ASSERT_EQ(run.advance(100), MeshStatus::kRunning);
    }
    run.cancel();
    EXPECT_EQ(run.status(), MeshStatus::kCancelled);
    EXPECT_FALSE(run.hasFoundNothingBetter());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Optimize, QualityFloor,
    ::testing::Values(
        Solid{"sphere", testing::sphereModel(1.0), 0.15, 0.885},
        Solid{"cube", testing::boxModel(Vec3(0.0), Vec3(1.0)), 0.1, 0.885},
        Solid{"torus", testing::torusModel(1.0, 0.4), 0.125, 0.885},
        Solid{"bracket", testing::bracketModel(), 0.1, 0.885},
        Solid{"cavity", both(testing::boxModel(Vec3(-1.0), Vec3(1.0)), testing::sphereModel(0.5)),
              0.16, 0.885},
        Solid{"graded", testing::sphereModel(1.0), 0.4, 0.88, 30.0, 135.0, 0.95, fineAtPole(0.008)},
        Solid{"gapOfOneEdge", sphericalGap(0.6, 13, 0.05, 12), 0.0, 0.85},
        Solid{"gapOfHalfAnEdge", sphericalGap(1.0, 12, 0.05, 12), 0.0, 0.8, 17.0, 150.0, 0.935},
        Solid{"gapOfShakenTriangles", sphericalGap(0.4, 10, 0.05, 9, 0.2), 0.0, 0.795},
        Solid{"shellOfPoorTriangles", sphericalGap(1.0, 6, 0.3, 4, 0.25), 0.0, 0.84}),
    [](const auto& each) { return each.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Optimize, BesideCoarseTriangles,
    ::testing::Values(Solid{"finePatch", testing::cubeWithFinePatch(24), 0.0, 0.0},
                      Solid{"gradedCube", testing::gradedCube(12, 3), 0.0, 0.0}),
    [](const auto& each) { return each.param.name; });

INSTANTIATE_TEST_SUITE_P(Optimize, NeedleFloor,
                         ::testing::Values(Solid{"a", sphere(1.0, 6, 0.25, 2), 0.0, 0.845},
                                           Solid{"b", sphere(1.0, 6, 0.27, 7), 0.0, 0.845},
                                           Solid{"c", sphere(1.0, 7, 0.25, 2), 0.0, 0.86}),
                         [](const auto& each) { return each.param.name; });

INSTANTIATE_TEST_SUITE_P(Optimize, CoarseFloor,
                         ::testing::Values(Solid{"plateA", plate(3.6, 3.0, 0.8, 4, 3), 0.0, 0.65},
                                           Solid{"plateB", plate(3.6, 3.0, 0.6, 5, 4), 0.0, 0.65},
                                           Solid{"plateC", plate(4.5, 4.0, 0.8, 5, 4), 0.0, 0.65}),
                         [](const auto& each) { return each.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Optimize, ThoroughFloor,
    ::testing::Values(Solid{"cube", testing::boxModel(Vec3(0.0), Vec3(1.0)), 0.12, 0.0},
                      Solid{"gapOfHalfAnEdge", sphericalGap(0.5, 6, 0.05, 6), 0.0, 0.0},
                      Solid{"gapOfShakenTriangles", sphericalGap(0.4, 10, 0.05, 9, 0.2), 0.0, 0.0},
                      Solid{"sphereWithNeedles", sphere(1.0, 5, 0.28, 1), 0.0, 0.0},
                      Solid{"shellOfPoorTriangles", sphericalGap(1.0, 6, 0.3, 4, 0.25), 0.0, 0.0}),
    [](const auto& each) { return each.param.name; });

/// Hundreds of elements at needles miss every higher target. Degenerate elements must still be
/// improved if the boundary permits it.
TEST(OptimizeNeedles, DegenerateElementsAreImproved) {
  const std::vector<std::pair<SurfaceMesh, double>> solids{{testing::needleGear(24, 0.5), 2.0},
                                                           {testing::bentSheet(24, 0.1), 1.0},
                                                           {testing::needlePlate(4, 40, 0.5), 0.1}};
  for (const auto& [surface, leastDihedral] : solids) {
    MeshRun run(surface.points, surface.triangles, MeshOptions{});
    while (run.advance(10000) == MeshStatus::kRunning) {
    }
    ASSERT_EQ(run.status(), MeshStatus::kDone);
    EXPECT_EQ(testing::complaintAbout(run.volume(), run.surface()), "");
    EXPECT_GE(run.quality().minDihedral, leastDihedral);
  }
}

}  // namespace
}  // namespace tetrafront
