/// Solids with interfaces: several regions in one mesh, whose elements match at the interfaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "boundary/boundary.h"
#include "field/size_field.h"
#include "optimize/optimizer.h"
#include "quality/verify_mesh.h"
#include "support/mesh_validator.h"
#include "support/models.h"
#include "support/shapes.h"
#include "support/trace_reader.h"
#include "tetrafront/mesher.h"
#include "tetrafront/preview.h"
#include "tetrafront/trace.h"
#include "volume/region_mesher.h"

namespace tetrafront {
namespace {

using testing::ModelBuilder;

MeshRun finished(MeshRun run, std::uint32_t budget = 4096) {
  while (run.advance(budget) == MeshStatus::kRunning) {
  }
  return run;
}

MeshRun meshed(const Model& model, double size, MeshOptions options = {}) {
  options.size = size;
  return finished(MeshRun(model, {}, options));
}

MeshRun filled(const SurfaceMesh& surface, const MeshOptions& options = {}) {
  return finished(MeshRun(surface.points, surface.triangles, options));
}

std::set<DiagnosticCode> errorsOf(const MeshRun& run) {
  std::set<DiagnosticCode> codes;
  for (const Diagnostic& diagnostic : run.diagnostics()) {
    if (diagnostic.severity == Severity::kError) codes.insert(diagnostic.code);
  }
  return codes;
}

/// Expects a mesh that is valid by the tests' own validator and by the engine's, with this number of regions; returns
/// their volumes, ascending.
std::vector<double> validVolumes(const MeshRun& run, std::size_t regions) {
  EXPECT_EQ(run.status(), MeshStatus::kDone);
  for (const Diagnostic& diagnostic : run.diagnostics()) {
    EXPECT_EQ(diagnostic.severity, Severity::kInformation) << static_cast<int>(diagnostic.code);
  }
  const VolumeMesh mesh = run.volume();
  EXPECT_EQ(testing::complaintAbout(mesh, run.surface()), "");
  EXPECT_EQ(verifyMesh(mesh, run.surface()).count(), 0U);
  EXPECT_EQ(std::set(mesh.regions.begin(), mesh.regions.end()).size(), regions);
  EXPECT_EQ(run.statistics().regions.size(), regions);
  std::vector<double> volumes = testing::regionVolumes(run.surface());
  for (std::size_t r = 0; r < volumes.size(); ++r)
    EXPECT_NEAR(run.statistics().regions.at(r).volume, volumes[r], 1e-9 * volumes[r]);
  std::ranges::sort(volumes);
  EXPECT_EQ(volumes.size(), regions);
  return volumes;
}

/// The planar patches of a box cut into unit cubes; neighbours share lines and patches.
Model dividedBoxModel(const std::array<int, 3>& counts) {
  ModelBuilder builder;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (int level = 0; level <= counts[axis]; ++level) {
      for (int i = 0; i < counts[u]; ++i) {
        for (int j = 0; j < counts[v]; ++j) {
          const auto corner = [&](int di, int dj) {
            Vec3 at(0.0);
            at[static_cast<int>(axis)] = level;
            at[static_cast<int>(u)] = i + di;
            at[static_cast<int>(v)] = j + dj;
            return at;
          };
          builder.patch(
              PatchType::kPlanar,
              {builder.polygon({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)})});
        }
      }
    }
  }
  return builder.model;
}

TEST(MeshInterfaces, TwoBoxesShareOnePatch) {
  const MeshRun run = meshed(dividedBoxModel({2, 1, 1}), 0.3);
  for (const double volume : validVolumes(run, 2)) EXPECT_NEAR(volume, 1.0, 1e-12);
  const auto reported =
      std::ranges::find(run.diagnostics(), DiagnosticCode::kNestedRegions, &Diagnostic::code);
  ASSERT_NE(reported, run.diagnostics().end());
  EXPECT_EQ(reported->values, (std::vector{2.0, 0.0}));
}

