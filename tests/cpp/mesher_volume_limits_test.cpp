/// Largest volumes of tetrahedra, and regions that are known before meshing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/mesh_validator.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/region_location.h"

namespace tetrafront {
namespace {

using testing::dividedBox;
using testing::geodesicSphere;
using testing::gridCube;

constexpr std::uint32_t kNone = SurfaceMesh::kNoRegion;

MeshRun filledWithin(const SurfaceMesh& surface, const GivenRegions& regions,
                     const MeshOptions& options = {}) {
  MeshRun run(surface.points, surface.triangles, regions, {}, options);
  while (run.advance(4096) == MeshStatus::kRunning) {
  }
  return run;
}

/// Volumes computed from the corners.
std::vector<double> cornerVolumes(const VolumeMesh& mesh) {
  std::vector<double> volumes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    const auto corner = [&](std::size_t k) {
      const double* p = &mesh.points[3 * std::size_t{mesh.tetrahedra[t + k]}];
      return Vec3(p[0], p[1], p[2]);
    };
    const Vec3 a = corner(0);
    volumes.push_back(glm::dot(glm::cross(corner(1) - a, corner(2) - a), corner(3) - a) / 6.0);
  }
  return volumes;
}

bool hasReported(const MeshRun& run, DiagnosticCode code) {
  return std::ranges::any_of(run.diagnostics(),
                             [&](const Diagnostic& found) { return found.code == code; });
}

class MaxVolume : public ::testing::TestWithParam<double> {};

TEST_P(MaxVolume, NoTetrahedronIsLarger) {
  for (const SurfaceMesh& surface : {geodesicSphere(8), gridCube(6), gridCube(1)}) {
    MeshOptions options;
    options.maxVolume = GetParam();
    const MeshRun run = filledWithin(surface, GivenRegions{}, options);
    ASSERT_EQ(run.status(), MeshStatus::kDone);
    const VolumeMesh mesh = run.volume();
    EXPECT_EQ(testing::complaintAbout(mesh, run.surface()), "");
    const std::vector<double> volumes = cornerVolumes(mesh);
    EXPECT_LE(*std::ranges::max_element(volumes), GetParam());
    EXPECT_FALSE(hasReported(run, DiagnosticCode::kLargeTetrahedra));
    // Elements at triangles far larger than the limit are needles.
    if (surface.triangles.size() == gridCube(1).triangles.size()) continue;
    EXPECT_GT(run.quality().minDihedral, 2.5);
    EXPECT_LT(run.quality().maxDihedral, 174.0);
  }
}
INSTANTIATE_TEST_SUITE_P(Volumes, MaxVolume, ::testing::Values(0.01, 0.001, 0.0001));

TEST(VolumeLimits, WithoutALimitTheMeshIsTheSame) {
  const SurfaceMesh sphere = geodesicSphere(5);
  MeshOptions limited;
  limited.maxVolume = 100.0;
  MeshRun plain(sphere.points, sphere.triangles, MeshOptions{});
  while (plain.advance(4096) == MeshStatus::kRunning) {
  }
  EXPECT_EQ(filledWithin(sphere, GivenRegions{}).fingerprint(), plain.fingerprint());
  EXPECT_EQ(filledWithin(sphere, GivenRegions{}, limited).status(), MeshStatus::kDone);
}

/// Returns whether the run ended with the error that there would be too many elements.
bool isRefused(const MeshRun& run) {
  return run.status() == MeshStatus::kInvalidInput &&
         hasReported(run, DiagnosticCode::kTooManyElements);
}

TEST(VolumeLimits, TooSmallOnesAreRefusedBeforeTheFront) {
  MeshOptions options;
  for (const double volume : {1e-30, 1e-9}) {
    options.maxVolume = volume;
    const MeshRun run = filledWithin(gridCube(1), GivenRegions{}, options);
    EXPECT_TRUE(isRefused(run)) << volume;
    EXPECT_EQ(run.volume().tetrahedra.size(), 0U) << volume;
  }
}

TEST(VolumeLimits, TooSmallOnesOfARegionAreRefused) {
  const SurfaceMesh sphere = testing::nestedSpheres(2, 3);
  GivenRegions regions;
  const std::size_t half = sphere.triangles.size() / 6;
  for (std::size_t t = 0; t < 2 * half; ++t) {
    regions.triangleRegions.push_back(0);
    regions.triangleRegions.push_back(t < half ? kNone : 1);
  }
  regions.maxVolumes = {0.0, 1e-9};
  EXPECT_TRUE(isRefused(filledWithin(sphere, regions)));
  regions.maxVolumes = {1e-9, 0.0};
  EXPECT_TRUE(isRefused(filledWithin(sphere, regions)));
}

/// The volume requires 1000 tetrahedra, which are permitted, but halving makes more.
TEST(VolumeLimits, TheNumberIsLimitedWhileElementsAreSplit) {
  MeshOptions options;
  options.maxVolume = 1e-3;
  options.maxTetrahedra = 1200;
  const MeshRun run = filledWithin(gridCube(1), GivenRegions{}, options);
  EXPECT_EQ(run.status(), MeshStatus::kStalled);
  EXPECT_TRUE(hasReported(run, DiagnosticCode::kTooManyElements));
  EXPECT_GE(run.volume().tetrahedra.size() / 4, 1200U);
  EXPECT_LE(run.volume().tetrahedra.size() / 4, 1300U);
}

TEST(VolumeLimits, SplittingShowsProgressAndCanBeCancelled) {
  const SurfaceMesh cube = gridCube(1);
  MeshOptions options;
  options.maxVolume = 1e-5;
  MeshRun run(cube.points, cube.triangles, options);
  std::vector<double> fractions;
  std::uint32_t splitTo = 0;
  while (run.status() == MeshStatus::kRunning && splitTo < 50000) {
    run.advance(256);
    if (run.progress().phase != Phase::kOptimize) continue;
    fractions.push_back(run.progress().fraction);
    splitTo = run.progress().tetrahedra;
  }
  ASSERT_EQ(run.status(), MeshStatus::kRunning);
  const auto repeated = std::ranges::unique(fractions);
  fractions.erase(repeated.begin(), repeated.end());
  EXPECT_GT(fractions.size(), 20U);
  run.cancel();
  EXPECT_EQ(run.status(), MeshStatus::kCancelled);
  EXPECT_GE(run.volume().tetrahedra.size() / 4, 50000U);
}

/// Two cubes beside each other, with a region each; one has a limit.
TEST(VolumeLimits, ALimitAppliesToItsRegionOnly) {
  const SurfaceMesh box = dividedBox({2, 1, 1}, 4);
  RegionLocator locator(box.points, box.triangles, std::vector<double>{0.5, 0.5, 0.5});
  while (!locator.advance(1000)) {
  }
  const RegionLocation found = locator.result();
  GivenRegions regions;
  regions.triangleRegions = found.triangleRegions;
  constexpr double kLimit = 2e-4;
  regions.maxVolumes.assign(2, 0.0);
  regions.maxVolumes[found.volumeOf[0]] = kLimit;
  SurfaceMesh located = box;
  located.triangles = found.triangles;
  const MeshRun run = filledWithin(located, regions);
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  const VolumeMesh mesh = run.volume();
  EXPECT_EQ(testing::complaintAbout(mesh, run.surface()), "");
  const std::vector<double> volumes = cornerVolumes(mesh);
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t t = 0; t < volumes.size(); ++t) {
    const bool isLeft =
        std::ranges::all_of(std::vector<std::size_t>{0, 1, 2, 3}, [&](std::size_t k) {
          return mesh.points[3 * std::size_t{mesh.tetrahedra[4 * t + k]}] <= 1.0;
        });
    ++(isLeft ? left : right);
    if (isLeft) {
      EXPECT_LE(volumes[t], kLimit);
    }
  }
  EXPECT_GT(left, 4 * right);
}

/// A sphere in another one, with a region each; a triangle whose regions contradict the others is an error.
TEST(GivenRegionsOfSurfaces, DecideWhatIsMeshed) {
  const SurfaceMesh sphere = testing::nestedSpheres(2, 3);
  GivenRegions both;
  // The inner sphere faces inward: its back is the shell, its front the inside.
  const std::size_t half = sphere.triangles.size() / 6;
  for (std::size_t t = 0; t < 2 * half; ++t) {
    both.triangleRegions.push_back(5);
    both.triangleRegions.push_back(t < half ? kNone : 7);
  }
  const MeshRun run = filledWithin(sphere, both);
  ASSERT_EQ(run.status(), MeshStatus::kDone);
  const VolumeMesh mesh = run.volume();
  EXPECT_EQ(*std::ranges::max_element(mesh.regions), 1U);
  GivenRegions wrong = both;
  wrong.triangleRegions.back() = 5;
  const MeshRun refused = filledWithin(sphere, wrong);
  EXPECT_EQ(refused.status(), MeshStatus::kInvalidInput);
  EXPECT_TRUE(hasReported(refused, DiagnosticCode::kInconsistentRegions));
}

}  // namespace
}  // namespace tetrafront
