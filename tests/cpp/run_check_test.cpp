/// The check of a run finds what the run finds before its front starts.

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "support/random.h"
#include "support/shapes.h"
#include "tetrafront/mesher.h"
#include "tetrafront/run_check.h"

namespace tetrafront::testing {
namespace {

BodySurfaces boxesAt(const std::vector<Vec3>& lows) {
  BodySurfaces bodies;
  for (std::uint32_t b = 0; b < lows.size(); ++b) {
    const SurfaceMesh box = gridBox(lows[b], lows[b] + Vec3(1.0), {2, 2, 2});
    const auto first = static_cast<std::uint32_t>(bodies.points.size() / 3);
    bodies.points.insert(bodies.points.end(), box.points.begin(), box.points.end());
    for (const std::uint32_t node : box.triangles) bodies.triangles.push_back(first + node);
    bodies.trianglePatch.insert(bodies.trianglePatch.end(), box.triangles.size() / 3, b);
  }
  bodies.patches = static_cast<std::uint32_t>(lows.size());
  return bodies;
}

RunCheck checked(const BodySurfaces& bodies, std::uint32_t budget) {
  RunChecker checker({}, bodies, {}, {});
  while (!checker.advance(budget)) {
  }
  return checker.result();
}

TEST(RunCheck, RefusesWhatARunRefuses) {
  Random random(5);
  int refused = 0;
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<Vec3> lows;
    for (int b = 0; b < 3; ++b) {
      lows.emplace_back(random.between(0.0, 4.0), random.between(0.0, 4.0), 0.0);
    }
    const BodySurfaces bodies = boxesAt(lows);
    MeshRun run({}, bodies, {}, {});
    while (run.advance(1U << 20U) == MeshStatus::kRunning) {
    }
    for (const std::uint32_t budget : {1U, 1U << 20U}) {
      const RunCheck found = checked(bodies, budget);
      EXPECT_EQ(found.isFillable, run.status() == MeshStatus::kDone);
      EXPECT_EQ(found.expectedTetrahedra, run.progress().expectedTetrahedra);
      EXPECT_LE(found.diagnostics.size(), run.diagnostics().size());
      EXPECT_EQ(found.trianglePatch, run.surface().trianglePatch);
    }
    if (run.status() != MeshStatus::kDone) ++refused;
  }
  EXPECT_GT(refused, 5);
  EXPECT_LT(refused, 35);
}

}  // namespace
}  // namespace tetrafront::testing