TEST(MeshInterfaces, TooManyElementsAreThoseOfAllRegions) {
  MeshOptions options;
  options.optimization = Optimization::kNone;
  const MeshRun run = meshed(dividedBoxModel({2, 1, 1}), 0.3, options);
  const std::vector<std::uint32_t> regions = run.volume().regions;
  const auto ofFirst = static_cast<std::uint32_t>(std::ranges::count(regions, 0U));
  options.maxTetrahedra = ofFirst + 20;
  const SizeField field = SizeField::uniform(0.3);
  const PlainFrontMaker maker;
  RegionMesher mesher(run.surface(), field, options, maker);
  Job<MeshStatus> job([&mesher](Work& work) { return mesher.run(work); });
  job.finish();
  const std::vector<Diagnostic> reported = mesher.diagnostics();
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(reported[0].code, DiagnosticCode::kTooManyElements);
  EXPECT_EQ(reported[0].values[1], ofFirst + 20);
  EXPECT_GT(reported[0].values[0], ofFirst + 20);
  EXPECT_LT(reported[0].values[0], 3.0 * static_cast<double>(regions.size()));
}

/// Positions of the corners of the elements of a region, in order.
std::vector<double> cornersOfRegion(const VolumeMesh& mesh, std::uint32_t region) {
  std::vector<double> corners;
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    if (mesh.regions[i / 4] != region) continue;
    const auto first = mesh.points.begin() + 3 * static_cast<std::ptrdiff_t>(mesh.tetrahedra[i]);
    corners.insert(corners.end(), first, first + 3);
  }
  return corners;
}

/// Returns the mesh of all regions of closed surfaces, each optimized as in a run.
VolumeMesh meshOfRegions(SurfaceMesh boundary) {
  std::vector<Diagnostic> diagnostics;
  EXPECT_TRUE(closeBoundary(boundary, BoundarySource::kGivenSurface, diagnostics).isValid);
  const SizeField field = SizeField::uniform(0.25);
  const PlainFrontMaker maker;
  RegionMesher mesher(boundary, field, {}, maker);
  Job<MeshStatus> job([&mesher](Work& work) { return mesher.run(work); });
  EXPECT_EQ(job.finish(), MeshStatus::kDone);
  RegionMeshes meshes = mesher.take();
  for (RegionMesh& region : meshes.regions) {
    MeshOptimizer optimizer(std::move(region.mesh), field, Optimization::kDefault);
    Job<> optimizing([&optimizer](Work& work) { return optimizer.run(work); });
    optimizing.finish();
    region.mesh = optimizer.take();
  }
  return toVolumeMesh(joined(std::move(meshes)));
}

/// The second cube is far away and much coarser: a common front would have other buckets of sizes and another grid.
TEST(MeshInterfaces, ARegionDoesNotDependOnOthers) {
  const SurfaceMesh cube = testing::gridCube(5);
  SurfaceMesh other = testing::gridCube(2);
  testing::scale(other, 1.5);
  testing::translate(other, Vec3(10.0, 0.0, 0.0));
  const std::vector<double> alone = cornersOfRegion(meshOfRegions(cube), 0);
  ASSERT_FALSE(alone.empty());
  SurfaceMesh both = cube;
  testing::append(both, other);
  EXPECT_EQ(cornersOfRegion(meshOfRegions(both), 0), alone);
  SurfaceMesh turned = other;
  testing::append(turned, cube);
  EXPECT_EQ(cornersOfRegion(meshOfRegions(turned), 1), alone);
}

TEST(MeshInterfaces, TwentySevenCubes) {
  const MeshRun run = meshed(dividedBoxModel({3, 3, 3}), 0.5);
  for (const double volume : validVolumes(run, 27)) EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(MeshInterfaces, InterfacesMeetInALine) {
  // Three sectors of a triangular prism around its middle line, at which three interfaces meet.
  ModelBuilder builder;
  const std::array<Vec3, 3> corners{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 1.7, 0)};
  const Vec3 middle(1, 0.6, 0);
  const Vec3 up(0, 0, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& a = corners[k];
    const Vec3& b = corners[(k + 1) % 3];
    builder.patch(PatchType::kPlanar, {builder.polygon({a, b, b + up, a + up})});
    builder.patch(PatchType::kPlanar, {builder.polygon({a, a + up, middle + up, middle})});
    builder.patch(PatchType::kPlanar, {builder.polygon({a, b, middle})});
    builder.patch(PatchType::kPlanar, {builder.polygon({a + up, b + up, middle + up})});
  }
  const std::vector<double> volumes = validVolumes(meshed(builder.model, 0.3), 3);
  EXPECT_NEAR(volumes[0] + volumes[1] + volumes[2], 1.7, 1e-12);
  EXPECT_NEAR(volumes[2], 0.6, 1e-12);
}

