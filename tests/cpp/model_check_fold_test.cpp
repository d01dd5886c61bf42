// Curved patches that fold over themselves, and similar ones that do not.

#include "model/check_fold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/check_model.h"
#include "model/patch_surface.h"
#include "support/models.h"

namespace tetrafront::testing {
namespace {

/// For a patch in the plane z = 0: the share of its domain whose orientation differs from the
/// majority.
double turnedShare(const Model& model) {
  constexpr int kCells = 150;
  const ResolvedModel resolved(model);
  const Patch& patch = model.patches.front();
  const UnitSurface surface(patch.type, curvesOf(resolved, patch.loops.front()));
  int left = 0;
  int right = 0;
  for (int j = 0; j <= kCells; ++j) {
    const int last = surface.shape() == UnitShape::kTriangle ? kCells - j : kCells;
    for (int i = 0; i <= last; ++i) {
      const SurfacePoint point = surface.evaluate(Vec2(i, j) / static_cast<double>(kCells));
      const double normal = glm::cross(point.alongXi, point.alongEta).z;
      left += normal > 1e-9 ? 1 : 0;
      right += normal < -1e-9 ? 1 : 0;
    }
  }
  return static_cast<double>(std::min(left, right)) / (left + right);
}

TEST(ModelCheckFold, FindsExactlyThePatchesThatFold) {
  for (const PatchType type : kCurvedTypes) {
    int folded = 0;
    int plain = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Model model = randomCurvedModel(type, seed, 0.3);
      for (Vec3& point : model.points) point.z = 0.0;
      const double turned = turnedShare(model);
      const bool reported = !diagnoseModel(model).empty();
      folded += reported ? 1 : 0;
      plain += reported ? 0 : 1;
      SCOPED_TRACE("type " + std::to_string(static_cast<int>(type)) + " seed " +
                   std::to_string(seed));
      // Folds are missed only next to a corner where two lines enclose slightly more than 180
      // degrees.
      EXPECT_TRUE(reported ? turned > 0.0 : turned < 0.01) << turned;
    }
    EXPECT_GT(folded, 12) << static_cast<int>(type);
    EXPECT_GT(plain, 12) << static_cast<int>(type);
  }
}

/// A disc of four parabolas around the origin with mid-points at `bulge`. Its corners are smooth if
/// it is 3 / sqrt(8).
Model disc(PatchType type, double bulge) {
  ModelBuilder builder;
  const std::array<Vec3, 4> corners{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)};
  Loop loop;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& from = corners[i];
    const Vec3& to = corners[(i + 1) % 4];
    const Vec3 middle = bulge * std::sqrt(0.5) * (from + to);
    loop.push_back({builder.line(LineType::kParabolic, {from, middle, to}), false});
  }
  builder.patch(type, {loop});
  return builder.model;
}

TEST(ModelCheckFold, SmoothCornersOfTransfinitePatchesAreNoFolds) {
  for (const double bulge : {1.0, 3.0 / std::sqrt(8.0), 1.09})
    EXPECT_TRUE(diagnoseModel(disc(PatchType::kCoons, bulge)).empty()) << bulge;
  EXPECT_TRUE(diagnoseModel(disc(PatchType::kSerendipity, 1.0)).empty());
  const std::vector<Diagnostic> found = diagnoseModel(disc(PatchType::kCoons, 1.2));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().code, DiagnosticCode::kDegeneratePatch);
  EXPECT_NEAR(glm::length(found.front().position), 1.0, 0.1);
}

TEST(ModelCheckFold, FoldOfASerendipityPatchIsReportedAtItsCorner) {
  const std::vector<Diagnostic> found = diagnoseModel(disc(PatchType::kSerendipity, 1.09));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().code, DiagnosticCode::kDegeneratePatch);
  EXPECT_NEAR(glm::length(found.front().position), 1.0, 0.1);
}

}  // namespace
}  // namespace tetrafront::testing