/// A tube of sections with four Coons patches each, with discs at both ends and between the
/// sections.
Model dividedTube(int pieces) {
  ModelBuilder builder;
  std::vector<Loop> rings;
  for (int k = 0; k <= pieces; ++k) {
    rings.push_back(builder.circle(Vec3(0, 0, k), 0.5, 4));
    builder.patch(PatchType::kPlanar, {rings.back()});
    if (k == 0) continue;
    for (std::size_t arc = 0; arc < 4; ++arc) {
      const auto positionAt = [&](int level, std::size_t at) {
        const auto ring = static_cast<std::size_t>(level);
        return builder.model.points[builder.model.lines[rings[ring][at % 4].line].points.front()];
      };
      const OrientedLine ahead =
          builder.straight(positionAt(k - 1, arc + 1), positionAt(k, arc + 1));
      OrientedLine behind = builder.straight(positionAt(k - 1, arc), positionAt(k, arc));
      behind.reversed = !behind.reversed;
      const auto ring = static_cast<std::size_t>(k);
      builder.patch(PatchType::kCoons,
                    {{rings[ring - 1][arc], ahead, {rings[ring][arc].line, true}, behind}});
    }
  }
  return builder.model;
}

TEST(MeshInterfaces, TubeWithDiscs) {
  const std::vector<double> volumes = validVolumes(meshed(dividedTube(3), 0.25), 3);
  for (const double volume : volumes) {
    EXPECT_LT(volume, 0.25 * std::numbers::pi);
    EXPECT_GT(volume, 0.22 * std::numbers::pi);
  }
}

/// A ball in a box, connected to it by an interface around its equator: the regions are the ball,
/// and the box above and below the interface.
TEST(MeshInterfaces, BallInABox) {
  ModelBuilder builder;
  const auto square = [](double z) {
    return std::vector<Vec3>{{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
  };
  const Loop equator = builder.circle(Vec3(0.0), 0.5, 4);
  builder.patch(PatchType::kPlanar, {builder.polygon(square(0.0)), equator});
  for (const double pole : {-0.5, 0.5}) {
    std::vector<std::uint32_t> meridians;
    for (std::size_t arc = 0; arc < 4; ++arc) {
      const Vec3 foot = builder.model.points[builder.model.lines[equator[arc].line].points.front()];
      std::vector<Vec3> positions;
      for (int i = 0; i <= 8; ++i) {
        const double angle = 0.5 * std::numbers::pi * i / 8;
        positions.push_back(std::cos(angle) * foot + Vec3(0, 0, pole * std::sin(angle)));
      }
      positions.back() = Vec3(0, 0, pole);
      meridians.push_back(builder.line(LineType::kSpline, positions));
    }
    for (std::size_t arc = 0; arc < 4; ++arc) {
      builder.patch(PatchType::kBarnhillGregoryNielson,
                    {{equator[arc], {meridians[(arc + 1) % 4], false}, {meridians[arc], true}}});
    }
    const std::vector<Vec3> middle = square(0.0);
    const std::vector<Vec3> end = square(2.0 * pole);
    builder.patch(PatchType::kPlanar, {builder.polygon(end)});
    for (std::size_t k = 0; k < 4; ++k) {
      builder.patch(PatchType::kPlanar,
                    {builder.polygon({middle[k], middle[(k + 1) % 4], end[(k + 1) % 4], end[k]})});
    }
  }
  const std::vector<double> volumes = validVolumes(meshed(builder.model, 0.15), 3);
  EXPECT_NEAR(volumes[0] + volumes[1] + volumes[2], 8.0, 1e-9);
  EXPECT_NEAR(volumes[1], volumes[2], 1e-2) << "above and below";
  EXPECT_LT(volumes[0], 4.0 / 3.0 * std::numbers::pi * 0.125)
      << "octants bulge less than the sphere";
  EXPECT_GT(volumes[0], 0.4);
}

TEST(MeshInterfaces, AnInterfaceWithAHoleIsAnOpenLine) {
  ModelBuilder builder;
  builder.model = dividedBoxModel({2, 1, 1});
  for (Patch& patch : builder.model.patches) {
    // The interface is the only patch in the plane x = 1.
    bool isInterface = true;
    for (const OrientedLine& walked : patch.loops.front()) {
      for (const std::uint32_t point : builder.model.lines[walked.line].points)
        isInterface = isInterface && builder.model.points[point].x == 1.0;
    }
    if (!isInterface) continue;
    std::vector<Loop> loops = patch.loops;
    loops.push_back(builder.polygon({{1, 0.3, 0.3}, {1, 0.7, 0.3}, {1, 0.7, 0.7}, {1, 0.3, 0.7}}));
    patch.loops = loops;
  }
  const MeshRun run = meshed(builder.model, 0.3);
  EXPECT_EQ(run.status(), MeshStatus::kInvalidInput);
  EXPECT_EQ(errorsOf(run), std::set{DiagnosticCode::kOpenEdge});
  EXPECT_EQ(run.diagnostics().size(), 4U) << "every line of the hole";
}

/// A ring of eight cubes with a single interface: the same region is on both sides of it. The check
/// before meshing reports this.
TEST(MeshInterfaces, AnInterfaceThatSeparatesNothingIsNamedAtOnce) {
  Model model = dividedBoxModel({3, 3, 1});
  const Vec3 kept(1.0, 0.5, 0.5);
  std::erase_if(model.patches, [&](const Patch& patch) {
    Vec3 centre(0.0);
    for (const OrientedLine& walked : patch.loops.front()) {
      for (const std::uint32_t point : model.lines[walked.line].points)
        centre += model.points[point] / 8.0;
    }
    const Vec3 fromAxis = glm::abs(centre - Vec3(1.5, 1.5, 0.5));
    const double near = std::min(fromAxis.x, fromAxis.y);
    const double far = std::max(fromAxis.x, fromAxis.y);
    const bool isLid = far < 0.25;  // of the hole in the middle
    const bool isBetween = near > 0.25 && far < 1.25 && fromAxis.z < 0.25;  // neighbours
    return isLid || (isBetween && glm::length(centre - kept) > 0.25);
  });
  for (const bool isPreview : {true, false}) {
    MeshOptions options;
    options.size = 0.5;
    const std::vector<Diagnostic> reported =
        isPreview ? previewModel(model, {}, options).diagnostics : meshed(model, 0.5).diagnostics();
    std::vector<Diagnostic> errors;
    std::ranges::copy_if(reported, std::back_inserter(errors), [](const Diagnostic& diagnostic) {
      return diagnostic.severity == Severity::kError;
    });
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].code, DiagnosticCode::kDanglingSheet);
    ASSERT_EQ(errors[0].entities.size(), 1U) << "the patch";
    EXPECT_EQ(errors[0].entities[0].kind, EntityKind::kPatch);
    EXPECT_NEAR(glm::length(errors[0].position - kept), 0.0, 0.5);
  }
}

TEST(MeshInterfaces, GivenSurfacesKeepTheirInterfaces) {
  for (const std::array<int, 3>& counts : {std::array{2, 1, 1}, std::array{2, 2, 2}}) {
    SurfaceMesh surface = testing::dividedBox(counts, 3);
    testing::rotateRandomly(surface, 4);
    testing::shuffle(surface, 5);
    const auto regions = static_cast<std::size_t>(counts[0] * counts[1] * counts[2]);
    for (const double volume : validVolumes(filled(surface), regions))
      EXPECT_NEAR(volume, 1.0, 1e-12);
  }
}

/// With InnerShells::kRegions, shells that share no line with their surroundings are interfaces.
TEST(MeshInterfaces, InnerShellsCanBeRegions) {
  constexpr int kDepth = 4;
  const SurfaceMesh spheres = testing::nestedSpheres(kDepth, 4);
  const std::size_t trianglesEach = spheres.triangles.size() / 3 / kDepth;
  MeshOptions options;
  options.innerShells = InnerShells::kRegions;
  const MeshRun run = filled(spheres, options);
  const std::vector<double> volumes = validVolumes(run, kDepth);
  double sum = 0.0;
  for (const double volume : volumes) sum += volume;
  SurfaceMesh outermost = spheres;
  outermost.triangles.resize(3 * trianglesEach);
  EXPECT_NEAR(sum, testing::enclosedVolume(outermost), 1e-9 * sum);
  const SurfaceMesh surface = run.surface();
  for (std::uint32_t t = 0; t < surface.triangles.size() / 3; ++t)
    EXPECT_EQ(surface.isInterface(t), t >= trianglesEach) << t;
  const auto nesting =
      std::ranges::find(run.diagnostics(), DiagnosticCode::kNestedRegions,
                        [](const Diagnostic& diagnostic) { return diagnostic.code; });
  ASSERT_NE(nesting, run.diagnostics().end());
  EXPECT_EQ(nesting->values, (std::vector<double>{kDepth, 0.0})) << "regions, cavities";
  EXPECT_EQ(filled(spheres).statistics().regions.size(), 2U) << "else every second is empty";
}

TEST(MeshInterfaces, EveryWayOfMeshingKeepsThem) {
  const SurfaceMesh surface = testing::dividedBox({2, 2, 1}, 3);
  std::vector<MeshOptions> ways(4);
  ways[0].optimization = Optimization::kNone;
  ways[1].optimization = Optimization::kThorough;
  ways[2].order = FrontOrder::kSmallestFirst;
  ways[3].exactFillOnly = true;
  for (const MeshOptions& options : ways) validVolumes(filled(surface, options), 4);
}

TEST(MeshInterfaces, SlicesDoNotMatter) {
  const SurfaceMesh surface = testing::dividedBox({2, 2, 2}, 2);
  const MeshRun whole = filled(surface);
  const MeshRun sliced = finished(MeshRun(surface.points, surface.triangles, MeshOptions{}), 7);
  EXPECT_EQ(whole.fingerprint(), sliced.fingerprint());
  EXPECT_EQ(whole.volume().regions, sliced.volume().regions);
}

/// The front bounds everything that is not filled: the volume of a region is that of its tetrahedra
/// plus that enclosed by its faces of the front.
TEST(MeshInterfaces, ACancelledRunHasTheRestInItsFront) {
  const SurfaceMesh surface = testing::dividedBox({2, 2, 2}, 3);
  MeshRun run(surface.points, surface.triangles, MeshOptions{});
  bool wasPartial = false;
  for (int slice = 0; slice < 600 && run.advance(20) == MeshStatus::kRunning; ++slice) {
    if (run.progress().phase != Phase::kVolume) continue;
    const VolumeMesh mesh = run.volume();
    if (mesh.points.empty()) continue;
    EXPECT_EQ(run.progress().frontFaces, mesh.front.size() / 3);
    const auto positionOf = [&](std::uint32_t node) {
      return Vec3(mesh.points[3 * node], mesh.points[3 * node + 1], mesh.points[3 * node + 2]);
    };
    double volume = 0.0;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
      const Vec3 a = positionOf(mesh.tetrahedra[t]);
      volume += glm::dot(positionOf(mesh.tetrahedra[t + 1]) - a,
                         glm::cross(positionOf(mesh.tetrahedra[t + 2]) - a,
                                    positionOf(mesh.tetrahedra[t + 3]) - a));
    }
    for (std::size_t h = 0; h < mesh.front.size(); h += 3) {
      // Counter-clockwise seen from the empty side.
      volume -= glm::dot(positionOf(mesh.front[h]),
                         glm::cross(positionOf(mesh.front[h + 1]), positionOf(mesh.front[h + 2])));
    }
    EXPECT_NEAR(volume / 6.0, 8.0, 1e-9);
    wasPartial = wasPartial || (!mesh.tetrahedra.empty() && !mesh.front.empty());
  }
  EXPECT_TRUE(wasPartial);
}

TEST(MeshInterfaces, EachFrontOfACancelledRunEndsOnceInTheTrace) {
  const SurfaceMesh surface = testing::dividedBox({2, 1, 1}, 3);
  MeshOptions options;
  options.optimization = Optimization::kNone;
  std::size_t inFirstFront = 0;
  for (int calls = 1;; calls += 2) {
    MeshRun run(surface.points, surface.triangles, options);
    recordFront(run);
    for (int call = 0; call < calls; ++call) run.advance(40);
    const bool isCancelled = run.status() == MeshStatus::kRunning;
    run.cancel();
    std::size_t passes = 0;
    std::size_t ends = 0;
    for (const testing::TraceStep& step : testing::readTrace(run.takeTrace())) {
      if (step.kind == testing::TraceStep::kPass) ++passes;
      if (step.kind == testing::TraceStep::kEnd) ++ends;
      ASSERT_LE(ends, passes) << "cancelled after " << calls << " calls";
    }
    ASSERT_EQ(ends, passes) << "cancelled after " << calls << " calls";
    if (passes == 1) ++inFirstFront;
    if (!isCancelled) {
      EXPECT_EQ(passes, 2U);
      break;
    }
  }
  EXPECT_GT(inFirstFront, 0U);
}

}  // namespace
}  // namespace tetrafront
